// A scene between reading its lines and looking up the names in them.
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

/// A name that was used, to be looked up at the end: definitions may follow their use.
struct Reference {
  std::string_view name;
  Place place;
};

/// What the reader fills in and the resolver completes. Views point into the text.
struct Draft {
  /// Of a sphere or box.
  struct MaterialUse {
    ShapeId shape;
    Reference material;
  };
  /// Of a composite.
  struct ChildUse {
    ShapeId composite;
    Reference child;
  };
  struct TransformLine {
    Reference target;
    TransformStep step;
  };
  struct RenderLine {
    Reference camera;  ///< no name: the first camera
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
  std::unordered_set<std::string_view> broken_shapes;  ///< defined, but not as a shape that is known

  std::vector<Place> materials;            ///< parallel to scene.materials
  std::vector<Place> shapes;               ///< parallel to scene.shapes
  std::vector<Place> lights;               ///< parallel to scene.lights
  std::vector<Place> cameras;              ///< parallel to scene.cameras
  std::vector<MaterialUse> material_uses;  ///< of materials that were not defined before
  std::vector<ChildUse> child_uses;
  std::vector<TransformLine> transforms;
  std::vector<RenderLine> renders;
  std::optional<Resolution> camera_resolution;  ///< of the loose dialect, where `render` gives no size
  Rgbd ambient_of_lights{0};                    ///< sum of La
  bool has_render_line = false;                 ///< even if it could not be read
  int unknown_names = 0;
  int last_line = 0;

  Finding& say(Severity severity, Place place, std::string message, std::string remedy = {}) {
    findings.push_back({severity, place.line, place.column, std::move(message), std::move(remedy)});
    return findings.back();
  }
  /// Sets the material of a sphere or box, at once where it is defined already.
  void use_material(ShapeId shape, const Reference& material);
  bool has_errors() const;
};

/// Looks up all names, puts transforms in order, completes what is missing by the documented defaults, and
/// reports what is inconsistent.
void resolve(Draft& draft, TransformOrder order);

/// Side of a picture in pixels, as a number may say it.
inline constexpr int largest_side = 65535;
inline constexpr double largest_pixel_count = 1 << 28;

}  // namespace plumb
