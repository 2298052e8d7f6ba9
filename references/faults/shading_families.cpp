// Faults with a constant of the program in them, which differs from tracer to tracer.
#include <array>
#include <deque>
#include <sstream>
#include <string>

#include "references/faults/areas.hpp"

namespace plumb::faults {
namespace {

constexpr std::array ambient_constants{0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5,
                                       0.55, 0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.9, 0.95, 1.0};
constexpr std::array exponents{1.0,  2.0,   3.0,   4.0,   5.0,   8.0,   10.0, 12.0, 15.0,
                               16.0, 20.0,  25.0,  30.0,  32.0,  40.0,  50.0, 60.0, 64.0,
                               80.0, 100.0, 128.0, 150.0, 200.0, 256.0, 500.0};
constexpr std::array mirror_weights{0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.6, 0.7, 0.75, 0.8, 0.9, 1.0};

/// Keeps the text for as long as the program runs.
std::string_view kept(const std::string& before, double value, const std::string& after) {
  static std::deque<std::string> all;
  std::ostringstream text;
  text << before << value << after;
  return all.emplace_back(text.str());
}

Fault ambient_of(double value) {
  return {"ambient-hard-coded",
          17,
          "Ambient",
          "The ambient light is a constant of the program.",
          kept("", value, " ka"),
          "Ia ka",
          "3 of 42",
          "ambient.sdf",
          [value](Subject& s) { s.scene.ambient = Rgbd(value); },
          nullptr,
          value};
}

Fault ambient_without_ka_of(double value) {
  return {"ambient-hard-coded-without-ka",
          17,
          "Ambient",
          "The ambient term is a constant of the program.",
          kept("", value, ""),
          "Ia ka",
          "3 of 42",
          "ambient.sdf",
          [value](Subject& s) {
            s.scene.ambient = Rgbd(value);
            for (Material& material : s.scene.materials) material.ka = Rgbd(1);
          },
          nullptr,
          value};
}

Fault exponent_of(double value) {
  return {"exponent-fixed",
          13,
          "Phong",
          "The exponent is a constant, whatever the material says.",
          kept("(r.v)^", value, ""),
          "(r.v)^m",
          "1 of 42",
          "phong.sdf",
          [value](Subject& s) {
            for (Material& material : s.scene.materials) material.m = value;
          },
          nullptr,
          value};
}

Fault mirror_of(double value) {
  return {"every-object-mirrors-alike",
          42,
          "Spiegelung",
          "Everything mirrors, with a constant of the program as its weight.",
          kept("local + ", value, " R, for every material"),
          "local + kr R",
          "10 of 26",
          "phong.sdf",
          [value](Subject& s) {
            for (Material& material : s.scene.materials) material.mirror = Rgbd(value);
          },
          nullptr,
          value};
}

}  // namespace

std::vector<Fault> families_of_the_shading() {
  std::vector<Fault> all;
  for (const double value : ambient_constants) all.push_back(ambient_of(value));
  for (const double value : ambient_constants) all.push_back(ambient_without_ka_of(value));
  for (const double value : exponents) all.push_back(exponent_of(value));
  for (const double value : mirror_weights) all.push_back(mirror_of(value));
  return all;
}

}  // namespace plumb::faults
