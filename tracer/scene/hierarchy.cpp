#include "tracer/scene/hierarchy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tracer/scene/lexer.hpp"
#include "tracer/scene/reader.hpp"

namespace plumb {
namespace {

const std::vector<ShapeId>& children_of(const Shape& shape) {
  static const std::vector<ShapeId> none;
  const auto* composite = std::get_if<Composite>(&shape.geometry);
  return composite == nullptr ? none : composite->children;
}

/// Shapes with every child before its parents (Kahn, "Topological sorting of large networks", 1962);
/// shorter than the scene when there is a cycle.
std::vector<ShapeId> children_first(const Scene& scene) {
  std::vector<std::vector<ShapeId>> parents(scene.shapes.size());
  std::vector<std::size_t> waiting_for(scene.shapes.size());
  std::vector<ShapeId> order;
  for (ShapeId id = 0; id < scene.shapes.size(); ++id) {
    for (const ShapeId child : children_of(scene.shapes[id])) parents[child].push_back(id);
    waiting_for[id] = children_of(scene.shapes[id]).size();
    if (waiting_for[id] == 0) order.push_back(id);
  }
  for (std::size_t next = 0; next < order.size(); ++next) {
    for (const ShapeId parent : parents[order[next]]) {
      if (--waiting_for[parent] == 0) order.push_back(parent);
    }
  }
  return order;
}

bool is_finite(const Mat4<double>& m) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      if (!std::isfinite(m[column][row])) return false;
    }
  }
  return true;
}

std::vector<std::size_t> depth_below(const Scene& scene, const std::vector<ShapeId>& order) {
  std::vector<std::size_t> depth(scene.shapes.size(), 0);
  for (const ShapeId id : order) {
    for (const ShapeId child : children_of(scene.shapes[id]))
      depth[id] = std::max(depth[id], depth[child] + 1);
  }
  return depth;
}

std::uint64_t saturating_add(std::uint64_t a, std::uint64_t b) {
  constexpr auto most = std::numeric_limits<std::uint64_t>::max();
  return a > most - b ? most : a + b;
}

std::vector<std::uint64_t> count_instances(const Scene& scene, const std::vector<ShapeId>& order,
                                           bool every_node) {
  std::vector<std::uint64_t> count(scene.shapes.size(), 0);
  for (const ShapeId id : order) {
    count[id] = every_node || material_of(scene.shapes[id]) != nullptr ? 1 : 0;
    for (const ShapeId child : children_of(scene.shapes[id]))
      count[id] = saturating_add(count[id], count[child]);
  }
  return count;
}

HierarchyError cycle_error(const Scene& scene, const std::vector<ShapeId>& order) {
  std::vector<bool> is_sorted(scene.shapes.size(), false);
  for (const ShapeId id : order) is_sorted[id] = true;
  // Every shape that is left has a child that is left: following them must come round.
  ShapeId at = static_cast<ShapeId>(std::find(is_sorted.begin(), is_sorted.end(), false) - is_sorted.begin());
  std::vector<bool> is_seen(scene.shapes.size(), false);
  const auto next = [&](ShapeId id) {
    const auto& children = children_of(scene.shapes[id]);
    return *std::find_if(children.begin(), children.end(), [&](ShapeId child) { return !is_sorted[child]; });
  };
  for (; !is_seen[at]; at = next(at)) is_seen[at] = true;
  std::string path = in_quotes(scene.shapes[at].name);
  ShapeId step = next(at);
  for (std::size_t shown = 0; step != at && shown < 4; ++shown, step = next(step)) {
    path += " > " + in_quotes(scene.shapes[step].name);
  }
  path += step == at ? " > " + in_quotes(scene.shapes[at].name) : " > ...";
  return {at, "found a composite that contains itself (" + path +
                  "), expected no cycle; remove one of these children"};
}

}  // namespace

std::vector<std::uint64_t> count_instances(const Scene& scene) {
  return count_instances(scene, children_first(scene), false);
}

std::vector<HierarchyError> check_hierarchy(const Scene& scene) {
  const std::vector<ShapeId> order = children_first(scene);
  if (order.size() < scene.shapes.size()) return {cycle_error(scene, order)};
  const auto depth = depth_below(scene, order);
  const auto count = count_instances(scene, order, true);
  std::vector<HierarchyError> errors;
  std::uint64_t total = 0;
  for (const ShapeId root : scene.roots()) {
    total = saturating_add(total, count[root]);
    if (depth[root] > max_nesting) {
      errors.push_back({root, "found composites nested " + std::to_string(depth[root]) +
                                  " deep, expected at most " + std::to_string(max_nesting) +
                                  "; put children side by side"});
    }
    if (total > max_instances && total - count[root] <= max_instances) {
      errors.push_back(
          {root, "found more than " + std::to_string(max_instances) +
                     " spheres, boxes and composites (shared children counted each time), expected fewer"});
    }
  }
  if (!errors.empty()) return errors;
  std::vector<bool> is_reported(scene.shapes.size(), false);
  for_each_instance(scene, [&](const Instance& instance) {
    const auto& transform = instance.world_from_object;
    if (is_reported[instance.shape] || (is_finite(transform.matrix) && is_finite(transform.inverse))) return;
    is_reported[instance.shape] = true;
    errors.push_back(
        {instance.shape,
         "found a transform of " + in_quotes(scene.shapes[instance.shape].name) +
             " that overflows, expected a matrix and an inverse of finite numbers; use smaller factors"});
  });
  return errors;
}

void for_each_instance(const Scene& scene, const std::function<void(const Instance&)>& use) {
  std::vector<Transform<double>> parent_from_object;
  for (const Shape& shape : scene.shapes) parent_from_object.push_back(transform_of<double>(shape.transform));
  const auto visit = [&](const auto& self, ShapeId id, const Transform<double>& parent) -> void {
    const Shape& shape = scene.shapes[id];
    const Transform<double> here =
        shape.transform.empty() ? parent : formulas::compose(parent, parent_from_object[id]);
    if (material_of(shape) != nullptr) return use({id, here});
    for (const ShapeId child : children_of(shape)) self(self, child, here);
  };
  for (const ShapeId root : scene.roots()) visit(visit, root, Transform<double>{});
}

}  // namespace plumb
