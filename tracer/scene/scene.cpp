#include "tracer/scene/scene.hpp"

#include <stdexcept>
#include <type_traits>
#include <utility>

#include "tracer/scene/each_kind.hpp"
#include "tracer/text/words.hpp"

namespace plumb {

std::vector<ShapeId> Scene::roots() const {
  std::vector<bool> is_child(shapes.size(), false);
  for (const Shape& shape : shapes) {
    for (const ShapeId child : children_of(shape)) is_child[child] = true;
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

namespace {

/// Null for what has none. A shape that may not be changed gives children that may not.
template <class AnyShape>
auto own_children(AnyShape& shape) {
  using AnyComposite = std::conditional_t<std::is_const_v<AnyShape>, const Composite, Composite>;
  using Children = decltype(&std::declval<AnyComposite&>().children);
  return std::visit(EachKind{[](const Sphere&) -> Children { return nullptr; },
                             [](const Box&) -> Children { return nullptr; },
                             [](AnyComposite& composite) -> Children { return &composite.children; }},
                    shape.geometry);
}

}  // namespace

std::vector<ShapeId>* own_children_of(Shape& shape) { return own_children(shape); }

const std::vector<ShapeId>& children_of(const Shape& shape) {
  static const std::vector<ShapeId> none;
  const auto* const own = own_children(shape);
  return own == nullptr ? none : *own;
}

bool is_composite(const Shape& shape) { return material_of(shape) == nullptr; }

}  // namespace plumb
