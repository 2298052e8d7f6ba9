// Numbers as people write them, and as we do.
#pragma once

#include <string>
#include <string_view>

namespace plumb {

/// Why a token is no finite double, with the likely fix; empty when it is one.
struct Number {
  double value;
  std::string complaint;
};
Number parse_number(std::string_view text);

/// Shortest decimal text that reads back as the same double.
std::string to_text(double value);

}  // namespace plumb
