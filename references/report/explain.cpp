#include "references/report/explain.hpp"

#include <array>

#include "references/comparison/comparison.hpp"
#include "references/report/formatted.hpp"
#include "tracer/scene/each_kind.hpp"
#include "tracer/scene/hierarchy.hpp"
#include "tracer/text/words.hpp"

namespace plumb::report {
namespace {

using Json = nlohmann::ordered_json;
using textbook::LightSeen;
using textbook::RayKind;

struct KindWords {
  const char* name;
  const char* slide;
};

KindWords words_of(RayKind kind) {
  switch (kind) {
    case RayKind::camera:
      return {"camera ray", "Kameramodell, Kameratransformation"};
    case RayKind::mirrored:
      return {"mirrored ray", "Spiegelung: r = d - 2 (d.n) n"};
    case RayKind::refracted:
      return {"refracted ray", "Brechung: sin t = (eta1/eta2) sin i"};
    case RayKind::totally_reflected:
      return {"totally reflected ray", "Brechung: total reflection, weight 1"};
    case RayKind::unbent:
      break;
  }
  return {"unbent ray", "Brechung: equal refractive indices"};
}

/// What the lights and the ambient light give at a meeting; the formulas as the slides have them.
class Terms {
 public:
  Terms(const Scene& scene, const attribution::Meeting& meeting)
      : scene_(scene),
        shape_(scene.shapes[meeting.shape]),
        material_(scene.materials[*material_of(shape_)]),
        meeting_(meeting) {}

  const Shape& shape() const { return shape_; }
  const Material& material() const { return material_; }
  const char* slide() const {
    return std::visit(EachKind{[](const Sphere&) { return "Kugel"; }, [](const Box&) { return "Quader"; },
                               [](const Composite&) { return "Composite, DAG"; }},
                      shape_.geometry);
  }
  Rgbd ambient() const { return scene_.ambient * material_.ka; }
  Rgbd diffuse(std::size_t i) const {
    const LightSeen<double>& seen = meeting_.lights[i];
    return light(i).intensity() * seen.delta * material_.kd * seen.cos_theta;
  }
  Rgbd specular(std::size_t i) const {
    const LightSeen<double>& seen = meeting_.lights[i];
    return light(i).intensity() * seen.delta * material_.ks * seen.specular_factor;
  }
  Rgbd local() const {
    Rgbd sum = ambient();
    for (std::size_t i = 0; i < meeting_.lights.size(); ++i) {
      if (meeting_.lights[i].counts) sum += diffuse(i) + specular(i);
    }
    return sum;
  }
  const Light& light(std::size_t i) const { return scene_.lights[i]; }
  static bool is_hidden(const LightSeen<double>& seen) { return seen.counts && seen.delta == Rgbd(0); }

 private:
  const Scene& scene_;
  const Shape& shape_;
  const Material& material_;
  const attribution::Meeting& meeting_;
};

/// What hides the light; null when nothing was found that does.
const Shape* blocking_shape(const Scene& scene, const InstanceShapes& shapes, const LightSeen<double>& seen) {
  if (seen.blocker.surface.instance == textbook::no_instance) return nullptr;
  return &scene.shapes[shapes.at(seen.blocker.surface.instance)];
}

std::string triple(const Vec3d& v) {
  return "(" + nine_digits(v.x) + " " + nine_digits(v.y) + " " + nine_digits(v.z) + ")";
}

class Writer {
 public:
  explicit Writer(const Scene& scene) : scene_(scene), shapes_(scene) {}

  std::string text(const attribution::RayNode& node) {
    ray(node, 0, "");
    return std::move(text_);
  }

 private:
  void line(int indent, const std::string& said, const std::string& slide = "") {
    text_ += std::string(2 * static_cast<std::size_t>(indent), ' ') + said;
    if (!slide.empty()) text_ += "   [" + slide + "]";
    text_ += '\n';
  }

  void ray(const attribution::RayNode& node, int indent, const std::string& weight) {
    const KindWords words = words_of(node.kind);
    line(indent,
         std::string(words.name) + weight + ", depth " + std::to_string(node.depth) + ", from " +
             triple(node.ray.origin) + " toward " + triple(node.ray.direction),
         words.slide);
    if (node.is_at_depth_limit) return line(indent + 1, "is black: the recursion ends here");
    if (!node.meeting) return line(indent + 1, "meets nothing: background " + triple(node.colour));
    const Terms terms(scene_, *node.meeting);
    meeting(*node.meeting, terms, indent + 1);
    for (std::size_t i = 0; i < node.meeting->lights.size(); ++i)
      light(terms, i, node.meeting->lights[i], indent + 1);
    line(indent + 1, "local = " + triple(terms.local()), "Vollständiges Modell");
    for (const attribution::RayNode& child : node.children)
      ray(child, indent + 1, weight_of(child.kind, terms.material()));
    if (node.is_cut)
      line(indent + 1, "... and rays that were not traced: there are too many, choose a smaller --depth");
    const bool is_total = !node.children.empty() && node.children.front().kind == RayKind::totally_reflected;
    if (is_total)
      line(indent + 1, "colour = local + R = " + triple(node.colour), "Brechung: total reflection");
    if (!is_total && (!node.children.empty() || node.is_cut))
      line(indent + 1, "colour = local + kr R + kt T = " + triple(node.colour), "Spiegelung, Brechung");
  }

  static std::string weight_of(RayKind kind, const Material& material) {
    if (kind == RayKind::mirrored) return ", weight kr " + triple(material.mirror);
    return kind == RayKind::totally_reflected ? ", weight 1" : ", weight kt " + triple(material.transmit);
  }

  void meeting(const attribution::Meeting& met, const Terms& terms, int indent) {
    const std::string face =
        met.surface.face == no_face ? "" : ", face " + std::to_string(static_cast<int>(met.surface.face));
    line(indent,
         "meets " + in_quotes(terms.shape().name) + face + " at t = " + nine_digits(met.t) + ", point " +
             triple(met.point) + ", normal " + triple(met.normal) + ", material " +
             in_quotes(terms.material().name),
         terms.slide());
    line(indent, "ambient   Ia ka = " + triple(terms.ambient()), "Ambient");
  }

  void light(const Terms& terms, std::size_t i, const LightSeen<double>& seen, int indent) {
    const std::string name = "light " + in_quotes(terms.light(i).name);
    if (!seen.counts)
      return line(indent, name + " is behind the surface: n.l = " + nine_digits(seen.cos_theta), "Lambert");
    if (Terms::is_hidden(seen)) return line(indent, name + " is hidden" + blocker(seen), "Schatten");
    line(indent,
         name + " is seen at distance " + nine_digits(seen.distance) + ", delta = " + triple(seen.delta),
         "Schatten");
    line(indent + 1,
         "diffuse   Ip kd (n.l) = " + triple(terms.diffuse(i)) +
             ", Ip = " + triple(terms.light(i).intensity()) + ", kd = " + triple(terms.material().kd) +
             ", n.l = " + nine_digits(seen.cos_theta),
         "Lambert");
    line(indent + 1,
         "specular  Ip ks (r.v)^m = " + triple(terms.specular(i)) + ", ks = " + triple(terms.material().ks) +
             ", (r.v)^m = " + nine_digits(seen.specular_factor) + ", m = " + nine_digits(terms.material().m),
         "Phong");
  }

  std::string blocker(const LightSeen<double>& seen) const {
    const Shape* const shape = blocking_shape(scene_, shapes_, seen);
    if (shape == nullptr) return "";
    return " by " + in_quotes(shape->name) + " at t = " + nine_digits(seen.blocker.t) + " of " +
           nine_digits(seen.distance);
  }

  const Scene& scene_;
  InstanceShapes shapes_;
  std::string text_;
};

Json json_of(const Vec3d& v) { return {v.x, v.y, v.z}; }

class JsonWriter {
 public:
  explicit JsonWriter(const Scene& scene) : scene_(scene), shapes_(scene) {}

  Json ray(const attribution::RayNode& node) const {
    const KindWords words = words_of(node.kind);
    Json json{{"ray", words.name},
              {"slide", words.slide},
              {"depth", node.depth},
              {"origin", json_of(node.ray.origin)},
              {"direction", json_of(node.ray.direction)}};
    if (node.is_at_depth_limit) json["at_depth_limit"] = true;
    if (node.meeting) add_meeting(node, json);
    if (node.is_cut) json["is_cut"] = true;
    json["colour"] = json_of(node.colour);
    return json;
  }

 private:
  void add_meeting(const attribution::RayNode& node, Json& json) const {
    const attribution::Meeting& met = *node.meeting;
    const Terms terms(scene_, met);
    json["met"] = {
        {"shape", terms.shape().name}, {"slide", terms.slide()},        {"t", met.t},
        {"point", json_of(met.point)}, {"normal", json_of(met.normal)}, {"material", terms.material().name}};
    if (met.surface.face != no_face) json["met"]["face"] = static_cast<int>(met.surface.face);
    json["ambient"] = {{"slide", "Ambient"},
                       {"value", json_of(terms.ambient())},
                       {"Ia", json_of(scene_.ambient)},
                       {"ka", json_of(terms.material().ka)}};
    json["lights"] = Json::array();
    for (std::size_t i = 0; i < met.lights.size(); ++i)
      json["lights"].push_back(light(terms, i, met.lights[i]));
    json["local"] = json_of(terms.local());
    json["children"] = Json::array();
    for (const attribution::RayNode& child : node.children) {
      json["children"].push_back(ray(child));
      json["children"].back()["weight"] = weight(child.kind, terms.material());
    }
  }

  Json light(const Terms& terms, std::size_t i, const LightSeen<double>& seen) const {
    const Material& material = terms.material();
    Json json{{"light", terms.light(i).name},
              {"n.l", seen.cos_theta},
              {"distance", seen.distance},
              {"counts", seen.counts},
              {"Ip", json_of(terms.light(i).intensity())},
              {"kd", json_of(material.kd)},
              {"ks", json_of(material.ks)},
              {"m", material.m}};
    if (!seen.counts) return json;
    json["delta"] = json_of(seen.delta);
    if (Terms::is_hidden(seen)) {
      json["blocker"] = blocker(seen);
      return json;
    }
    json["diffuse"] = {{"slide", "Lambert"}, {"value", json_of(terms.diffuse(i))}};
    json["specular"] = {
        {"slide", "Phong"}, {"value", json_of(terms.specular(i))}, {"(r.v)^m", seen.specular_factor}};
    return json;
  }

  Json blocker(const LightSeen<double>& seen) const {
    Json json{{"t", seen.blocker.t}};
    if (const Shape* shape = blocking_shape(scene_, shapes_, seen)) json["shape"] = shape->name;
    return json;
  }

  static Json weight(RayKind kind, const Material& material) {
    if (kind == RayKind::mirrored) return {{"name", "kr"}, {"value", json_of(material.mirror)}};
    if (kind == RayKind::totally_reflected) return {{"name", "1"}, {"value", json_of(Vec3d(1))}};
    return {{"name", "kt"}, {"value", json_of(material.transmit)}};
  }

  const Scene& scene_;
  InstanceShapes shapes_;
};

}  // namespace

std::string cut_note(const attribution::RayNode& tree) {
  if (!attribution::is_cut(tree)) return {};
  return "the tree is cut: the pixel has more than " + std::to_string(textbook::most_rays_of_pixel) +
         " rays, and the sum covers only those that were traced; choose a smaller --depth";
}

std::string engine_note(const Rgbd& of_rays, const Rgbd& of_engine) {
  constexpr double tolerance = 1e-6;  // because verify's is, and float32 holds no less above 8
  const std::array<float, 3> shown{float(of_rays.x), float(of_rays.y), float(of_rays.z)};
  const std::array<float, 3> compared{float(of_engine.x), float(of_engine.y), float(of_engine.z)};
  if (comparison::is_within(shown.data(), compared.data(), tolerance)) return {};
  return "the engine, whose picture verify compares, comes to another colour than these rays of the textbook "
         "tracer; please report the scene";
}

std::string explain_text(const Scene& scene, const attribution::RayNode& tree) {
  return Writer(scene).text(tree);
}

Json explain_json(const Scene& scene, const attribution::RayNode& tree) {
  return JsonWriter(scene).ray(tree);
}

}  // namespace plumb::report
