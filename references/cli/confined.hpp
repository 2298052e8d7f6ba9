// The command line of somebody else's renderer, and the limits under which it runs.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "references/submissions/other_renderer.hpp"

namespace plumb::cli {

struct ConfinedOptions {
  std::string renderer;
  std::vector<std::string> readable;
  std::size_t memory_mib = 2048, disk_mib = 64, processes = 64;
  double timeout = 10, cpu = 20;
};

/// --renderer, --readable and the limits; these return the first.
CLI::Option* add_confined(CLI::App& app, ConfinedOptions& options);

/// Throws std::invalid_argument when there is no such program, or no {scene} or {image} in its arguments.
references::ConfinedCommand confined_command(const ConfinedOptions& options);

}  // namespace plumb::cli
