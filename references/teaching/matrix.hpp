// Measures which scene shows which fault, and which faults it tells apart.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "references/faults/fault.hpp"

namespace plumb::teaching {

/// A scene that a student may be given.
struct Lesson {
  std::string name;  ///< that of its file
  Scene scene;
};

/// Returns all *.sdf of a directory, by name. Throws std::runtime_error when there is none, or one cannot be
/// read.
std::vector<Lesson> lessons_in(const std::string& directory);

/// What a student hands in: r g b, tone-mapped, truncated to 8 bits, of matrix_width x matrix_height pixels.
/// Empty when the scene cannot be traced with the faults.
using Handed = std::vector<std::uint8_t>;

inline constexpr int matrix_width = 64;
inline constexpr int matrix_height = 48;

/// Renders with these faults at once, through the scene's own camera. A pixel of more than
/// `most_rays_of_pixel` rays is black.
Handed handed(const Lesson& lesson, const std::vector<const faults::Fault*>& faults);

/// Returns the number of pixels with a component that is more than 2 levels away; all where one is empty.
std::size_t difference(const Handed& a, const Handed& b);

/// True if one is seen not to be the other: they differ in more than half a percent of the pixels.
bool are_told_apart(const Handed& a, const Handed& b);

/// Picture 0 is the right one, picture i + 1 that of the catalogue's fault i.
class Matrix {
 public:
  /// Renders every fault in every lesson. Calls `progress` with 0 to 1.
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
  std::vector<std::vector<bool>> apart_;  // for each scene, pictures x pictures
};

}  // namespace plumb::teaching
