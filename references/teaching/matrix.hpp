// Which scene shows which fault, and which faults it tells apart, measured.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "references/faults/fault.hpp"

namespace plumb::references::teaching {

/// A scene that a student may be given.
struct Lesson {
  std::string name;  ///< of its file
  Scene scene;
};

/// All *.sdf of a directory, by name. Throws std::runtime_error when there is none, or one cannot be read.
std::vector<Lesson> lessons_in(const std::string& directory);

/// What a student hands over: tone-mapped, truncated to 8 bits, of matrix_width x matrix_height pixels; empty
/// when the scene cannot be traced with the faults.
using Handed = std::vector<std::uint8_t>;

inline constexpr int matrix_width = 64;
inline constexpr int matrix_height = 48;

/// With these faults at once, seen by the scene's own camera. A pixel of more than `most_rays_of_pixel` rays
/// is black.
Handed handed(const Lesson& lesson, const std::vector<const Fault*>& faults);

/// In how many pixels a component is more than 2 levels away; in all where one is empty.
std::size_t difference(const Handed& a, const Handed& b);

/// Whether one is seen not to be the other: they differ in more than half a percent of the pixels.
bool are_told_apart(const Handed& a, const Handed& b);

/// Picture 0 is the right one, picture i + 1 that of the catalogue's fault i.
class Matrix {
 public:
  /// Renders every fault in every lesson. `progress` is called with 0 to 1.
  Matrix(const std::vector<Lesson>& lessons, const std::function<void(double)>& progress);

  const std::vector<std::string>& scenes() const { return scenes_; }
  std::size_t pictures() const { return pictures_; }
  bool tells_apart(std::size_t scene, std::size_t a, std::size_t b) const {
    return apart_[scene][a * pictures_ + b];
  }
  bool shows(std::size_t scene, std::size_t fault) const { return tells_apart(scene, 0, fault + 1); }

 private:
  std::vector<std::string> scenes_;
  std::size_t pictures_;
  std::vector<std::vector<bool>> apart_;  // of each scene, pictures x pictures
};

}  // namespace plumb::references::teaching
