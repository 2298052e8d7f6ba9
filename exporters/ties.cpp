#include "exporters/ties.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "tracer/scene/each_kind.hpp"
#include "tracer/scene/hierarchy.hpp"

namespace plumb::exporters {
namespace {

constexpr double rounding =
    1e-14;  // of the numbers that a place is computed from: 45 units in the last place

double largest(const Vec3d& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

using Axes = std::array<Vec3d, 3>;
using Mat3d = glm::mat<3, 3, double, glm::highp>;

/// A box by its edges: its points are sums of c[k] * axes[k] with low[k] <= c[k] <= high[k], about the centre
/// of the export.
struct EdgedBox {
  std::size_t place;  ///< index among the shapes
  Axes axes;          ///< orthonormal
  Vec3d low, high;
  double size;  ///< largest of the numbers that they are computed from
  bool transmits;
  bool has_eye_inside = false;
  bool is_tied = false;

  double& bound(int axis, bool is_high) { return is_high ? high[axis] : low[axis]; }
  double bound(int axis, bool is_high) const { return is_high ? high[axis] : low[axis]; }
};

/// Makes an edge along an axis of the world exactly that.
void straighten(Axes& axes) {
  for (int k = 0; k < 3; ++k) {
    for (int world = 0; world < 3; ++world) {
      Vec3d exact(0);
      exact[world] = 1;
      if (largest(axes[static_cast<std::size_t>(k)] - exact) > rounding) continue;
      for (Vec3d& axis : axes) axis[world] = 0;
      axes[static_cast<std::size_t>(k)] = exact;
    }
  }
}

/// Turns round the edges of which the components have a negative sum.
void turn_forward(EdgedBox& box) {
  for (int k = 0; k < 3; ++k) {
    Vec3d& axis = box.axes[static_cast<std::size_t>(k)];
    const bool is_backward = axis.x + axis.y + axis.z < 0;
    if (!is_backward) continue;
    axis = -axis;
    const double low = box.low[k];
    box.low[k] = -box.high[k];
    box.high[k] = -low;
  }
}

bool are_orthonormal(const Axes& axes) {
  const auto is_finite = [](const Vec3d& v) { return std::isfinite(glm::dot(v, v)); };
  return std::all_of(axes.begin(), axes.end(), is_finite) && std::abs(glm::dot(axes[0], axes[1])) < 1e-13 &&
         std::abs(glm::dot(axes[1], axes[2])) < 1e-13 && std::abs(glm::dot(axes[2], axes[0])) < 1e-13;
}

/// Gives the box the axes of a frame if these are its own, in any order. Returns whether they are.
bool adopt(const Axes& frame, EdgedBox& box) {
  std::array<int, 3> from{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto* const found = std::find_if(box.axes.begin(), box.axes.end(), [&](const Vec3d& axis) {
      return std::min(largest(axis - frame[k]), largest(axis + frame[k])) <= rounding;
    });
    if (found == box.axes.end()) return false;
    from[k] = static_cast<int>(found - box.axes.begin());
  }
  EdgedBox turned = box;
  turned.axes = frame;
  for (int k = 0; k < 3; ++k) {
    const int old = from[static_cast<std::size_t>(k)];
    const Vec3d& axis = frame[static_cast<std::size_t>(k)];
    const bool is_same_way = glm::dot(axis, box.axes[static_cast<std::size_t>(old)]) > 0;
    turned.low[k] = is_same_way ? box.low[old] : -box.high[old];
    turned.high[k] = is_same_way ? box.high[old] : -box.low[old];
  }
  box = turned;
  return true;
}

/// Gives boxes of one orientation the same axes, to the last bit.
class Frames {
 public:
  void settle(EdgedBox& box) {
    straighten(box.axes);
    for (const Axes& frame : frames_) {
      if (adopt(frame, box)) return;
    }
    frames_.push_back(box.axes);
  }

 private:
  std::vector<Axes> frames_{{Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 1)}};
};

/// What the box covers along a direction.
struct Interval {
  double low, high;
};
Interval along(const Vec3d& direction, const EdgedBox& box) {
  double middle = 0, half = 0;
  for (int k = 0; k < 3; ++k) {
    const double share = glm::dot(box.axes[static_cast<std::size_t>(k)], direction);
    middle += share * (box.low[k] + box.high[k]) / 2;
    half += std::abs(share) * (box.high[k] - box.low[k]) / 2;
  }
  return {middle - half, middle + half};
}

/// True if two faces in one plane have an area in common: no edge of either separates them.
bool overlap(const EdgedBox& a, int axis_a, const EdgedBox& b, int axis_b) {
  const double more = rounding * std::max(a.size, b.size);
  const auto separates = [&](const Vec3d& direction) {
    const Interval of_a = along(direction, a), of_b = along(direction, b);
    return std::min(of_a.high, of_b.high) - std::max(of_a.low, of_b.low) <= more;
  };
  for (int k = 0; k < 3; ++k) {
    if (k != axis_a && separates(a.axes[static_cast<std::size_t>(k)])) return false;
    if (k != axis_b && separates(b.axes[static_cast<std::size_t>(k)])) return false;
  }
  return true;
}

/// True if rays can come to the face from this side, as far as its own box lets them.
bool is_open(const EdgedBox& box, bool is_inside) {
  return box.transmits || (box.has_eye_inside ? is_inside : !is_inside);
}

/// True if a ray can come to both faces from one side. A face at `high` has its box below it.
bool can_be_met(const EdgedBox& a, bool a_is_high, const EdgedBox& b, bool b_is_high) {
  const bool from_above = is_open(a, !a_is_high) && is_open(b, !b_is_high);
  const bool from_below = is_open(a, a_is_high) && is_open(b, b_is_high);
  return from_above || from_below;
}

/// Gives the faces of the later box that coincide with one of the earlier the numbers of that one.
void tie(EdgedBox& earlier, int axis, EdgedBox& later, int axis_of_later) {
  const double near = rounding * std::max(earlier.size, later.size);
  for (const bool is_high : {false, true}) {
    for (const bool later_is_high : {false, true}) {
      const double place = earlier.bound(axis, is_high);
      double& other = later.bound(axis_of_later, later_is_high);
      if (!(std::abs(other - place) <= near) || !can_be_met(earlier, is_high, later, later_is_high) ||
          !overlap(earlier, axis, later, axis_of_later))
        continue;
      other = place;
      earlier.is_tied = later.is_tied = true;
    }
  }
}

bool is_of_world(const Vec3d& axis) { return axis.x == 1 || axis.y == 1 || axis.z == 1; }

/// Along a common edge both boxes have the same distance, to the last bit, where all edges are common or the
/// edge is an axis of the world. Otherwise their matrices round it differently.
void tie(EdgedBox& earlier, EdgedBox& later) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Vec3d& axis = earlier.axes[static_cast<std::size_t>(i)];
      const bool is_common = axis == later.axes[static_cast<std::size_t>(j)];
      if (is_common && (earlier.axes == later.axes || is_of_world(axis))) tie(earlier, i, later, j);
    }
  }
}

class Ties {
 public:
  Ties(const Scene& scene, const Vec3d& eye, const Vec3d& center, std::vector<PlacedShape>& shapes)
      : scene_(scene), eye_(eye - center), center_(center), shapes_(shapes) {}

  bool write_alike() {
    for (std::size_t i = 0; i < shapes_.size(); ++i) {
      std::visit(EachKind{[&](const Sphere& sphere) { add(sphere, i); }, [&](const Box& box) { add(box, i); },
                          [](const Composite&) {}},
                 shapes_[i].geometry);
    }
    for (std::size_t later = 1; later < boxes_.size(); ++later) {
      for (std::size_t earlier = 0; earlier < later; ++earlier) tie(boxes_[earlier], boxes_[later]);
    }
    for (const EdgedBox& box : boxes_) {
      if (box.is_tied) write(box);
    }
    return are_spheres_tied_ ||
           std::any_of(boxes_.begin(), boxes_.end(), [](const EdgedBox& b) { return b.is_tied; });
  }

 private:
  /// The ellipsoid that a sphere is in the world. R satisfies |R^-1 (p - centre)| = 1 on it; it is kept as R
  /// R^T, which no rotation of the sphere changes.
  struct Ellipsoid {
    Vec3d center;
    Mat3d squared;
    double radius;
    double size;
  };

  static Ellipsoid ellipsoid(const Sphere& sphere, const Mat4<double>& m) {
    const Mat3d linear = Mat3d(m) * sphere.radius;
    const Mat3d squared = linear * glm::transpose(linear);
    const Vec3d center = formulas::transform_point(m, sphere.center);
    return {center, squared, std::sqrt(largest({squared[0][0], squared[1][1], squared[2][2]})),
            std::max(largest(center), largest(Vec3d(m[3])))};
  }

  static bool are_one(const Ellipsoid& a, const Ellipsoid& b) {
    const double near = rounding * std::max({a.size, b.size, a.radius});
    if (!(largest(a.center - b.center) <= near)) return false;
    for (int k = 0; k < 3; ++k) {
      if (!(largest(a.squared[k] - b.squared[k]) <= near * a.radius)) return false;
    }
    return true;
  }

  /// Ties it to the first that it is one with: another sphere stands at the place then.
  void add(const Sphere& sphere, std::size_t place) {
    const Ellipsoid own = ellipsoid(sphere, shapes_[place].world_from_object.matrix);
    const auto same = std::find_if(spheres_.begin(), spheres_.end(),
                                   [&](const auto& other) { return are_one(other.second, own); });
    if (same == spheres_.end()) {
      spheres_.emplace_back(place, own);
      return;
    }
    const ShapeId shape = shapes_[place].shape;
    shapes_[place] = shapes_[same->first];
    shapes_[place].shape = shape;
    are_spheres_tied_ = true;
  }

  /// A box that is sheared has no edges that another one could share.
  void add(const Box& box, std::size_t place) {
    const Transform<double>& placed = shapes_[place].world_from_object;
    const Vec3d origin = formulas::transform_point(placed.inverse, center_);
    EdgedBox edged{place, {}, {}, {}, largest(Vec3d(placed.matrix[3])), is_glass(place)};
    for (int k = 0; k < 3; ++k) {
      const double length = glm::length(Vec3d(placed.matrix[k]));
      edged.axes[static_cast<std::size_t>(k)] = Vec3d(placed.matrix[k]) / length;
      edged.low[k] = length * (box.min[k] - origin[k]);
      edged.high[k] = length * (box.max[k] - origin[k]);
      edged.size = std::max({edged.size, length * std::abs(box.min[k]), length * std::abs(box.max[k]),
                             length * std::abs(origin[k])});
    }
    if (!are_orthonormal(edged.axes)) return;
    turn_forward(edged);
    frames_.settle(edged);
    edged.has_eye_inside = has_inside(edged, eye_);
    boxes_.push_back(edged);
  }

  static bool has_inside(const EdgedBox& box, const Vec3d& point) {
    for (int k = 0; k < 3; ++k) {
      const double c = glm::dot(box.axes[static_cast<std::size_t>(k)], point);
      if (c < box.low[k] || c > box.high[k]) return false;
    }
    return true;
  }

  bool is_glass(std::size_t place) const {
    return scene_.materials[*material_of(scene_.shapes[shapes_[place].shape])].transmits();
  }

  void write(const EdgedBox& box) {
    PlacedShape& shape = shapes_[box.place];
    const MaterialId material = std::get<Box>(shape.geometry).material;
    shape.geometry = Box{box.low, box.high, material};
    Mat3d linear(box.axes[0], box.axes[1], box.axes[2]);
    shape.world_from_object = {Mat4<double>(linear), Mat4<double>(glm::transpose(linear))};
    shape.is_centered = true;
  }

  const Scene& scene_;
  Vec3d eye_;  // about the centre
  Vec3d center_;
  std::vector<PlacedShape>& shapes_;
  std::vector<std::pair<std::size_t, Ellipsoid>> spheres_;  // the first at each place
  bool are_spheres_tied_ = false;
  std::vector<EdgedBox> boxes_;
  Frames frames_;
};

}  // namespace

std::vector<PlacedShape> placed_shapes(const Scene& scene) {
  std::vector<PlacedShape> shapes;
  for_each_instance(scene, [&](const Instance& instance) {
    const auto add = [&](const auto& geometry) {
      shapes.push_back({instance.shape, geometry, instance.world_from_object});
    };
    std::visit(EachKind{[&](const Sphere& sphere) { add(sphere); }, [&](const Box& box) { add(box); },
                        [](const Composite&) {}},
               scene.shapes[instance.shape].geometry);
  });
  return shapes;
}

bool write_ties_alike(const Scene& scene, const Vec3d& eye, const Vec3d& center,
                      std::vector<PlacedShape>& shapes) {
  return Ties(scene, eye, center, shapes).write_alike();
}

}  // namespace plumb::exporters
