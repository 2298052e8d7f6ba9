// Scenes that a submission cannot have seen.
#pragma once

#include <cstdint>
#include <optional>

#include "references/submissions/grade.hpp"

namespace plumb::references {

/// The scene with other numbers and names, the same for the same seed, whose picture is seen to be another
/// and which shows the same faults of the catalogue as it was; the numbers vary less where they have to.
/// Nothing when no variation does.
std::optional<JudgedScene> shuffled(const JudgedScene& scene, std::uint64_t seed, const Dialect& dialect);

}  // namespace plumb::references
