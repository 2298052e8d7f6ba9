#include "tracer/format/lexer.hpp"

namespace plumb {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

}  // namespace

void tokenize(std::string_view line, std::vector<Token>& tokens) {
  tokens.clear();
  std::size_t at = 0;
  for (;;) {
    while (at < line.size() && is_blank(line[at])) ++at;
    if (at == line.size() || line[at] == '#') return;
    const std::size_t begin = at;
    while (at < line.size() && !is_blank(line[at]) && line[at] != '#') ++at;
    const Token token{line.substr(begin, at - begin), static_cast<int>(begin) + 1};
    tokens.push_back(token);
    if (token.text.starts_with("//")) return;
  }
}

}  // namespace plumb
