// A scene whose lines have been read and whose names have yet to be looked up.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "tracer/format/names.hpp"
#include "tracer/format/reader.hpp"

namespace plumb {

struct Place {
  int line = 0;
  int column = 0;
};

/// A name that is used. It is looked up at the end, because definitions may follow their use.
struct Reference {
  std::string_view name;
  Place place;
};

/// What the reader fills in and the resolver completes. Views point into the text, which must outlive it.
struct Draft {
  /// The material that a sphere or box names.
  struct MaterialUse {
    ShapeId shape;
    Reference material;
  };
  /// A child that a composite names.
  struct ChildUse {
    ShapeId composite;
    Reference child;
  };
  struct TransformLine {
    Reference target;
    TransformStep step;
  };
  struct RenderLine {
    Reference camera;  ///< without a name, it is the first camera
    RenderRequest request;
    bool has_size = true;
  };
  struct Resolution {
    double width;
    double height;
    Place place;
  };

  Scene scene;
  std::vector<Finding> findings;

  Names material_names;
  Names shape_names;
  Names light_names;
  Names camera_names;
  std::unordered_set<std::string_view> broken_shapes;  ///< names in shape definitions of an unknown kind

  std::vector<Place> materials;            ///< parallel to scene.materials
  std::vector<Place> shapes;               ///< parallel to scene.shapes
  std::vector<Place> lights;               ///< parallel to scene.lights
  std::vector<Place> cameras;              ///< parallel to scene.cameras
  std::vector<MaterialUse> material_uses;  ///< names that were not defined before their use
  std::vector<ChildUse> child_uses;
  std::vector<TransformLine> transforms;
  std::vector<RenderLine> renders;
  std::optional<Resolution> camera_resolution;  ///< in the loose dialect, where `render` gives no size
  Rgbd ambient_of_lights{0};                    ///< sum of La over all lights
  bool has_render_line = false;                 ///< even if it could not be read
  int unknown_names = 0;
  int last_line = 0;

  /// Adds a finding and returns it; the reference is valid until the next one.
  Finding& say(Severity severity, Place place, std::string message, std::string remedy = {}) {
    findings.push_back({severity, place.line, place.column, std::move(message), std::move(remedy)});
    return findings.back();
  }
  /// Sets the material of a sphere or box, at once if it is defined already.
  void use_material(ShapeId shape, const Reference& material);
  bool has_errors() const;
};

/// Looks up all names, puts transforms in order, completes what is missing by the documented defaults, and
/// reports what is inconsistent.
void resolve(Draft& draft, TransformOrder order);

/// Limits of a picture: its side in pixels, and its number of pixels.
inline constexpr int largest_side = 65535;
inline constexpr double largest_pixel_count = 1 << 28;

}  // namespace plumb
