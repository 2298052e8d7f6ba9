#include "references/report/junit.hpp"

#include <algorithm>
#include <charconv>

#include "references/system/json.hpp"

namespace plumb::report {
namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD";  // U+FFFD

enum class Place { attribute, text };

std::string escaped(char c, Place place) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\r':  // bare, a parser turns it into a line feed
      return "&#13;";
    case '\n':
    case '\t':  // bare in an attribute, into a blank
      return place == Place::attribute ? "&#" + std::to_string(c) + ";" : std::string(1, c);
    default:
      break;
  }
  const bool is_control = static_cast<unsigned char>(c) < ' ';
  return is_control ? std::string(replacement) : std::string(1, c);
}

std::string escaped(const std::string& text, Place place) {
  const std::string valid = system::valid_utf8(text);
  std::string result;
  for (std::size_t i = 0; i < valid.size(); ++i) {
    const std::string_view three = std::string_view(valid).substr(i, 3);
    const bool is_no_character = three == "\xEF\xBF\xBE" || three == "\xEF\xBF\xBF";  // U+FFFE, U+FFFF
    result += is_no_character ? std::string(replacement) : escaped(valid[i], place);
    if (is_no_character) i += 2;
  }
  return result;
}

/// Without an exponent and with a point whatever the locale, to the microsecond.
std::string seconds_text(double seconds) {
  char text[64];
  return {text, std::to_chars(text, text + sizeof text, seconds, std::chars_format::fixed, 6).ptr};
}

std::string attribute(const char* name, const std::string& value) {
  return std::string(" ") + name + "=\"" + escaped(value, Place::attribute) + "\"";
}

std::string totals(const std::vector<JunitCase>& cases) {
  const auto count = [&](JunitCase::Outcome outcome) {
    return std::to_string(
        std::count_if(cases.begin(), cases.end(), [&](const JunitCase& c) { return c.outcome == outcome; }));
  };
  double seconds = 0;
  for (const JunitCase& c : cases) seconds += c.seconds;
  return attribute("tests", std::to_string(cases.size())) +
         attribute("failures", count(JunitCase::Outcome::failed)) +
         attribute("errors", count(JunitCase::Outcome::error)) + attribute("time", seconds_text(seconds));
}

std::string element(const std::string& suite, const JunitCase& c) {
  const std::string head = "    <testcase" + attribute("name", c.name) + attribute("classname", suite) +
                           attribute("time", seconds_text(c.seconds));
  if (c.outcome == JunitCase::Outcome::passed) {
    if (c.output.empty()) return head + "/>\n";
    return head + ">\n      <system-out>" + escaped(c.output, Place::text) +
           "</system-out>\n    </testcase>\n";
  }
  const bool is_failure = c.outcome == JunitCase::Outcome::failed;
  const std::string tag = is_failure ? "failure" : "error";
  return head + ">\n      <" + tag + attribute("message", c.message) +
         attribute("type", is_failure ? "differ" : "trouble") + ">" + escaped(c.details, Place::text) + "</" +
         tag + ">\n    </testcase>\n";
}

}  // namespace

std::string junit_xml(const std::string& suite, const std::vector<JunitCase>& cases) {
  std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites" + totals(cases) +
                    ">\n  <testsuite" + attribute("name", suite) + totals(cases) + ">\n";
  for (const JunitCase& c : cases) xml += element(suite, c);
  return xml + "  </testsuite>\n</testsuites>\n";
}

}  // namespace plumb::report
