// Approves what scenes look like now: their images become the baselines.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "references/gates/regress.hpp"

namespace plumb::gates {

struct ApprovalRequest {
  std::vector<std::string> scenes;  ///< each NAME, NAME.sdf or a path
  bool all_new = false;             ///< true: the scenes that have no baseline, too
  std::string why;
  std::string who;
  std::function<void(const std::string&)> warn;  ///< gets the warnings about the scene files
  std::string arguments;  ///< of `plumb render`, for the record; each with a blank before it
};

struct Approved {
  std::string name;
  bool is_gone = false;           ///< true if the scene is gone, and so its baseline
  bool is_of_one_colour = false;  ///< true if nothing is seen in the image
  int width = 0;
  int height = 0;
  std::string unchanged{};   ///< who approved the very same before, when and why; it then stays; else empty
  std::string not_stored{};  ///< what the file of somebody else's renderer also holds
};

/// Renders the scenes and stores their images as baselines, all of them or none. Forgets the baseline of a
/// scene that is gone. Changes nothing where scene file, command and pixels are those of the baseline. Throws
/// std::invalid_argument on a name that is no scene's, std::runtime_error on an image with pixels that are
/// not finite.
std::vector<Approved> approve(const std::string& directory, const RegressOptions& options,
                              const ApprovalRequest& request);

}  // namespace plumb::gates
