#include "tracer/scene/lexer.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

namespace plumb {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }
bool is_ascii(char c) { return static_cast<unsigned char>(c) < 0x80; }

std::string explain_no_number(std::string_view text) {
  if (text.find("{{") != std::string_view::npos) return "a template's placeholder; fill it in first";
  if (!std::all_of(text.begin(), text.end(), is_ascii)) {
    return "it has a character that is not ASCII (copied from a PDF?); type it again";
  }
  if (text.front() == '[' || text.back() == ']') return "leave out the brackets";
  if (text.find(',') != std::string_view::npos) {
    return "numbers are separated by blanks and have a decimal point, no commas";
  }
  const char last = text.back();
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && (last == 'f' || last == 'F') && end + 1 == text.data() + text.size()) {
    return "drop the 'f'";
  }
  return {};
}

/// Insertions, deletions, substitutions and swaps of neighbours (Damerau, "A technique for computer detection
/// and correction of spelling errors", CACM 7 (1964)).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    before_last.swap(last);
    last.swap(row);
  }
  return last.back();
}

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

Number parse_number(std::string_view text) {
  std::string_view digits = text;
  if (digits.size() > 1 && digits.front() == '+' && digits[1] != '-') digits.remove_prefix(1);
  double value = 0;
  const char* const last = digits.data() + digits.size();
  const auto [end, error] = std::from_chars(digits.data(), last, value);
  if (error == std::errc::result_out_of_range) return {0, "it is outside the range of a double"};
  if (error != std::errc() || end != last) {
    const std::string why = explain_no_number(text);
    return {0, why.empty() ? "it is no number" : why};
  }
  if (!std::isfinite(value)) return {0, "it is not finite; write a finite number"};
  return {value, {}};
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 40;
  constexpr const char* hex = "0123456789abcdef";
  std::string shown = "'";
  for (const char c : text.substr(0, longest)) {
    if (c >= ' ' && c != 0x7f && is_ascii(c)) {
      shown += c;
    } else {
      const auto byte = static_cast<unsigned char>(c);
      shown += {'\\', 'x', hex[byte >> 4], hex[byte & 15]};
    }
  }
  return shown + (text.size() > longest ? "...'" : "'");
}

std::optional<std::string> nearest_name(std::string_view name,
                                        const std::vector<std::string_view>& candidates) {
  constexpr std::size_t longest = 64;
  if (name.size() > longest) return std::nullopt;
  std::optional<std::string> nearest;
  std::size_t least = std::max<std::size_t>(1, name.size() / 2) + 1;
  for (const std::string_view candidate : candidates) {
    const std::size_t gap = std::max(name.size(), candidate.size()) - std::min(name.size(), candidate.size());
    if (candidate.size() > longest || gap >= least) continue;
    const std::size_t distance = edit_distance(name, candidate);
    if (distance >= least) continue;
    least = distance;
    nearest = std::string(candidate);
  }
  return nearest;
}

}  // namespace plumb
