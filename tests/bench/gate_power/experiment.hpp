// What is tried on the gates: pictures with a fault in them, and pictures that are right in another way.
#pragma once

#include <functional>
#include <random>
#include <string>
#include <vector>

#include "references/faults/fault.hpp"

namespace plumb::gate_power {

/// What the maker of a picture says of it.
enum class Made {
  in_double,       ///< linear float32 colours, computed in double or better
  in_float,        ///< linear float32 colours, computed in float32
  sampled_nearby,  ///< linear float32 colours, computed in double, samples within 1e-6 pixels of the centres
  bits8_rounded,   ///< linear, 0..1 rounded to 8 bits
  bits8_truncated  ///< linear, 0..1 truncated to 8 bits, as the course's framework does
};

/// A scene of tests/scenes with its right picture.
struct Subject {
  std::string name;
  Scene scene;
  Camera camera;
  textbook::RenderJob job;
  Image right;
};

/// A picture to be judged. 8-bit ones are decoded: value / 255.
struct Experiment {
  std::size_t subject;
  std::string kind;  ///< e.g. "pixel-corner", "parameter eta", "8 bits, rounded"
  bool is_fault;
  Made made;
  std::function<Image(const Subject&)> render;
};

/// What a file of 8 linear bits holds of a picture, decoded.
Image decoded_8_bits(const Image& image, bool rounds);

/// Every fault of the catalogue on every scene, and parameters of every scene off by 0.1 to 5 %.
std::vector<Experiment> fault_experiments(const std::vector<Subject>& subjects, std::mt19937& random);

/// Changes after which a picture is as right as before.
std::vector<Experiment> benign_experiments(const std::vector<Subject>& subjects, std::mt19937& random);

/// One parameter of a scene made wrong by a fraction; false when the scene has no such parameter.
struct Parameter {
  const char* name;
  bool (*change)(Scene&, Camera&, double fraction, std::mt19937&);
};
const std::vector<Parameter>& parameters();

}  // namespace plumb::gate_power
