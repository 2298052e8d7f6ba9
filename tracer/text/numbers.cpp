#include "tracer/text/numbers.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "tracer/text/words.hpp"

namespace plumb {
namespace {

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

}  // namespace

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

std::string to_text(double value) {
  std::array<char, 32> buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), end};
}

}  // namespace plumb
