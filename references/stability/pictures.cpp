#include "references/stability/pictures.hpp"

#include <cmath>
#include <numbers>

#include "references/methods/method_sets.hpp"
#include "references/report/thumbnail.hpp"

namespace plumb::references::stability {
namespace {

/// A sphere and its eye, lengths in double.
struct View {
  Vec3d center;
  double radius;
  double distance;  ///< of the eye from the centre
};

std::optional<View> view_of(const std::string& condition, double v) {
  const Vec3d beside = glm::normalize(Vec3d(1, 2, 3));
  if (condition == "distance") return View{Vec3d(0), 1, v + 1};
  if (condition == "small-radius") return View{beside, 1 / v, 2 + 1 / v};
  if (condition == "scale-up") return View{v * beside, v, 3 * v};
  if (condition == "scale-down") return View{beside / v, 1 / v, 3 / v};
  if (condition == "offset") return View{v * beside, 1, 3};
  return std::nullopt;
}

/// Seen from an oblique direction, lit from behind the eye, against blue.
Scene scene_of(const View& view, Camera& camera) {
  const Vec3d away = glm::normalize(Vec3d(0.3, 0.4, 0.866));
  camera.eye = view.center + view.distance * away;
  camera.direction = -away;
  camera.fov_x_degrees = 2.4 * std::asin(view.radius / view.distance) * 180 / std::numbers::pi;
  Scene scene;
  Material white;
  white.ka = white.kd = Rgbd(1);
  scene.materials.push_back(white);
  scene.shapes.push_back({"sphere", Sphere{view.center, view.radius, 0}, {}});
  const Vec3d side = glm::normalize(glm::cross(away, Vec3d(0, 1, 0)));
  scene.lights.push_back({"light", view.center + 6 * view.radius * (away + side), Rgbd(1), 0.8});
  scene.ambient = Rgbd(0.1);
  scene.background = Rgbd(0.25, 0.3, 0.5);
  return scene;
}

RealType real_of(const std::string& name) {
  if (name == "float") return RealType::float32;
  return name == "double" ? RealType::float64 : RealType::long_double;
}

}  // namespace

std::optional<double> picture_value(const Row& row) {
  std::optional<double> first;
  for (const auto& at : {row.breaks.missed, row.breaks.self_shadow, row.breaks.percent}) {
    if (at && (!first || *at < *first)) first = at;
  }
  return first ? std::optional<double>(1.5 * *first) : std::nullopt;
}

std::string failure_picture(const Condition& condition, const Row& row) {
  const std::optional<double> value = picture_value(row);
  const MethodSet* const set = find_method_set(row.method == "start-id" ? "lecture" : row.method);
  if (!value || set == nullptr) return {};
  const std::optional<View> view = view_of(condition.name, *value);
  if (!view) return {};
  Camera camera;
  const Scene scene = scene_of(*view, camera);
  textbook::RenderJob job;
  job.width = job.height = 64;
  job.real = real_of(row.real);
  return thumbnail(render_with_methods(*set, scene, camera, job));
}

}  // namespace plumb::references::stability
