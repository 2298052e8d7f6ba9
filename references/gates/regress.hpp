// Regression gates: compares the scenes of a directory with the images that were approved for them.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "references/gates/bounds.hpp"
#include "references/gates/scene_directory.hpp"
#include "references/gates/verify.hpp"
#include "references/renderers/baselines.hpp"

namespace plumb::gates {

/// `tolerance` is that of the bounds. With another renderer, the options that say how plumb renders count for
/// nothing.
struct RegressOptions : PictureOptions {
  int threads = 0;  ///< 0: as many as the machine runs at once
  Bounds bounds;    ///< of scenes about which bounds.json says nothing
  std::string variant;
  std::shared_ptr<const renderers::Renderer> other;  ///< somebody else's, in place of plumb; may be null
  /// Called now and then, from one thread at a time, with the fraction of the scene that is done; may be
  /// empty.
  std::function<void(double)> progress;
};

/// What was allowed besides the tolerance, and what came of it.
struct UsedBounds {
  Bounds bounds;
  BoundedComparison comparison;
};

/// One scene, or one baseline whose scene is gone. `differ` means that the images differ or there is no
/// baseline yet, `error` that it could not be judged.
struct RegressedScene {
  std::string name;
  SceneResult result;
  double seconds = 0;                           ///< on the clock
  bool can_be_approved = false;                 ///< an update makes it agree
  std::string cannot_be_approved;               ///< why, where the picture itself is wrong; else empty
  std::string lost;                             ///< the baseline's image, where the scene is gone; else empty
  std::optional<renderers::Baseline> approved;  ///< what it was compared with
  bool has_changed = false;                     ///< the scene file, since that was approved
  std::string not_stored;                       ///< what else the renderer's file holds; else empty
  std::optional<UsedBounds> bounds;
  std::optional<Image> image;  ///< both only while `done` runs, and where they could be had
  std::optional<Image> baseline;
};

/// Checks each scene, then each baseline whose scene is gone. One bad scene never stops the others. Throws
/// std::runtime_error when there is no scene, or when records or bounds are damaged.
std::vector<RegressedScene> regress(const std::string& directory, const RegressOptions& options,
                                    const std::function<void(const RegressedScene&)>& done);

/// The picture that the options ask for. Throws std::runtime_error.
renderers::Rendered rendered(const std::string& scene_path, const RegressOptions& options,
                             const std::function<void(const std::string&)>& warn = {});

/// Returns how many pixels are not finite, and the first of them; empty when all are finite.
std::string non_finite_pixels(const Image& image);

}  // namespace plumb::gates
