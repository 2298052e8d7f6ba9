// A scene that settles which of several faults it is.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "references/teaching/matrix.hpp"

namespace plumb::references::teaching {

/// The lesson in which the right picture and those of the faults differ most, any two of them; nothing when
/// every lesson leaves two of them alike.
std::optional<std::string> scene_that_tells_apart(const std::vector<Lesson>& lessons,
                                                  const std::vector<const Fault*>& faults);

}  // namespace plumb::references::teaching
