// The baselines that a scene is compared with: those of a variant, and the plain ones where it has none.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "references/gates/bounds_file.hpp"
#include "references/renderers/baselines.hpp"

namespace plumb::references {

class ApprovedImages {
 public:
  /// An empty variant is the plain baselines. Throws std::runtime_error when records or bounds are damaged.
  ApprovedImages(const std::string& directory, const std::string& variant);

  struct Found {
    const Baselines* baselines;
    const Baseline* record;
  };
  std::optional<Found> find(const std::string& name) const;
  /// Whether the baseline is that of the variant, when there is one, and not the plain one.
  bool has_own(const std::string& name) const;
  /// Of all of them, sorted.
  std::vector<std::string> names() const;
  /// Where an image is, or would be, of the variant if it is there.
  std::string image_path(const std::string& name) const;

  /// What bounds.json, that of the variant before the plain one, says of the scene.
  Bounds bounds_of(const std::string& name, const Bounds& usual) const;
  /// About bounds of scenes that are not among these; empty when there are none.
  std::string complaint_about_bounds(const std::vector<std::string>& scenes) const;

 private:
  struct Place {
    explicit Place(const std::string& directory) : baselines(directory), bounds(directory) {}
    Baselines baselines;
    BoundsFile bounds;
  };
  Place plain_;
  std::optional<Place> variant_;
};

}  // namespace plumb::references
