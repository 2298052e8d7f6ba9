#include "references/teaching/tell_apart.hpp"

#include <algorithm>

namespace plumb::references::teaching {
namespace {

/// Of the right picture and those of the faults, the two that are most alike differ in so many components.
std::size_t least_difference(const Lesson& lesson, const std::vector<const Fault*>& faults) {
  std::vector<Handed> pictures{handed(lesson, {})};
  std::size_t least = pictures.front().size();
  for (const Fault* fault : faults) {
    const Handed picture = handed(lesson, {fault});
    for (const Handed& other : pictures) least = std::min(least, difference(picture, other));
    pictures.push_back(picture);
  }
  return least;
}

}  // namespace

std::optional<std::string> scene_that_tells_apart(const std::vector<Lesson>& lessons,
                                                  const std::vector<const Fault*>& faults) {
  std::optional<std::string> best;
  std::size_t most = 0;
  for (const Lesson& lesson : lessons) {
    const std::size_t difference = least_difference(lesson, faults);
    if (difference <= most) continue;
    most = difference;
    best = lesson.name;
  }
  return best;
}

}  // namespace plumb::references::teaching
