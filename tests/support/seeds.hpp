// How many random scenes a test tries.
#pragma once

#include <algorithm>
#include <cstdlib>

namespace plumb::tests {

/// What an environment variable sets, or what is tried in a short run; scripts/test --long asks for more.
/// With sanitizers, which take eight times as long, a short run tries an eighth; scripts/test tries all of
/// them in the release.
inline unsigned number_from(const char* variable, unsigned in_a_short_run) {
  const char* const wanted = std::getenv(variable);
  if (wanted != nullptr) return static_cast<unsigned>(std::strtoul(wanted, nullptr, 10));
  return std::max(in_a_short_run / PLUMB_SEEDS_DIVIDED_BY, 3U);
}

}  // namespace plumb::tests
