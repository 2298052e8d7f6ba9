#include "tracer/format/check_hierarchy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "tracer/format/reader.hpp"
#include "tracer/scene/hierarchy.hpp"
#include "tracer/text/words.hpp"

namespace plumb {
namespace {

bool is_finite(const Mat4<double>& m) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      if (!std::isfinite(m[column][row])) return false;
    }
  }
  return true;
}

/// Bounds of an affine map: the maximum norm of its linear part and of its translation; infinite, and never
/// NaN, where products may overflow.
struct Size {
  double linear = 1;
  double offset = 0;
};

constexpr double infinity = std::numeric_limits<double>::infinity();

/// True if no sum of four products of such numbers overflows on the way, rounding included.
bool is_safe(const Size& size) {
  constexpr double most = std::numeric_limits<double>::max() / 16;
  return size.linear <= most && size.offset <= most;
}

Size size_of(const Mat4<double>& m) {
  if (!is_finite(m)) return {infinity, infinity};
  Size size{0, 0};
  for (int row = 0; row < 3; ++row) {
    size.linear = std::max(size.linear, std::abs(m[0][row]) + std::abs(m[1][row]) + std::abs(m[2][row]));
    size.offset = std::max(size.offset, std::abs(m[3][row]));
  }
  return size;
}

/// Returns the bounds of `then` after `first`: |A2 A1| <= |A2| |A1| and |A2 t1 + t2| <= |A2| |t1| + |t2|.
Size composed(const Size& then, const Size& first) {
  const Size size{then.linear * first.linear, then.linear * first.offset + then.offset};
  return is_safe(size) ? size : Size{infinity, infinity};
}

Size larger(const Size& a, const Size& b) {
  return {std::max(a.linear, b.linear), std::max(a.offset, b.offset)};
}

/// The largest matrix and the largest inverse over all paths to a shape.
struct Reach {
  Size matrix{0, 0};
  Size inverse{0, 0};

  void include(const Reach& other) {
    matrix = larger(matrix, other.matrix);
    inverse = larger(inverse, other.inverse);
  }
  bool is_safe() const { return plumb::is_safe(matrix) && plumb::is_safe(inverse); }
};

Reach placed(const Shape& shape, const Reach& parent) {
  if (shape.transform.empty()) return parent;
  const Transform<double> here = transform_of<double>(shape.transform);
  return {composed(parent.matrix, size_of(here.matrix)), composed(size_of(here.inverse), parent.inverse)};
}

bool any_transforms(const Scene& scene) {
  return std::any_of(scene.shapes.begin(), scene.shapes.end(),
                     [](const Shape& s) { return !s.transform.empty(); });
}

HierarchyError cycle_error(const Scene& scene, const std::vector<ShapeId>& cycle) {
  constexpr std::size_t most_shown = 5;
  const auto name = [&](ShapeId id) { return in_quotes(scene.shapes[id].name); };
  std::string path = name(cycle[0]);
  for (std::size_t i = 1; i < std::min(cycle.size(), most_shown); ++i) path += " > " + name(cycle[i]);
  path += cycle.size() <= most_shown ? " > " + name(cycle[0]) : " > ...";
  return {cycle[0], "found a composite that contains itself (" + path +
                        "), expected no cycle; remove one of these children"};
}

std::string too_deep(std::size_t depth) {
  return "found composites nested " + std::to_string(depth) + " deep, expected at most " +
         std::to_string(max_nesting) + "; put children side by side";
}

std::string too_many() {
  return "found more than " + std::to_string(max_instances) +
         " spheres, boxes and composites (shared children counted each time), expected fewer";
}

/// Checks each root.
std::vector<HierarchyError> size_errors(const Scene& scene, const std::vector<ShapeId>& children_first) {
  std::vector<std::uint32_t> depth(scene.shapes.size(), 0);
  std::vector<std::uint64_t> count(scene.shapes.size(), 1);
  for (const ShapeId id : children_first) {
    for (const ShapeId child : children_of(scene.shapes[id])) {
      depth[id] = std::max(depth[id], depth[child] + 1);
      count[id] = saturating_add(count[id], count[child]);
    }
  }
  std::vector<HierarchyError> errors;
  std::uint64_t total = 0;
  for (const ShapeId root : scene.roots()) {
    const std::uint64_t before = total;
    total = saturating_add(total, count[root]);
    if (depth[root] > max_nesting) errors.push_back({root, too_deep(depth[root])});
    if (total > max_instances && before <= max_instances) errors.push_back({root, too_many()});
  }
  return errors;
}

HierarchyError overflow_error(const Scene& scene, ShapeId id, const char* verb) {
  return {id, "found a transform of " + in_quotes(scene.shapes[id].name) + " that " + verb +
                  ", expected a matrix and an inverse of finite numbers; use smaller factors"};
}

std::vector<HierarchyError> overflow_errors(const Scene& scene) {
  std::vector<HierarchyError> errors;
  const std::vector<ShapeId> suspects = shapes_that_may_overflow(scene);
  if (suspects.empty()) return errors;
  const bool is_known = count_nodes(scene) <= max_visited_instances;
  for (const ShapeId id : is_known ? shapes_that_overflow(scene) : suspects) {
    errors.push_back(overflow_error(scene, id, is_known ? "overflows" : "may overflow"));
  }
  return errors;
}

}  // namespace

std::vector<HierarchyError> check_hierarchy(const Scene& scene) {
  const CompositeOrder order = order_of_composites(scene);
  if (!order.cycle.empty()) return {cycle_error(scene, order.cycle)};
  std::vector<HierarchyError> errors;
  if (!order.children_first.empty() || scene.shapes.size() > max_instances)
    errors = size_errors(scene, order.children_first);
  return errors.empty() ? overflow_errors(scene) : errors;
}

std::vector<ShapeId> shapes_that_overflow(const Scene& scene) {
  std::vector<ShapeId> found;
  std::vector<bool> is_found(scene.shapes.size(), false);
  for_each_instance(scene, [&](const Instance& instance) {
    const auto& transform = instance.world_from_object;
    if (is_found[instance.shape] || (is_finite(transform.matrix) && is_finite(transform.inverse))) return;
    is_found[instance.shape] = true;
    found.push_back(instance.shape);
  });
  return found;
}

std::vector<ShapeId> shapes_that_may_overflow(const Scene& scene) {
  std::vector<ShapeId> found;
  if (!any_transforms(scene)) return found;
  std::unordered_map<ShapeId, Reach> reach;  // of composites
  std::vector<bool> is_found(scene.shapes.size(), false);
  const auto enter = [&](ShapeId id, const Reach& parent) {
    const Shape& shape = scene.shapes[id];
    if (material_of(shape) == nullptr) return reach[id].include(parent);
    if (!placed(shape, parent).is_safe()) is_found[id] = true;
  };
  for (const ShapeId root : scene.roots()) enter(root, {Size{}, Size{}});
  const std::vector<ShapeId> order = order_of_composites(scene).children_first;
  for (std::size_t i = order.size(); i-- > 0;) {
    const ShapeId id = order[i];
    const Reach here = placed(scene.shapes[id], reach[id]);
    for (const ShapeId child : children_of(scene.shapes[id])) enter(child, here);
  }
  for (ShapeId id = 0; id < scene.shapes.size(); ++id) {
    if (is_found[id]) found.push_back(id);
  }
  return found;
}

}  // namespace plumb
