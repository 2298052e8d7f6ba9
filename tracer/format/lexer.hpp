// Splits scene text into lines of tokens with their columns.
#pragma once

#include <string_view>
#include <vector>

namespace plumb {

struct Token {
  std::string_view text;
  int column;  ///< from 1, in bytes
};

/// Replaces `tokens` by those of one line, up to a `#`. Blanks, tabs and carriage returns separate them. A
/// token that begins with `//` ends the line, too, and becomes the last token. Tokens point into the line.
void tokenize(std::string_view line, std::vector<Token>& tokens);

}  // namespace plumb
