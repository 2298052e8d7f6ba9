// The command line of somebody else's renderer, and the limits under which it runs.
#pragma once

#include <string>
#include <vector>

#include "references/cli/command_line.hpp"
#include "references/submissions/confined.hpp"

namespace plumb::cli {

struct ConfinedOptions {
  std::string renderer;
  std::vector<std::string> readable;
  std::size_t memory_mib = 2048, disk_mib = 64, processes = 64;
  double timeout = 10, cpu = 20;
};

/// --timeout, whose purpose is given, --cpu --memory --disk --processes
Table limit_options(ConfinedOptions& options, const std::string& timeout);
submissions::SandboxLimits limits_of(const ConfinedOptions& options);

/// The paths as they are seen from everywhere. Throws std::invalid_argument when there is no such file.
std::vector<std::string> readable_paths(const ConfinedOptions& options);

/// The words of --renderer; those that name files from here name them from everywhere.
std::vector<std::string> renderer_words(const ConfinedOptions& options);

/// The path of a program that --renderer names. Throws std::invalid_argument when there is none.
std::string found_program(const std::string& asked, const std::string& path);

/// --renderer, --readable and the limits, for regress.
Table confined_options(ConfinedOptions& options);

/// Throws std::invalid_argument when there is no such program, or no {scene} or {image} in its arguments.
submissions::ConfinedCommand confined_command(const ConfinedOptions& options);

}  // namespace plumb::cli
