#include "references/gates/author.hpp"

#include <pwd.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <vector>

#include "references/system/process.hpp"

namespace plumb::gates {
namespace {

std::string variable(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

/// Returns the variables that lead git to its configuration.
std::vector<std::string> environment_of_git() {
  std::vector<std::string> all;
  for (char** at = environ; *at != nullptr; ++at) {
    const std::string_view pair = *at;
    if (pair.starts_with("HOME=") || pair.starts_with("XDG_CONFIG_HOME=") || pair.starts_with("GIT_"))
      all.emplace_back(pair);
  }
  return all;
}

/// Returns an empty text without git, without the key, or when git takes too long.
std::string configured(const std::string& directory, const std::string& key) {
  const std::string git = system::find_program("git");
  if (git.empty()) return {};
  system::ProcessLimits limits;
  limits.seconds = 10;
  const system::TemporaryDirectory own;
  const std::string place = std::filesystem::absolute(directory).string();
  const system::ProcessResult result = system::run_process({git, "-C", place, "config", "--get", key},
                                                           own.path(), limits, environment_of_git());
  if (result.timed_out || result.signal != 0 || result.exit_code != 0) return {};
  return result.output.substr(0, result.output.find('\n'));
}

std::string joined(const std::string& name, const std::string& address) {
  if (address.empty()) return name;
  return name.empty() ? address : name + " <" + address + ">";
}

}  // namespace

std::string author_in(const std::string& directory) {
  const std::string named = joined(variable("GIT_AUTHOR_NAME"), variable("GIT_AUTHOR_EMAIL"));
  if (!named.empty()) return named;
  const std::string of_git = joined(configured(directory, "user.name"), configured(directory, "user.email"));
  if (!of_git.empty()) return of_git;
  const passwd* const user = getpwuid(getuid());
  return user != nullptr ? user->pw_name : "user " + std::to_string(getuid());
}

}  // namespace plumb::gates
