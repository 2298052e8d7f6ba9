// A scene that settles which of several faults it is.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "references/teaching/matrix.hpp"

namespace plumb::references::teaching {

/// The lesson that tells most pairs of these faults apart, of several the one in which those pictures differ
/// most. Nothing when none tells any pair apart.
std::optional<std::string> scene_that_tells_apart(const std::vector<Lesson>& lessons,
                                                  const std::vector<const Fault*>& faults);

}  // namespace plumb::references::teaching
