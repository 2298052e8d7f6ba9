#include "tracer/format/writer.hpp"

#include <array>
#include <charconv>
#include <cmath>

#include "tracer/scene/each_kind.hpp"
#include "tracer/text/numbers.hpp"

namespace plumb {
namespace {

std::string triple(const Vec3d& v) { return to_text(v.x) + " " + to_text(v.y) + " " + to_text(v.z); }

/// True for what reads back, to the bit, when its keyword is not written.
bool is_plus_zero(const Rgbd& c) {
  return c == Rgbd(0) && !std::signbit(c.x) && !std::signbit(c.y) && !std::signbit(c.z);
}

std::string write(const Material& material) {
  std::string line = "define material " + material.name + " " + triple(material.ka) + " " +
                     triple(material.kd) + " " + triple(material.ks) + " " + to_text(material.m);
  if (!is_plus_zero(material.mirror)) line += " mirror " + triple(material.mirror);
  if (!is_plus_zero(material.transmit)) line += " transmit " + triple(material.transmit);
  if (material.eta != 1) line += " eta " + to_text(material.eta);
  return line + "\n";
}

std::string write(const Scene& scene, const Shape& shape) {
  const std::string define = "define shape ";
  return std::visit(EachKind{[&](const Sphere& sphere) {
                               return define + "sphere " + shape.name + " " + triple(sphere.center) + " " +
                                      to_text(sphere.radius) + " " + scene.materials[sphere.material].name +
                                      "\n";
                             },
                             [&](const Box& box) {
                               return define + "box " + shape.name + " " + triple(box.min) + " " +
                                      triple(box.max) + " " + scene.materials[box.material].name + "\n";
                             },
                             [&](const Composite& composite) {
                               std::string line = define + "composite " + shape.name;
                               for (const ShapeId child : composite.children)
                                 line += " " + scene.shapes[child].name;
                               return line + "\n";
                             }},
                    shape.geometry);
}

std::string write(const std::string& target, const std::vector<TransformStep>& steps) {
  std::string lines;
  for (const TransformStep& step : steps) {
    lines += "transform " + target + " " +
             std::visit(EachKind{[](const Translate& move) { return "translate " + triple(move.by); },
                                 [](const Rotate& turn) {
                                   return "rotate " + to_text(turn.degrees) + " " + triple(turn.axis);
                                 },
                                 [](const Scale& scale) { return "scale " + triple(scale.by); }},
                        step) +
             "\n";
  }
  return lines;
}

std::string write(const Camera& camera) {
  return "define camera " + camera.name + " " + to_text(camera.fov_x_degrees) + " " + triple(camera.eye) +
         " " + triple(camera.direction) + " " + triple(camera.up) + "\n";
}

}  // namespace

std::string write_scene(const Scene& scene) {
  std::string text;
  for (const Material& material : scene.materials) text += write(material);
  for (const Shape& shape : scene.shapes) text += write(scene, shape);
  for (const Shape& shape : scene.shapes) text += write(shape.name, shape.transform);
  for (const Light& light : scene.lights) {
    text += "define light " + light.name + " " + triple(light.position) + " " + triple(light.color) + " " +
            to_text(light.brightness) + "\n";
  }
  text += "ambient " + triple(scene.ambient) + "\nbackground " + triple(scene.background) + "\n";
  for (const Camera& camera : scene.cameras) text += write(camera) + write(camera.name, camera.transform);
  for (const RenderRequest& render : scene.renders) {
    text += "render " + render.camera + " " + render.file + " " + std::to_string(render.width) + " " +
            std::to_string(render.height) + "\n";
  }
  return text;
}

}  // namespace plumb
