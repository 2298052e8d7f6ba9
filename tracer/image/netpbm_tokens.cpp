#include "tracer/image/netpbm_tokens.hpp"

#include <algorithm>

namespace plumb {
namespace {

constexpr std::string_view spaces = " \t\n\r\v\f";

bool is_space(char c) { return spaces.find(c) != std::string_view::npos; }

}  // namespace

void NetpbmTokens::skip_space() {
  while (!rest_.empty() && (is_space(rest_.front()) || rest_.front() == '#')) {
    const bool is_comment = rest_.front() == '#';
    rest_.remove_prefix(is_comment ? std::min(rest_.find('\n'), rest_.size()) : 1);
  }
}

std::string_view NetpbmTokens::word() {
  skip_space();
  std::size_t end = 0;
  while (end < rest_.size() && !is_space(rest_[end]) && rest_[end] != '#') ++end;
  const std::string_view found = rest_.substr(0, end);
  rest_.remove_prefix(end);
  if (found.empty()) fail("it ends too early: the file is truncated");
  return found;
}

bool NetpbmTokens::bit() {
  skip_space();
  if (rest_.empty()) fail("it ends too early: the file is truncated");
  const char found = rest_.front();
  if (found != '0' && found != '1') fail("found '" + printable(rest_.substr(0, 1)) + "', expected 0 or 1");
  rest_.remove_prefix(1);
  return found == '1';
}

std::string_view NetpbmTokens::data(std::size_t size) {
  // One byte more than the header announces: the line feed is no pixel.
  if (rest_.starts_with("\r\n") && rest_.size() - 1 > size)
    fail(
        "its header ends in CR LF, as Windows writes lines of text, expected a single LF before the pixels; "
        "open the file in binary mode (\"wb\", std::ios::binary) to write it");
  if (!rest_.empty()) rest_.remove_prefix(1);
  if (rest_.size() < size) fail("it ends too early: the file is truncated");
  const std::string_view data = rest_.substr(0, size);
  rest_.remove_prefix(size);
  return data;
}

std::string_view NetpbmTokens::rest() const {
  const std::size_t first = rest_.find_first_not_of(spaces);
  return first == std::string_view::npos ? std::string_view() : rest_.substr(first);
}

}  // namespace plumb
