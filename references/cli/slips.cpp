#include "references/cli/slips.hpp"

#include <algorithm>

#include "tracer/text/words.hpp"

namespace plumb::cli {
namespace {

std::vector<std::string> names_of_options(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

std::vector<std::string> names_of_commands(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

}  // namespace

std::string likely_slip(const CLI::App& app) {
  const std::vector<std::string> words = app.remaining(true);
  const auto parsed = app.get_subcommands();
  const auto option =
      std::find_if(words.begin(), words.end(), [](const auto& w) { return w.starts_with("--"); });
  std::optional<std::string> near;
  if (option != words.end()) {
    const std::vector<std::string> known = names_of_options(parsed.empty() ? app : *parsed.front());
    near = nearest_name(option->substr(0, option->find('=')), {known.begin(), known.end()});
  } else if (!words.empty() && parsed.empty()) {
    const std::vector<std::string> known = names_of_commands(app);
    near = nearest_name(words.front(), {known.begin(), known.end()});
  }
  return near ? "did you mean " + *near + "?" : "";
}

}  // namespace plumb::cli
