// Makes scenes that a submission cannot have seen.
#pragma once

#include <cstdint>
#include <optional>

#include "references/submissions/grade.hpp"

namespace plumb::submissions {

/// Returns the scene with other numbers and names, the same for the same seed. Its picture is seen to be
/// another, and it shows the same faults of the catalogue as it did; the numbers vary less where that needs
/// it. Nothing when no variation does.
std::optional<JudgedScene> shuffled(const JudgedScene& scene, std::uint64_t seed, const Dialect& dialect);

}  // namespace plumb::submissions
