#include "references/submissions/command_line.hpp"

#include <algorithm>
#include <stdexcept>

namespace plumb::submissions {
namespace {

[[noreturn]] void refuse(std::string_view command, const char* found) {
  throw std::invalid_argument("--renderer: found " + std::string(found) + " in `" + std::string(command) +
                              "`, expected e.g. 'my-tracer {scene} {image}'");
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n'; }

/// Returns the rest of a quoted part, from behind its opening quote. Leaves `at` on the closing one.
std::string quoted(std::string_view command, std::size_t& at) {
  const char quote = command[at++];
  std::string text;
  for (; at < command.size() && command[at] != quote; ++at) {
    if (quote == '"' && command[at] == '\\' && at + 1 < command.size()) ++at;
    text += command[at];
  }
  if (at == command.size()) refuse(command, "a quote without its end");
  return text;
}

std::string replaced(std::string_view argument, const std::map<std::string, std::string>& values) {
  std::string text;
  for (std::size_t at = 0; at < argument.size();) {
    const std::size_t end = argument[at] == '{' ? argument.find('}', at) : std::string_view::npos;
    const auto value = end == std::string_view::npos
                           ? values.end()
                           : values.find(std::string(argument.substr(at + 1, end - at - 1)));
    if (value == values.end()) {
      text += argument[at++];
      continue;
    }
    text += value->second;
    at = end + 1;
  }
  return text;
}

}  // namespace

std::vector<std::string> split_command(std::string_view command) {
  std::vector<std::string> words;
  bool is_in_word = false;
  for (std::size_t at = 0; at < command.size(); ++at) {
    const char c = command[at];
    if (is_blank(c)) {
      is_in_word = false;
      continue;
    }
    if (!is_in_word) words.emplace_back();
    is_in_word = true;
    if (c == '\'' || c == '"') {
      words.back() += quoted(command, at);
    } else {
      if (c == '\\' && at + 1 < command.size()) ++at;
      words.back() += command[at];
    }
  }
  if (words.empty() || words.front().empty()) refuse(command, "no program");
  return words;
}

bool mentions(const std::vector<std::string>& arguments, std::string_view name) {
  const std::string pattern = "{" + std::string(name) + "}";
  return std::any_of(arguments.begin(), arguments.end(),
                     [&](const std::string& a) { return a.find(pattern) != std::string::npos; });
}

std::vector<std::string> substituted(const std::vector<std::string>& arguments,
                                     const std::map<std::string, std::string>& values) {
  std::vector<std::string> result;
  for (const std::string& argument : arguments) result.push_back(replaced(argument, values));
  return result;
}

}  // namespace plumb::submissions
