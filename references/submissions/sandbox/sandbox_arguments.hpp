// The command line that tells bubblewrap what a confined program sees.
#pragma once

#include <string>
#include <vector>

#include "references/submissions/sandbox/sandbox.hpp"

namespace plumb::submissions {

/// Descriptors that bubblewrap inherits: it reports on the first, waits for the second, reads the filter from
/// the third.
inline constexpr int status_descriptor = 3;
inline constexpr int release_descriptor = 4;
inline constexpr int filter_descriptor = 5;

/// This path exists once the sandbox is set up. It lies in /dev, where nobody but root makes anything
/// outside.
inline constexpr const char* sign_of_setup = "/dev/plumb-sandbox";

/// Returns the complete command line, `bwrap` first. `user` is the one that root's programs become; 0: they
/// stay who we are. Throws std::runtime_error as places_of() does.
std::vector<std::string> sandbox_arguments(const std::string& bwrap, const std::vector<std::string>& command,
                                           const SandboxView& view, const SandboxLimits& limits,
                                           unsigned user);

}  // namespace plumb::submissions
