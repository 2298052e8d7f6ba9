#include "references/report/html/escape.hpp"

#include "references/system/json.hpp"

namespace plumb::report {
namespace {

std::string_view name_of(char c) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    default:
      return "";
  }
}

}  // namespace

std::string html_escaped(std::string_view text) {
  std::string escaped;
  for (const char c : system::valid_utf8(std::string(text))) {
    const std::string_view name = name_of(c);
    if (name.empty())
      escaped += c;
    else
      escaped += name;
  }
  return escaped;
}

}  // namespace plumb::report
