// How bubblewrap is told what a confined program sees.
#pragma once

#include <string>
#include <vector>

#include "references/judging/sandbox.hpp"

namespace plumb::references {

/// Directories that exist here and hold what is private: homes, temporary files, sockets, other disks.
std::vector<std::string> hidden_places();

/// The whole command line, `bwrap` first.
std::vector<std::string> sandbox_arguments(const std::string& bwrap, const std::vector<std::string>& command,
                                           const SandboxView& view);

}  // namespace plumb::references
