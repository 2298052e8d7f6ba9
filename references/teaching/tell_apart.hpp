// A scene that settles which of several faults it is.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "references/teaching/matrix.hpp"

namespace plumb::references::teaching {

/// The first of the lessons in which all these faults give different pictures; when there is none, the one
/// that tells most pairs of them apart. Nothing when no lesson tells any pair apart.
std::optional<std::string> scene_that_tells_apart(const std::vector<Lesson>& lessons,
                                                  const std::vector<const Fault*>& faults);

}  // namespace plumb::references::teaching
