#include "references/teaching/tell_apart.hpp"

#include <algorithm>
#include <compare>
#include <utility>

namespace plumb::teaching {
namespace {

/// Compared in this order.
struct Merit {
  std::size_t pairs = 0;  ///< number of pairs that are told apart
  std::size_t least = 0;  ///< number of pixels in which the two that are most alike differ
  auto operator<=>(const Merit&) const = default;
};

Merit merit_of(const Lesson& lesson, const std::vector<const faults::Fault*>& faults) {
  std::vector<Handed> pictures;
  Merit merit;
  for (const faults::Fault* fault : faults) {
    Handed picture = handed(lesson, {fault});
    for (const Handed& other : pictures) {
      if (!are_told_apart(picture, other)) continue;
      const std::size_t pixels = difference(picture, other);
      merit.least = merit.pairs++ == 0 ? pixels : std::min(merit.least, pixels);
    }
    pictures.push_back(std::move(picture));
  }
  return merit;
}

}  // namespace

std::optional<std::string> scene_that_tells_apart(const std::vector<Lesson>& lessons,
                                                  const std::vector<const faults::Fault*>& faults) {
  std::optional<std::string> best;
  Merit most;
  for (const Lesson& lesson : lessons) {
    const Merit merit = merit_of(lesson, faults);
    if (merit <= most) continue;
    most = merit;
    best = lesson.name;
  }
  return best;
}

}  // namespace plumb::teaching
