// The baselines that a scene is compared with: those of a variant, or the plain ones where it has none.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "references/gates/bounds_file.hpp"
#include "references/renderers/baselines.hpp"

namespace plumb::gates {

class ApprovedImages {
 public:
  /// An empty variant means the plain baselines. Throws std::runtime_error when records or bounds are
  /// damaged.
  ApprovedImages(const std::string& directory, const std::string& variant);

  struct Found {
    const renderers::Baselines* baselines;
    const renderers::Baseline* record;
  };
  std::optional<Found> find(const std::string& name) const;
  /// True if the baseline is that of the variant (or the plain one, without a variant).
  bool has_own(const std::string& name) const;
  /// Returns the names of all of them, sorted.
  std::vector<std::string> names() const;
  /// Returns where an image is, or would be: that of the variant if it exists, else the plain one.
  std::string image_path(const std::string& name) const;

  /// Returns `usual` with what bounds.json says of the scene: the plain file first, then the variant's in
  /// place of it.
  Bounds bounds_of(const std::string& name, const Bounds& usual) const;
  /// Complains of bounds for scenes that are not among these; empty when there are none.
  std::string complaint_about_bounds(const std::vector<std::string>& scenes) const;

 private:
  struct Place {
    explicit Place(const std::string& directory) : baselines(directory), bounds(directory) {}
    renderers::Baselines baselines;
    BoundsFile bounds;
  };
  Place plain_;
  std::optional<Place> variant_;
};

}  // namespace plumb::gates
