// Finds a scene that settles which of several faults it is.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "references/teaching/matrix.hpp"

namespace plumb::teaching {

/// Returns the lesson that tells most pairs of these faults apart. Of several it is the one in which the two
/// that are most alike differ most. Nothing when none tells any pair apart.
std::optional<std::string> scene_that_tells_apart(const std::vector<Lesson>& lessons,
                                                  const std::vector<const faults::Fault*>& faults);

}  // namespace plumb::teaching
