#include <algorithm>
#include <cmath>

#include "tracer/format/check_hierarchy.hpp"
#include "tracer/format/draft.hpp"
#include "tracer/scene/each_kind.hpp"
#include "tracer/scene/lights_on_surfaces.hpp"
#include "tracer/text/numbers.hpp"
#include "tracer/text/words.hpp"

namespace plumb {
namespace {

/// Returns the names that may have been meant; none after many unknown names, because each search looks at
/// all.
std::vector<std::string_view> known_names(const Draft& draft, std::initializer_list<const Names*> kinds) {
  constexpr int most_suggestions = 20;
  std::vector<std::string_view> known;
  if (draft.unknown_names >= most_suggestions) return known;
  for (const Names* names : kinds) {
    const auto all = names->all();
    known.insert(known.end(), all.begin(), all.end());
  }
  return known;
}

void report_unknown(Draft& draft, const std::vector<std::string_view>& known, const Reference& reference,
                    const char* what) {
  ++draft.unknown_names;
  const auto nearest = nearest_name(reference.name, known);
  draft.say(Severity::error, reference.place,
            "found " + in_quotes(reference.name) + ", expected the name of a " + what + " that is defined; " +
                (nearest ? "did you mean " + in_quotes(*nearest) + "?" : "define it"));
}

template <class Use>
void look_up(Draft& draft, const Names& names, const Reference& reference, const char* what, Use use) {
  if (const auto id = names.find(reference.name)) {
    use(*id);
  } else {
    report_unknown(draft, known_names(draft, {&names}), reference, what);
  }
}

bool is_broken(const Draft& draft, std::string_view name) {
  return draft.broken_shapes.contains(name) && !draft.shape_names.find(name);
}

void set_material(Shape& shape, MaterialId material) {
  std::visit(EachKind{[&](Sphere& sphere) { sphere.material = material; },
                      [&](Box& box) { box.material = material; }, [](Composite&) {}},
             shape.geometry);
}

void resolve_materials(Draft& draft) {
  for (const Draft::MaterialUse& use : draft.material_uses) {
    look_up(draft, draft.material_names, use.material, "material",
            [&](MaterialId material) { set_material(draft.scene.shapes[use.shape], material); });
  }
}

void resolve_children(Draft& draft) {
  for (const Draft::ChildUse& use : draft.child_uses) {
    if (is_broken(draft, use.child.name)) continue;
    auto& composite = std::get<Composite>(draft.scene.shapes[use.composite].geometry);
    look_up(draft, draft.shape_names, use.child, "shape",
            [&](ShapeId child) { composite.children.push_back(child); });
  }
}

/// Puts steps into the order in which they act, from the order of the lines.
void put_in_order_of_action(std::vector<TransformStep>& lines, TransformOrder order) {
  if (order == TransformOrder::post) std::reverse(lines.begin(), lines.end());
  if (order == TransformOrder::trs) {
    const auto rank = [](const TransformStep& s) {
      return std::visit(EachKind{[](const Scale&) { return 0; }, [](const Rotate&) { return 1; },
                                 [](const Translate&) { return 2; }},
                        s);
    };
    std::stable_sort(lines.begin(), lines.end(),
                     [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  }
}

void resolve_transforms(Draft& draft, TransformOrder order) {
  for (const Draft::TransformLine& line : draft.transforms) {
    const auto camera = draft.camera_names.find(line.target.name);
    const auto shape = draft.shape_names.find(line.target.name);
    if (camera && shape) {
      draft.say(Severity::error, line.target.place,
                "found " + in_quotes(line.target.name) +
                    ", expected a name that is not both a camera and a shape; rename one");
    } else if (camera) {
      draft.scene.cameras[*camera].transform.push_back(line.step);
    } else if (shape) {
      draft.scene.shapes[*shape].transform.push_back(line.step);
    } else if (!is_broken(draft, line.target.name)) {
      report_unknown(draft, known_names(draft, {&draft.shape_names, &draft.camera_names}), line.target,
                     "shape or camera");
    }
  }
  if (order == TransformOrder::pre) return;
  for (Shape& shape : draft.scene.shapes) put_in_order_of_action(shape.transform, order);
  for (Camera& camera : draft.scene.cameras) put_in_order_of_action(camera.transform, order);
}

void check_pose(Draft& draft, const Camera& camera, Place place) {
  constexpr double least_sine_squared = 1e-24;  // below it, u = n x up is made of rounding errors
  const auto pose = pose_of<double>(camera);
  const Vec3d side = glm::cross(glm::normalize(pose.direction), glm::normalize(pose.up));
  const double sine_squared = glm::dot(side, side);
  const bool is_finite = std::isfinite(glm::dot(pose.eye, pose.eye)) && std::isfinite(sine_squared);
  if (is_finite && sine_squared > least_sine_squared) return;
  const char* what =
      "a direction and an up vector that are parallel or not finite, expected two directions; try "
      "0 1 0 or 0 0 1 as up";
  if (camera.up == Vec3d(0)) what = "an up vector of 0 0 0, expected a direction; 0 1 0 is upwards";
  if (camera.direction == Vec3d(0))
    what = "a direction of 0 0 0, expected a direction; 0 0 -1 looks along -z";
  draft.say(Severity::error, place, "found camera " + in_quotes(camera.name) + " with " + what);
}

void resolve_cameras(Draft& draft) {
  Scene& scene = draft.scene;
  if (scene.cameras.empty()) {
    const Place end{draft.last_line, 1};
    scene.cameras.emplace_back();
    draft.camera_names.define("default", 0, 0);
    draft.cameras.push_back(end);
    draft.say(Severity::warning, end,
              "no camera: one named 'default' at the origin, looking along -z, fov-x 45");
  }
  for (std::size_t id = 0; id < scene.cameras.size(); ++id) {
    check_pose(draft, scene.cameras[id], draft.cameras[id]);
  }
}

/// Takes the size that stands behind a camera's numbers, if there is one.
void take_resolution(Draft& draft, RenderRequest& request) {
  if (!draft.camera_resolution) return;
  const auto& [width, height, place] = *draft.camera_resolution;
  const auto is_side = [](double x) { return x >= 1 && x <= largest_side && x == std::floor(x); };
  if (is_side(width) && is_side(height) && width * height <= largest_pixel_count) {
    request.width = static_cast<int>(width);
    request.height = static_cast<int>(height);
  } else {
    draft.say(Severity::error, place,
              "found a resolution that is no size of a picture, expected whole numbers of pixels from 1 to " +
                  std::to_string(largest_side));
  }
}

RenderRequest default_render(Draft& draft) {
  RenderRequest request;
  request.camera = draft.scene.cameras.front().name;
  if (!draft.camera_resolution && !draft.has_render_line) {
    draft.say(Severity::warning, {draft.last_line, 1},
              "no render: camera '" + request.camera + "', image.ppm, 480 x 320 are taken");
  }
  take_resolution(draft, request);
  return request;
}

void resolve_renders(Draft& draft) {
  Scene& scene = draft.scene;
  for (Draft::RenderLine& line : draft.renders) {
    if (!line.has_size) {
      if (!draft.camera_resolution)
        draft.say(Severity::warning, line.camera.place, "no size given: 480 x 320");
      take_resolution(draft, line.request);
    }
    if (!line.camera.name.empty()) {
      look_up(draft, draft.camera_names, line.camera, "camera",
              [&](std::size_t id) { line.request.camera = scene.cameras[id].name; });
    } else {
      line.request.camera = scene.cameras.front().name;
      if (scene.cameras.size() > 1) {
        draft.say(Severity::warning, line.camera.place,
                  "no camera named: the first one, '" + line.request.camera + "'");
      }
    }
    scene.renders.push_back(line.request);
  }
  if (scene.renders.size() > 1) {
    draft.say(Severity::warning, draft.renders[1].camera.place, "more than one render: the first one counts");
  }
  if (scene.renders.empty()) scene.renders.push_back(default_render(draft));
}

void resolve_refraction(Draft& draft) {
  for (MaterialId id = 0; id < draft.scene.materials.size(); ++id) {
    Material& material = draft.scene.materials[id];
    const double eta = static_cast<double>(static_cast<float>(material.eta));  // decision: float32
    const bool is_index = eta > 0 && std::isfinite(eta);
    if (material.transmits() && !is_index) {
      draft.say(Severity::error, draft.materials[id],
                "found " + in_quotes(material.name) + " with refractive index " + to_text(material.eta) +
                    ", expected one > 0 for a material that transmits; glass has 1.5");
    }
    material.eta = is_index ? eta : 1;
  }
}

void check_graph(Draft& draft) {
  for (HierarchyError& error : check_hierarchy(draft.scene)) {
    draft.say(Severity::error, draft.shapes[error.shape], std::move(error.message));
  }
}

void warn_of_emptiness(Draft& draft) {
  const Place end{draft.last_line, 1};
  if (draft.scene.shapes.empty() && !draft.has_errors()) {
    draft.say(Severity::warning, end, "no shapes: the picture is background only");
  }
  const bool any_scatters = std::any_of(draft.scene.materials.begin(), draft.scene.materials.end(),
                                        [](const Material& m) { return m.kd != Rgbd(0) || m.ks != Rgbd(0); });
  if (draft.scene.lights.empty() && !draft.scene.shapes.empty() && any_scatters) {
    draft.say(Severity::warning, end,
              draft.scene.ambient == Rgbd(0) ? "no lights and no ambient light: all shapes are black"
                                             : "no lights: only ambient light is seen");
  }
}

void warn_of_lights_on_surfaces(Draft& draft) {
  if (draft.has_errors()) return;
  for (const LightOnSurface& found : lights_on_surfaces(draft.scene)) {
    draft.say(Severity::warning, draft.lights[found.light],
              "light " + in_quotes(draft.scene.lights[found.light].name) +
                  " lies exactly on the surface of " + in_quotes(draft.scene.shapes[found.shape].name) +
                  ": at each point rounding decides whether that shape hides it; move it off the surface");
  }
}

}  // namespace

void Draft::use_material(ShapeId shape, const Reference& material) {
  if (const auto id = material_names.find(material.name)) {
    set_material(scene.shapes[shape], *id);
  } else {
    material_uses.push_back({shape, material});
  }
}

bool Draft::has_errors() const {
  return std::any_of(findings.begin(), findings.end(),
                     [](const Finding& f) { return f.severity == Severity::error; });
}

void resolve(Draft& draft, TransformOrder order) {
  if (draft.ambient_of_lights != Rgbd(0)) draft.scene.ambient += draft.ambient_of_lights;
  resolve_materials(draft);
  resolve_children(draft);
  resolve_transforms(draft, order);
  resolve_cameras(draft);
  resolve_renders(draft);
  resolve_refraction(draft);
  check_graph(draft);
  warn_of_emptiness(draft);
  warn_of_lights_on_surfaces(draft);
}

}  // namespace plumb
