// What somebody may have meant who mistyped a command or an option.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace plumb::cli {

/// "did you mean --size?", for the first argument that was not expected; empty when nothing is near.
std::string likely_slip(const CLI::App& app);

}  // namespace plumb::cli
