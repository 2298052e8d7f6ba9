#include "references/report/script_json.hpp"

#include <string_view>

#include "references/system/json.hpp"

namespace plumb::report {
namespace {

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

}  // namespace

std::string script_json(const nlohmann::ordered_json& json) {
  // Outside strings JSON has none of these, so that escapes of strings are right everywhere.
  std::string text = system::json_text_of_any_bytes(json);
  std::string escaped;
  escaped.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '<':
        escaped += "\\u003c";
        break;
      case '>':
        escaped += "\\u003e";
        break;
      case '&':
        escaped += "\\u0026";
        break;
      default:
        escaped += c;
    }
  }
  replace_all(escaped, "\xe2\x80\xa8", "\\u2028");
  replace_all(escaped, "\xe2\x80\xa9", "\\u2029");
  return escaped;
}

}  // namespace plumb::report
