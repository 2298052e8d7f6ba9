// Splits scene text into lines of tokens with their columns.
#pragma once

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

}  // namespace plumb
