#include "references/studies/needs/features.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "tracer/scene/each_kind.hpp"
#include "tracer/scene/hierarchy.hpp"

namespace plumb::studies {
namespace {

using textbook::RayKind;

/// A number in the scene, and how often it matters to the picture.
struct Use {
  std::size_t in_scene = 0;
  std::uint64_t seen = 0;
};

/// Returns the touches of each shape; a composite has those of its children.
std::vector<std::uint64_t> touches_of(const Scene& scene, const Observed& observed) {
  std::vector<std::uint64_t> touches;
  for (const Touches& t : observed.shapes) touches.push_back(t.hits() + t.blocked);
  for (const ShapeId id : order_of_composites(scene).children_first) {
    for (const ShapeId child : children_of(scene.shapes[id])) touches[id] += touches[child];
  }
  return touches;
}

class Survey {
 public:
  Survey(const Scene& scene, const Observed& observed)
      : scene_(scene), touches_(touches_of(scene, observed)) {}

  Use shapes(const auto& is_meant) const {
    Use use;
    for (ShapeId id = 0; id < scene_.shapes.size(); ++id) {
      if (!is_meant(scene_.shapes[id])) continue;
      ++use.in_scene;
      use.seen += touches_[id];
    }
    return use;
  }

  template <class Step>
  Use steps(const auto& is_meant) const {
    return shapes([&](const Shape& shape) {
      return std::any_of(shape.transform.begin(), shape.transform.end(), [&](const TransformStep& step) {
        const Step* const one = std::get_if<Step>(&step);
        return one != nullptr && is_meant(*one);
      });
    });
  }

  Use shared() const {
    std::vector<int> parents(scene_.shapes.size(), 0);
    for (const Shape& shape : scene_.shapes) {
      for (const ShapeId child : children_of(shape)) ++parents[child];
    }
    return shapes([&](const Shape& shape) {
      return parents[static_cast<std::size_t>(&shape - scene_.shapes.data())] > 1;
    });
  }

  std::size_t shapes_of_glass() const {
    return shapes([&](const Shape& shape) {
             const MaterialId* const id = material_of(shape);
             return id != nullptr && scene_.materials[*id].transmits();
           })
        .in_scene;
  }

  /// Materials that shapes are made of.
  std::size_t materials(const auto& is_meant) const {
    std::vector<bool> used(scene_.materials.size(), false);
    for (const Shape& shape : scene_.shapes) {
      if (const MaterialId* id = material_of(shape)) used[*id] = is_meant(scene_.materials[*id]);
    }
    return static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
  }

 private:
  const Scene& scene_;
  std::vector<std::uint64_t> touches_;
};

const auto any = [](const auto&) { return true; };

void add_light(std::vector<Feature>& rows, const Scene& scene, const RenderOptions& options,
               const Observed& seen, const Survey& survey) {
  const std::size_t lights = scene.lights.size();
  const auto materials = [&](bool is_lit, const auto& is_meant) {
    return is_lit ? survey.materials(is_meant) : 0;
  };
  const auto lit_by = static_cast<std::uint64_t>(
      std::count_if(seen.lights.begin(), seen.lights.end(), [](std::uint64_t times) { return times > 0; }));
  rows.push_back({"lambert", "Lambert", "diffuse light",
                  materials(lights > 0, [](const Material& m) { return m.kd != Rgbd(0); }), "material",
                  seen.diffuse, "times a light adds some"});
  rows.push_back({"ambient", "Ambient", "light from everywhere",
                  materials(scene.ambient != Rgbd(0), [](const Material& m) { return m.ka != Rgbd(0); }),
                  "material", seen.ambient, "hits"});
  rows.push_back({"phong", "Phong", "highlights",
                  materials(lights > 0, [](const Material& m) { return m.ks != Rgbd(0); }), "material",
                  seen.specular, "times a light adds one"});
  rows.push_back({"several-lights", "Vollständiges Modell", "several lights", lights > 1 ? lights : 0,
                  "light", lights > 1 ? lit_by : 0, "of them light something"});
  rows.push_back({"shadow", "Schatten", "shadows", options.shadows ? lights : 0, "light", seen.shadows,
                  "of " + std::to_string(seen.shadow_rays) + " shadow rays blocked"});
}

void add_secondary(std::vector<Feature>& rows, const Observed& seen, const Survey& survey) {
  const std::size_t mirrors = survey.materials([](const Material& m) { return m.mirrors(); });
  const std::size_t glass = survey.materials([](const Material& m) { return m.transmits(); });
  const std::size_t glass_shapes = survey.shapes_of_glass();
  const std::uint64_t through = seen.of(RayKind::refracted) + seen.of(RayKind::unbent);
  const std::uint64_t total = seen.of(RayKind::totally_reflected);
  const auto deep = static_cast<std::uint64_t>(seen.deepest);
  rows.push_back(
      {"mirror", "Spiegelung", "mirrors", mirrors, "material", seen.of(RayKind::mirrored), "rays"});
  rows.push_back({"refraction", "Brechung", "refraction", glass, "material", through, "rays"});
  rows.push_back({"total-reflection", "Brechung", "total reflection", glass, "material", total, "rays"});
  rows.push_back({"nested-glass", "Brechung", "glass in glass", glass_shapes > 1 ? glass_shapes : 0, "shape",
                  seen.nested, "rays inside two or more"});
  rows.push_back({"recursion", "Spiegelung, Brechung", "recursion", mirrors + glass, "material", deep,
                  "is the depth of the deepest ray"});
}

using Geometry = decltype(Shape::geometry);

/// What a row says of a kind of shapes.
struct KindInWords {
  const char *id, *slide, *what;
};

/// Nothing for composites, whose row comes after those of the transforms.
std::optional<KindInWords> in_words(const Geometry& kind) {
  using Said = std::optional<KindInWords>;
  return std::visit(EachKind{[](const Sphere&) -> Said {
                               return KindInWords{"sphere", "Kugel", "spheres"};
                             },
                             [](const Box&) -> Said {
                               return KindInWords{"box", "Quader", "boxes"};
                             },
                             [](const Composite&) -> Said { return std::nullopt; }},
                    kind);
}

template <std::size_t... kind>
std::vector<Geometry> one_of_each_kind(std::index_sequence<kind...>) {
  return {Geometry(std::in_place_index<kind>)...};
}

void add_shapes(std::vector<Feature>& rows, const Survey& survey) {
  const auto add = [&](const char* id, const char* slide, const char* what, const Use& use) {
    rows.push_back({id, slide, what, use.in_scene, "shape", use.seen, "touches by rays"});
  };
  const auto is_uniform = [](const Scale& s) { return s.by.x == s.by.y && s.by.y == s.by.z; };
  for (const Geometry& kind : one_of_each_kind(std::make_index_sequence<std::variant_size_v<Geometry>>())) {
    const auto said = in_words(kind);
    if (!said) continue;
    add(said->id, said->slide, said->what,
        survey.shapes([&](const Shape& s) { return s.geometry.index() == kind.index(); }));
  }
  add("translate", "Transformationen", "translation", survey.steps<Translate>(any));
  add("rotate", "Transformationen", "rotation", survey.steps<Rotate>(any));
  add("scale", "Transformationen", "even scaling", survey.steps<Scale>(is_uniform));
  add("scale-nonuniform", "Transformationen", "uneven scaling",
      survey.steps<Scale>([&](const Scale& s) { return !is_uniform(s); }));
  add("composed", "Zusammengesetzt, Inverse", "several transforms",
      survey.shapes([](const Shape& s) { return s.transform.size() > 1; }));
  add("composite", "Composite, DAG", "composites", survey.shapes(&is_composite));
  add("sharing", "Composite, DAG", "sharing by several parents", survey.shared());
}

void add_camera(std::vector<Feature>& rows, const Camera& camera, const Observed& seen) {
  const Camera usual;
  const bool is_placed =
      camera.eye != usual.eye || camera.direction != usual.direction || camera.up != usual.up;
  const auto rays = [&](bool has) { return has ? seen.of(RayKind::camera) : 0; };
  rows.push_back({"camera-placed", "Kameratransformation", "eye, direction, up", is_placed ? 1U : 0U,
                  "camera", rays(is_placed), "rays"});
  rows.push_back({"camera-transform", "Kameratransformation", "camera moved by transforms",
                  camera.transform.size(), "step", rays(!camera.transform.empty()), "rays"});
}

}  // namespace

std::vector<Feature> features_of(const Scene& scene, const Camera& camera, const RenderOptions& options,
                                 const Observed& observed) {
  const Survey survey(scene, observed);
  std::vector<Feature> rows;
  rows.push_back({"background", "Verfolgen von Strahlen", "background", 1, "colour", observed.background,
                  "rays meet nothing"});
  add_light(rows, scene, options, observed, survey);
  add_secondary(rows, observed, survey);
  add_shapes(rows, survey);
  add_camera(rows, camera, observed);
  return rows;
}

}  // namespace plumb::studies
