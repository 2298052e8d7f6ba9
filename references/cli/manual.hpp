// Man pages and completions, made from the options of the commands themselves.
#pragma once

#include <CLI/CLI.hpp>

#include "references/cli/commands.hpp"

namespace plumb::cli {

/// `plumb manual DIR`, for whoever packages plumb; no help lists it. Writes man1/plumb*.1,
/// completions/plumb.bash, completions/_plumb (zsh) and completions/plumb.fish.
Command add_manual(CLI::App& plumb);

}  // namespace plumb::cli
