#include "tracer/scene/scene.hpp"

#include <stdexcept>

#include "tracer/scene/each_kind.hpp"
#include "tracer/text/words.hpp"

namespace plumb {

std::vector<ShapeId> Scene::roots() const {
  std::vector<bool> is_child(shapes.size(), false);
  for (const Shape& shape : shapes) {
    if (const auto* composite = std::get_if<Composite>(&shape.geometry)) {
      for (const ShapeId child : composite->children) is_child[child] = true;
    }
  }
  std::vector<ShapeId> found;
  for (ShapeId id = 0; id < shapes.size(); ++id) {
    if (!is_child[id]) found.push_back(id);
  }
  return found;
}

const Camera& Scene::camera(const std::string& name) const {
  std::string known;
  for (const Camera& candidate : cameras) {
    if (candidate.name == name) return candidate;
    known += (known.empty() ? "" : ", ") + in_quotes(candidate.name);
  }
  throw std::invalid_argument("no camera " + in_quotes(name) + " in the scene; it has " + known);
}

const MaterialId* material_of(const Shape& shape) {
  return std::visit(EachKind{[](const Sphere& sphere) { return &sphere.material; },
                             [](const Box& box) { return &box.material; },
                             [](const Composite&) -> const MaterialId* { return nullptr; }},
                    shape.geometry);
}

}  // namespace plumb
