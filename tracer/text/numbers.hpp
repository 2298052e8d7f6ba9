// Reads and writes numbers as decimal text.
#pragma once

#include <string>
#include <string_view>

namespace plumb {

/// A token that was read. `complaint` says why it is no finite double, with the likely fix. It is empty when
/// the token is one.
struct Number {
  double value;
  std::string complaint;
};
Number parse_number(std::string_view text);

/// Returns the shortest decimal text that reads back as the same double.
std::string to_text(double value);

}  // namespace plumb
