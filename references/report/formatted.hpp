// Text from values.
#pragma once

#include <cstdio>
#include <string>

namespace plumb::report {

/// As std::printf has it.
std::string formatted(const char* format, const auto&... values) {
  std::string text(static_cast<std::size_t>(std::snprintf(nullptr, 0, format, values...)), '\0');
  std::snprintf(text.data(), text.size() + 1, format, values...);
  return text;
}

/// Enough that it reads back as the same float32.
inline std::string nine_digits(double value) { return formatted("%.9g", value); }

}  // namespace plumb::report
