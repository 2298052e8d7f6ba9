// A picture that is right but for its brightness: a habit, no mistake of a formula.
#pragma once

#include <optional>

#include "references/diagnosis/diagnosis.hpp"

namespace plumb::diagnosis {

/// Returns right_apart, with the habit and no pixel that remains, when every pixel is right once all lights,
/// ambient and background are so many times as bright, or once the levels of the file are stretched by a
/// straight line; each to a level. Returns nothing else. `tolerance` is that of diagnose().
std::optional<Diagnosis> right_but_for_brightness(const Evidence& evidence, const ImageFile& seen,
                                                  std::optional<double> tolerance);

}  // namespace plumb::diagnosis
