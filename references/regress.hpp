// Regression gates: the scenes of a directory against the images that were approved for them.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "references/baselines.hpp"
#include "references/verify.hpp"

namespace plumb::references {

struct RegressOptions : PictureOptions {
  int threads = 0;  ///< 0: as many as the machine runs at once
  /// Called now and then, from one thread at a time, with the fraction of the scene that is done; may be
  /// empty.
  std::function<void(double)> progress;
};

/// One scene, or one baseline whose scene is gone. `differ`: the images differ or there is no baseline yet.
/// `error`: it could not be judged.
struct RegressedScene {
  std::string name;
  SceneResult result;
  double seconds = 0;            ///< on the clock
  bool can_be_approved = false;  ///< an update makes it agree
  std::optional<Image> image;    ///< both only while `done` runs, where they could be had
  std::optional<Image> baseline;
};

/// Where the baselines of a directory of scenes are.
std::string baselines_of(const std::string& directory);

/// DIRECTORY/NAME.sdf
std::string scene_path(const std::string& directory, const std::string& name);

/// NAME of each NAME.sdf in the directory, sorted; hidden files and what lies deeper are not meant. Throws
/// std::runtime_error when there is no such directory.
std::vector<std::string> scene_names(const std::string& directory);

/// Each scene, then each baseline whose scene is gone. One bad scene never stops the others; throws
/// std::runtime_error when there is no scene or when the records of the baselines are damaged.
std::vector<RegressedScene> regress(const std::string& directory, const RegressOptions& options,
                                    const std::function<void(const RegressedScene&)>& done);

/// The picture that the options ask for. Throws std::runtime_error.
Image rendered(const Scene& scene, const RegressOptions& options);

/// How many pixels are not finite, and the first of them; empty when all are.
std::string non_finite_pixels(const Image& image);

}  // namespace plumb::references
