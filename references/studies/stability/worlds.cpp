#include "references/studies/stability/worlds.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "references/studies/stability/chains.hpp"

namespace plumb::studies::stability {
namespace {

const Vec3d away = glm::normalize(Vec3d(0.3, 0.4, 0.866));  // of the eye
const Vec3d beside = glm::normalize(Vec3d(1, 2, 3));

Material white() {
  Material material;
  material.ka = material.kd = Rgbd(1);
  return material;
}
Material glass() {
  Material material;
  material.transmit = Rgbd(0.9);
  material.eta = 1.5F;
  return material;
}
Material mirror() {
  Material material;
  material.ka = material.kd = Rgbd(0.3);
  material.mirror = Rgbd(0.6);
  return material;
}

/// A scene against blue, lit from beside the eye. What is in view lies within `radius` of `center`.
World world(const Vec3d& center, double radius, double distance) {
  World w;
  w.camera.eye = center + distance * away;
  w.camera.direction = -away;
  w.camera.fov_x_degrees = 2.4 * std::asin(std::min(0.9, radius / distance)) * 180 / std::numbers::pi;
  w.scene.materials = {white()};
  const Vec3d side = glm::normalize(glm::cross(away, Vec3d(0, 1, 0)));
  w.scene.lights.push_back({"light", center + 6 * radius * (away + side), Rgbd(1), 0.8});
  w.scene.ambient = Rgbd(0.1);
  w.scene.background = Rgbd(0.25, 0.3, 0.5);
  return w;
}

World ball(const Vec3d& center, double radius, double distance) {
  World w = world(center, radius, distance);
  w.scene.shapes.push_back({"ball", Sphere{center, radius, 0}, {}});
  return w;
}

World placed(const Steps& steps) {
  World w = world(Vec3d(0), 1.2, 4);
  w.scene.materials.push_back(glass());
  w.scene.shapes.push_back({"ball", Sphere{Vec3d(0.5, 0, -0.5), 0.7, 0}, steps});
  w.scene.shapes.push_back({"glass", Sphere{Vec3d(-0.3, 0, 0.3), 0.7, 1}, steps});
  return w;
}

/// A ball that v transforms have moved far; the eye follows it.
World nested_world(double v) {
  const Steps steps = nested(v);
  const auto moved = transform_of<Quad>(steps).matrix;
  World w =
      world(Vec3d(formulas::transform_point(moved, Vec3<Quad>(0))),
            static_cast<double>(glm::length(formulas::transform_vector(moved, Vec3<Quad>(1, 0, 0)))), 4);
  w.scene.shapes.push_back({"ball", Sphere{Vec3d(0), 1, 0}, steps});
  return w;
}

World plate(double v) {
  World w = world(Vec3d(0), 1.5, 4);
  w.scene.shapes.push_back({"plate", Box{{-1, -1 / v, -1}, {1, 1 / v, 1}, 0}, {}});
  return w;
}

constexpr double narrowest = 1e-6;  // of a field of view, in degrees: a double still tells its pixels apart

/// The silhouette of a ball, seen from so near that most angles to the surface are about 1/v.
std::optional<World> silhouette(double v) {
  World w = ball(Vec3d(0), 1, 3);
  const Vec3d side = glm::normalize(glm::cross(away, Vec3d(0, 1, 0)));
  const Vec3d aim = std::sqrt(1 - 1 / 9.0) * side + away / 3.0;  // where the line of sight touches
  w.camera.direction = glm::normalize(aim - w.camera.eye);
  w.camera.fov_x_degrees = std::min(40.0, 40 / (v * v));
  return w.camera.fov_x_degrees < narrowest ? std::nullopt : std::optional(w);
}

/// An edge of a cube, seen from where 1/v of it fills the picture.
std::optional<World> edge(double v) {
  World w = world(Vec3d(0), 1.8, 6);
  w.scene.shapes.push_back({"cube", Box{Vec3d(-1), Vec3d(1), 0}, {}});
  w.camera.direction = glm::normalize(Vec3d(1, 1, 0.3) - w.camera.eye);
  w.camera.fov_x_degrees = std::min(40.0, 40 / v);
  return w.camera.fov_x_degrees < narrowest ? std::nullopt : std::optional(w);
}

/// Two white balls within a ball that mirrors, seen through this number of reflections.
World mirrors(double depth) {
  World w = world(Vec3d(0), 0.7, 0.7);
  w.depth = static_cast<int>(std::clamp(depth, 1.0, 256.0));
  w.camera.fov_x_degrees = 60;
  Material perfect;
  perfect.mirror = Rgbd(1);
  w.scene.materials.push_back(perfect);
  w.scene.shapes.push_back({"room", Sphere{Vec3d(0), 1, 1}, {}});
  w.scene.shapes.push_back({"one", Sphere{{-0.4, 0.2, -0.3}, 0.2, 0}, {}});
  w.scene.shapes.push_back({"other", Sphere{{0.4, -0.3, -0.2}, 0.25, 0}, {}});
  w.scene.lights.front().position = Vec3d(0, 0.6, 0);
  return w;
}

/// A ball behind a pane.
World thin_glass(double v) {
  World w = world(Vec3d(0), 1.2, 5);
  w.scene.materials.push_back(glass());
  w.scene.shapes.push_back({"ball", Sphere{Vec3d(-0.2, 0, -1.5), 0.8, 0}, {}});
  w.scene.shapes.push_back({"pane", Box{{-1.2, -1.2, 0}, {1.2, 1.2, 1 / v}, 1}, {}});
  return w;
}

/// A box of glass that nearly stands on the floor.
World gap(double v) {
  World w = world(Vec3d(0), 1.5, 5);
  w.scene.materials.push_back(glass());
  w.scene.materials[0].mirror = Rgbd(0.5);
  w.scene.shapes.push_back({"floor", Box{{-1.5, -0.7, -1.5}, {1.5, -0.5, 1.5}, 0}, {}});
  w.scene.shapes.push_back({"block", Box{{-0.6, -0.5 + 1 / v, -0.6}, {0.6, 0.5, 0.6}, 1}, {}});
  return w;
}

/// Balls of all kinds on a floor, `s` times their size; `steps` act on each of them.
World still_life(const Vec3d& center, double s, const Steps& steps = {}) {
  World w = world(center, 1.8 * s, 5 * s);
  w.scene.materials.push_back(glass());
  w.scene.materials.push_back(mirror());
  const auto at = [&](double x, double y, double z) { return center + s * Vec3d(x, y, z); };
  w.scene.shapes.push_back({"floor", Box{at(-2, -0.7, -2), at(2, -0.5, 2), 0}, steps});
  w.scene.shapes.push_back({"glass", Sphere{at(0.3, 0, 0.7), 0.5 * s, 1}, steps});
  w.scene.shapes.push_back({"mirror", Sphere{at(-0.8, 0.1, -0.2), 0.6 * s, 2}, steps});
  w.scene.shapes.push_back({"white", Sphere{at(0.7, 0.1, -0.7), 0.6 * s, 0}, steps});
  w.scene.shapes.push_back({"pane", Box{at(-0.9, -0.5, 0.6), at(-0.2, 0.2, 0.8), 1}, steps});
  return w;
}

}  // namespace

std::optional<World> world_of(const std::string& condition, double v) {
  if (condition == "distance") return ball(Vec3d(0), 1, v + 1);
  if (condition == "small-radius") return ball(beside, 1 / v, 2 + 1 / v);
  if (condition == "scale-up") return still_life(Vec3d(0), v);
  if (condition == "scale-down") return still_life(Vec3d(0), 1 / v);
  if (condition == "offset") return still_life(v * beside, 1);
  if (condition == "box-aspect") return plate(v);
  if (condition == "flattening") return placed(flattened(v));
  if (condition == "condition-number") return placed(pressed(v));
  if (condition == "nesting") return nested_world(v);
  if (condition == "thin-glass") return thin_glass(v);
  if (condition == "gap") return gap(v);
  if (condition == "block-size") return still_life(Vec3d(0), 1 / v);
  return std::nullopt;
}

std::optional<World> close_up_of(const std::string& condition, double v) {
  if (condition == "grazing") return silhouette(v);
  if (condition == "box-edge") return edge(v);
  if (condition == "recursion") return mirrors(v);
  return std::nullopt;
}

}  // namespace plumb::studies::stability
