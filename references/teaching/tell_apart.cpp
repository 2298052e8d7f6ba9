#include "references/teaching/tell_apart.hpp"

namespace plumb::references::teaching {
namespace {

std::size_t pairs_told_apart(const Lesson& lesson, const std::vector<const Fault*>& faults) {
  std::vector<Handed> pictures;
  std::size_t pairs = 0;
  for (const Fault* fault : faults) {
    const Handed picture = handed(lesson, {fault});
    for (const Handed& other : pictures) pairs += are_told_apart(picture, other) ? 1 : 0;
    pictures.push_back(picture);
  }
  return pairs;
}

}  // namespace

std::optional<std::string> scene_that_tells_apart(const std::vector<Lesson>& lessons,
                                                  const std::vector<const Fault*>& faults) {
  const std::size_t all = faults.size() * (faults.size() - 1) / 2;
  std::optional<std::string> best;
  std::size_t most = 0;
  for (const Lesson& lesson : lessons) {
    const std::size_t pairs = pairs_told_apart(lesson, faults);
    if (pairs > most) {
      most = pairs;
      best = lesson.name;
    }
    if (pairs == all) break;
  }
  return best;
}

}  // namespace plumb::references::teaching
