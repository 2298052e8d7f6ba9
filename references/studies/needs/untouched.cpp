#include "references/studies/needs/untouched.hpp"

#include <algorithm>

#include "tracer/scene/hierarchy.hpp"

namespace plumb::studies {
namespace {

bool is_touched(const Scene& scene, ShapeId id, const Observed& observed, const RenderOptions& options) {
  const Material& material = scene.materials[*material_of(scene.shapes[id])];
  return observed.shapes[id].any() || (options.glass_shadow == GlassShadow::filtered && material.transmits());
}

/// Tells for each ShapeId if it is touched. A composite is when one of its children is.
std::vector<bool> touched_shapes(const Scene& scene, const Observed& observed, const RenderOptions& options) {
  std::vector<bool> touched(scene.shapes.size(), false);
  for (ShapeId id = 0; id < scene.shapes.size(); ++id) {
    if (material_of(scene.shapes[id]) != nullptr) touched[id] = is_touched(scene, id, observed, options);
  }
  for (const ShapeId id : order_of_composites(scene).children_first) {
    for (const ShapeId child : children_of(scene.shapes[id])) touched[id] = touched[id] || touched[child];
  }
  return touched;
}

std::vector<bool> met_materials(const Scene& scene, const Observed& observed) {
  std::vector<bool> met(scene.materials.size(), false);
  for (ShapeId id = 0; id < scene.shapes.size(); ++id) {
    const MaterialId* const material = material_of(scene.shapes[id]);
    if (material != nullptr && observed.shapes[id].hits() > 0) met[*material] = true;
  }
  return met;
}

template <class Places>
bool has(const Places& places, std::size_t place) {
  return std::find(places.begin(), places.end(), place) != places.end();
}

}  // namespace

Untouched untouched_by(const Scene& scene, const Observed& observed, const RenderOptions& options) {
  Untouched found;
  const std::vector<bool> touched = touched_shapes(scene, observed, options);
  for (ShapeId id = 0; id < touched.size(); ++id) {
    if (!touched[id]) found.shapes.push_back(id);
  }
  const std::vector<bool> met = met_materials(scene, observed);
  for (MaterialId id = 0; id < met.size(); ++id) {
    if (!met[id]) found.materials.push_back(id);
  }
  for (std::size_t i = 0; i < observed.lights.size(); ++i) {
    if (observed.lights[i] == 0) found.lights.push_back(i);
  }
  return found;
}

Scene without(const Scene& scene, const Untouched& untouched) {
  Scene rest = scene;
  rest.shapes.clear();
  rest.lights.clear();
  std::vector<bool> is_gone(scene.shapes.size(), false);
  for (const ShapeId id : untouched.shapes) is_gone[id] = true;
  std::vector<ShapeId> place(scene.shapes.size());
  for (ShapeId id = 0; id < scene.shapes.size(); ++id) {
    place[id] = rest.shapes.size();
    if (!is_gone[id]) rest.shapes.push_back(scene.shapes[id]);
  }
  for (Shape& shape : rest.shapes) {
    auto* const children = own_children_of(shape);
    if (children == nullptr) continue;
    std::erase_if(*children, [&](ShapeId child) { return is_gone[child]; });
    for (ShapeId& child : *children) child = place[child];
  }
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    if (!has(untouched.lights, i)) rest.lights.push_back(scene.lights[i]);
  }
  return rest;
}

}  // namespace plumb::studies
