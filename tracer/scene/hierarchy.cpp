#include "tracer/scene/hierarchy.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "tracer/scene/scene_error.hpp"

namespace plumb {
namespace {

/// Depth first without recursion: what is read may be nested as deep as the file is long.
class OrderSearch {
 public:
  explicit OrderSearch(const Scene& scene) : scene_(scene), state_(scene.shapes.size(), State::unseen) {}

  CompositeOrder run() {
    for (ShapeId id = 0; id < scene_.shapes.size() && found_.cycle.empty(); ++id) {
      if (is_new(id)) descend(id);
    }
    return std::move(found_);
  }

 private:
  enum class State : std::uint8_t { unseen, open, done };
  struct Step {
    ShapeId id;
    std::size_t next_child;
  };

  bool is_new(ShapeId id) const { return state_[id] == State::unseen && is_composite(scene_.shapes[id]); }

  void descend(ShapeId root) {
    open(root);
    while (!path_.empty() && found_.cycle.empty()) {
      Step& top = path_.back();
      const auto& children = children_of(scene_.shapes[top.id]);
      if (top.next_child == children.size()) {
        state_[top.id] = State::done;
        found_.children_first.push_back(top.id);
        path_.pop_back();
      } else if (const ShapeId child = children[top.next_child++]; state_[child] == State::open) {
        close_cycle(child);
      } else if (is_new(child)) {
        open(child);
      }
    }
  }

  void open(ShapeId id) {
    state_[id] = State::open;
    path_.push_back({id, 0});
  }

  void close_cycle(ShapeId first) {
    const auto from = std::find_if(path_.begin(), path_.end(), [&](const Step& s) { return s.id == first; });
    for (auto step = from; step != path_.end(); ++step) found_.cycle.push_back(step->id);
  }

  const Scene& scene_;
  std::vector<State> state_;
  std::vector<Step> path_;
  CompositeOrder found_;
};

std::vector<std::uint64_t> count_below(const Scene& scene, std::uint64_t of_composite) {
  std::vector<std::uint64_t> count(scene.shapes.size(), 1);
  for (const ShapeId id : order_of_composites(scene).children_first) {
    count[id] = of_composite;
    for (const ShapeId child : children_of(scene.shapes[id]))
      count[id] = saturating_add(count[id], count[child]);
  }
  return count;
}

void refuse_to_visit_too_many(const Scene& scene) {
  const std::uint64_t nodes = count_nodes(scene);
  if (nodes <= max_visited_instances) return;
  throw SceneError("found " + std::to_string(nodes) +
                   " spheres, boxes and composites (shared children counted each time), expected at most " +
                   std::to_string(max_visited_instances) +
                   " where each has to be visited; render it with the engine, which does not");
}

}  // namespace

CompositeOrder order_of_composites(const Scene& scene) { return OrderSearch(scene).run(); }

std::uint64_t saturating_add(std::uint64_t a, std::uint64_t b) {
  constexpr auto most = std::numeric_limits<std::uint64_t>::max();
  return a > most - b ? most : a + b;
}

std::vector<std::uint64_t> count_instances(const Scene& scene) { return count_below(scene, 0); }

std::uint64_t count_nodes(const Scene& scene) {
  const std::vector<std::uint64_t> count = count_below(scene, 1);
  std::uint64_t total = 0;
  for (const ShapeId root : scene.roots()) total = saturating_add(total, count[root]);
  return total;
}

void for_each_instance(const Scene& scene, const std::function<void(const Instance&)>& use) {
  refuse_to_visit_too_many(scene);
  std::vector<Transform<double>> parent_from_object;
  parent_from_object.reserve(scene.shapes.size());
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

InstanceShapes::InstanceShapes(const Scene& scene)
    : scene_(scene), roots_(scene.roots()), counts_(count_instances(scene)) {}

ShapeId InstanceShapes::at(std::uint64_t instance) const {
  const std::vector<ShapeId>* among = &roots_;
  for (auto next = among->begin(); next != among->end();) {
    if (instance >= counts_[*next]) {
      instance -= counts_[*next++];
    } else if (material_of(scene_.shapes[*next]) != nullptr) {
      return *next;
    } else {
      among = &children_of(scene_.shapes[*next]);
      next = among->begin();
    }
  }
  throw std::out_of_range("no instance of that number in the scene");
}

}  // namespace plumb
