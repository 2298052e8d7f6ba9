#include "references/submissions/shown_text.hpp"

#include <algorithm>

#include "references/system/json.hpp"

namespace plumb::submissions {
std::string shown_text(const std::string& bytes) { return system::valid_utf8(bytes); }

std::string shown_name(const std::string& bytes) {
  if (shown_text(bytes) == bytes && bytes.find("\\x") == std::string::npos) return bytes;
  constexpr const char* digits = "0123456789abcdef";
  std::string text;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80 && c != '\\')
      text += c;
    else
      text += {'\\', 'x', digits[byte >> 4], digits[byte & 15]};
  }
  return text;
}

std::string printable(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < ' ' || c == 127; }, '?');
  return text;
}

}  // namespace plumb::submissions
