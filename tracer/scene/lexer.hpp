// Splits scene text into lines of tokens with their columns, and reads numbers.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plumb {

struct Token {
  std::string_view text;
  int column;  ///< from 1, in bytes
};

/// Sets the tokens to those of one line up to a `#`; blanks, tabs and carriage returns separate.
/// A token that begins with `//` ends the line, too, and becomes the last token.
void tokenize(std::string_view line, std::vector<Token>& tokens);

/// Why a token is no finite double, with the likely fix; empty when it is one.
struct Number {
  double value;
  std::string complaint;
};
Number parse_number(std::string_view text);

/// The text for a message: quoted, at most 40 bytes, unprintable bytes as \xNN.
std::string in_quotes(std::string_view text);

/// The candidate nearest to `name` by edit distance, if one is near enough to be a slip.
std::optional<std::string> nearest_name(std::string_view name,
                                        const std::vector<std::string_view>& candidates);

}  // namespace plumb
