#include "exporters/povray.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "exporters/povray_material.hpp"
#include "exporters/ties.hpp"
#include "tracer/scene/dielectrics.hpp"
#include "tracer/scene/each_kind.hpp"
#include "tracer/scene/hierarchy.hpp"
#include "tracer/text/numbers.hpp"

namespace plumb::exporters {
namespace {

/// Bounds along the axes.
struct Bounds {
  Vec3d min{std::numeric_limits<double>::infinity()};
  Vec3d max{-std::numeric_limits<double>::infinity()};

  void include(const Vec3d& low, const Vec3d& high) {
    min = glm::min(min, low);
    max = glm::max(max, high);
  }
  double span() const { return std::max({max.x - min.x, max.y - min.y, max.z - min.z, 0.0}); }
};

Bounds object_bounds(const Shape& shape) {
  return std::visit(
      EachKind{[](const Sphere& sphere) {
                 return Bounds{sphere.center - Vec3d(sphere.radius), sphere.center + Vec3d(sphere.radius)};
               },
               [](const Box& box) {
                 return Bounds{box.min, box.max};
               },
               [](const Composite&) { return Bounds{}; }},
      shape.geometry);
}

Bounds world_bounds(const Bounds& object, const Mat4<double>& matrix) {
  const Vec3d middle = formulas::transform_point(matrix, (object.min + object.max) / 2.0);
  const Vec3d half = (object.max - object.min) / 2.0;
  const Vec3d extent = glm::abs(Vec3d(matrix[0])) * half.x + glm::abs(Vec3d(matrix[1])) * half.y +
                       glm::abs(Vec3d(matrix[2])) * half.z;
  return {middle - extent, middle + extent};
}

/// Returns a name as it may stand in a comment: anything but letters, digits, _ and - becomes ?.
std::string harmless(const std::string& name) {
  std::string shown = name.substr(0, 40);
  for (char& c : shown) {
    const bool plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    if (!plain) c = '?';
  }
  return shown;
}

class Exporter {
 public:
  Exporter(const Scene& scene, const Camera& camera, int width, int height, const RenderOptions& options,
           const ExportSpace& space)
      : scene_(scene),
        camera_(camera),
        width_(width),
        height_(height),
        options_(options),
        space_(space),
        roots_(scene.roots()) {}

  PovrayExport write() {
    const auto pose = pose_of<double>(camera_);
    const auto around = dielectrics_around(scene_, pose.eye, pose.direction);
    header();
    camera(pose);
    for (const Light& light : scene_.lights) {
      if (!shines(light)) continue;
      text_ += "light_source { " + sdl(exported_point(light.position)) + ", rgb " + sdl(light.intensity()) +
               " }\n";
    }
    materials();
    const bool decides_ties = write_ties_alike(pose.eye);
    if (around.empty() && !decides_ties) {
      hierarchy();
    } else {
      flat(around);
    }
    return {std::move(text_), !around.empty() || decides_ties};
  }

 private:
  enum class Role { itself, shadow_caster };

  Vec3d exported_point(const Vec3d& p) const { return space_.scale * (p - space_.center); }

  void header() {
    text_ += "// Exported by plumb. One unit of the scene is " + to_text(space_.scale) + " units here";
    if (space_.center != Vec3d(0)) text_ += "; " + sdl(space_.center) + " of the scene is the origin";
    text_ += ".\n#version 3.7;\nglobal_settings { assumed_gamma 1.0 max_trace_level " +
             std::to_string(options_.depth) + " adc_bailout 0 }\n";
    if (scene_.background != Rgbd(0)) text_ += "background { rgb " + sdl(scene_.background) + " }\n";
  }

  void camera(const CameraPose<double>& pose) {
    const Mat4<double> m = formulas::camera_matrix(pose.eye, pose.direction, pose.up);
    const double distance = formulas::image_plane_distance(camera_.fov_x_degrees);
    const double aspect = static_cast<double>(height_) / static_cast<double>(width_);
    text_ += "camera { perspective location " + sdl(exported_point(pose.eye)) + " direction " +
             sdl(-Vec3d(m[2]) * distance) + " right " + sdl(Vec3d(m[0])) + " up " +
             sdl(Vec3d(m[1]) * aspect) + " }\n";
  }

  static bool shines(const Light& light) { return light.intensity() != Rgbd(0); }
  bool is_lit() const { return std::any_of(scene_.lights.begin(), scene_.lights.end(), &shines); }

  bool casts_apart(const Material& material) const {
    return options_.shadows && material.transmits() && options_.glass_shadow == GlassShadow::full && is_lit();
  }

  bool casts_apart(const Shape& shape) const {
    const MaterialId* material = material_of(shape);
    return material != nullptr && casts_apart(scene_.materials[*material]);
  }

  void materials() {
    std::set<MaterialId> used;
    bool needs_caster = false;
    for (const Shape& shape : scene_.shapes) {
      if (const MaterialId* material = material_of(shape)) {
        used.insert(*material);
        needs_caster = needs_caster || casts_apart(scene_.materials[*material]);
      }
    }
    for (const MaterialId id : used) {
      Material material = scene_.materials[id];
      if (!is_lit()) material.kd = material.ks = Rgbd(0);
      text_ += "#declare Material_" + std::to_string(id) + " = // " + harmless(material.name) + "\n" +
               povray_texture(material, scene_.ambient);
    }
    if (needs_caster)
      text_ += "#declare Caster = texture { pigment { rgb 0 } finish { ambient 0 diffuse 0 } }\n";
  }

  /// Returns what stands inside a sphere or box: texture, interior and flags.
  std::string appearance(const Shape& shape, Role role) const {
    const MaterialId id = *material_of(shape);
    const Material& material = scene_.materials[id];
    if (role == Role::shadow_caster) return " texture { Caster } no_image no_reflection";
    std::string text = " texture { Material_" + std::to_string(id) + " }";
    if (material.transmits()) {
      text += " interior { ior " + to_text(material.eta) + " }";
      if (options_.shadows && options_.glass_shadow != GlassShadow::filtered) text += " no_shadow";
    }
    if (!options_.shadows) text += " no_shadow";
    return text;
  }

  /// Returns the factor that makes a shape smaller in its own space: a power of two, so that it rounds
  /// nothing. It is 1 where the matrix presses nothing to less than a 64th.
  double shrinking(const Mat4<double>& inverse) const {
    if (!space_.shrinks_pressed) return 1;
    double most = 0;
    for (int axis = 0; axis < 3; ++axis) most = std::max(most, glm::length(Vec3d(inverse[axis])));
    return most > 64 && std::isfinite(most) ? std::ldexp(1.0, -std::ilogb(most)) : 1;
  }

  /// Writes M in export units: the linear part is the same, lengths are scaled. The centre moves at the top
  /// only.
  std::string matrix(Mat4<double> m, bool is_root, double shrunk = 1) const {
    for (int axis = 0; axis < 3; ++axis) m[axis] /= shrunk;
    const Vec3d moved = space_.scale * (Vec3d(m[3]) - (is_root ? space_.center : Vec3d(0)));
    const bool linear_identity =
        Vec3d(m[0]) == Vec3d(1, 0, 0) && Vec3d(m[1]) == Vec3d(0, 1, 0) && Vec3d(m[2]) == Vec3d(0, 0, 1);
    if (linear_identity) return moved == Vec3d(0) ? "" : " translate " + sdl(moved);
    std::string text = " matrix <";
    for (int column = 0; column < 3; ++column) {
      for (int row = 0; row < 3; ++row) text += to_text(m[column][row]) + ",";
    }
    return text + to_text(moved.x) + "," + to_text(moved.y) + "," + to_text(moved.z) + ">";
  }

  /// Writes a sphere or box. A composite is declared apart, see declare().
  template <class Geometry>
  std::string primitive(const Geometry& geometry, const std::string& rest, double shrunk) const {
    const double s = space_.scale * shrunk;
    return std::visit(EachKind{[&](const Sphere& sphere) {
                                 return "sphere { " + sdl(s * sphere.center) + ", " +
                                        to_text(s * sphere.radius) + rest + " }";
                               },
                               [&](const Box& box) {
                                 return "box { " + sdl(s * box.min) + ", " + sdl(s * box.max) + rest + " }";
                               },
                               [](const Composite&) { return std::string(); }},
                      geometry);
  }

  /// Writes a sphere or box, and beside it its black shadow caster where glass must cast a full shadow.
  std::string leaf(const Shape& shape, const Transform<double>& transform, bool is_root) const {
    const double shrunk = shrinking(transform.inverse);
    const std::string placed = matrix(transform.matrix, is_root, shrunk);
    std::string text = primitive(shape.geometry, appearance(shape, Role::itself) + placed, shrunk);
    if (casts_apart(shape)) {
      text += " " + primitive(shape.geometry, appearance(shape, Role::shadow_caster) + placed, shrunk);
    }
    return text;
  }

  /// Declares every composite once, its children before it. Spheres and boxes stand where they are used.
  void hierarchy() {
    std::vector<bool> is_declared(scene_.shapes.size(), false);
    for (const ShapeId root : roots_) declare(root, is_declared);
    for (const ShapeId root : roots_)
      text_ += use(root, true) + " // " + harmless(scene_.shapes[root].name) + "\n";
  }

  void declare(ShapeId id, std::vector<bool>& is_declared) {
    if (!is_composite(scene_.shapes[id]) || is_declared[id]) return;
    is_declared[id] = true;
    const std::vector<ShapeId>& children = children_of(scene_.shapes[id]);
    for (const ShapeId child : children) declare(child, is_declared);
    const bool is_union = children.size() > 1 || casts_apart(scene_.shapes[children.front()]);
    text_ += "#declare Composite_" + std::to_string(id) + " = " + (is_union ? "union { // " : "// ") +
             harmless(scene_.shapes[id].name) + "\n";  // POV-Ray warns of a union of one
    for (const ShapeId child : children) text_ += "  " + use(child, false) + "\n";
    if (is_union) text_ += "}\n";
  }

  std::string use(ShapeId id, bool is_root) const {
    const Shape& shape = scene_.shapes[id];
    const Transform<double> transform = transform_of<double>(shape.transform);
    if (material_of(shape) != nullptr) return leaf(shape, transform, is_root);
    return "object { Composite_" + std::to_string(id) + matrix(transform.matrix, is_root) + " }";
  }

  /// Without bounding boxes POV-Ray takes the first of equally near hits, but tries all for every ray, so
  /// this is for few instances. In a space of the caller's, POV-Ray is left to itself.
  bool write_ties_alike(const Vec3d& eye) {
    constexpr std::uint64_t most_instances = 256;
    if (!space_.decides_ties) return false;
    const std::vector<std::uint64_t> counts = count_instances(scene_);
    std::uint64_t all = 0;
    for (const ShapeId root : roots_) all = saturating_add(all, counts[root]);
    if (all > most_instances) return false;
    placed_ = placed_shapes(scene_);
    return exporters::write_ties_alike(scene_, eye, space_.center, placed_);
  }

  void write(const PlacedShape& placed, Role role) {
    const Shape& shape = scene_.shapes[placed.shape];
    const double shrunk = shrinking(placed.world_from_object.inverse);
    const std::string place = matrix(placed.world_from_object.matrix, !placed.is_centered, shrunk);
    text_ += primitive(placed.geometry, appearance(shape, role) + place, shrunk) + " // " +
             harmless(shape.name) + "\n";
  }

  /// Writes shape by shape. With the eye inside glass, POV-Ray looks for the interiors among the top objects
  /// only, in their order. Of what coincides it takes the first.
  void flat(const std::vector<EnclosingDielectric>& around) {
    if (placed_.empty()) placed_ = placed_shapes(scene_);
    for (const PlacedShape& p : placed_) {
      if (casts_apart(scene_.shapes[p.shape])) write(p, Role::shadow_caster);
    }
    std::vector<bool> is_written(placed_.size(), false);
    for (const EnclosingDielectric& d : around) {
      write(placed_[d.instance], Role::itself);
      is_written[d.instance] = true;
    }
    for (std::size_t i = 0; i < placed_.size(); ++i) {
      if (!is_written[i]) write(placed_[i], Role::itself);
    }
  }

  const Scene& scene_;
  const Camera& camera_;
  int width_;
  int height_;
  const RenderOptions& options_;
  ExportSpace space_;
  std::vector<ShapeId> roots_;
  std::vector<PlacedShape> placed_;  // when it is written shape by shape
  std::string text_;
};

}  // namespace

ExportSpace export_space(const Scene& scene, const Camera& camera) {
  constexpr double wanted_span = 8192;      // at least, and less than twice as much
  constexpr double smallest_feature = 16;   // 1e-3 (the shadow tolerance) must be small against it
  constexpr double largest_span = 1 << 20;  // spheres vanish past 1e7
  const Vec3d eye = pose_of<double>(camera).eye;
  Bounds all;
  all.include(eye, eye);
  double smallest = std::numeric_limits<double>::infinity();
  for_each_instance(scene, [&](const Instance& instance) {
    const Bounds b =
        world_bounds(object_bounds(scene.shapes[instance.shape]), instance.world_from_object.matrix);
    all.include(b.min, b.max);
    smallest = std::min(smallest, b.span());
  });
  const double span = all.span();
  if (!(span > 0) || !std::isfinite(span)) return {1, Vec3d(0)};
  int exponent = std::ilogb(wanted_span) - std::ilogb(span);
  const auto scaled = [&](double length) { return std::ldexp(length, exponent); };
  while (scaled(smallest) < smallest_feature && scaled(span) < largest_span / 2) ++exponent;
  const Vec3d middle = (all.min + all.max) / 2.0;
  const bool is_far_off = glm::length(middle) > 2 * span;
  return {std::ldexp(1.0, exponent), is_far_off ? middle : Vec3d(0)};
}

PovrayExport export_povray(const Shot& shot) {
  return export_povray(shot, export_space(shot.scene, shot.camera));
}

PovrayExport export_povray(const Shot& shot, const ExportSpace& space) {
  return Exporter(shot.scene, shot.camera, shot.width, shot.height, shot.options, space).write();
}

}  // namespace plumb::exporters
