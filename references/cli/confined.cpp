#include "references/cli/confined.hpp"

#include <filesystem>
#include <stdexcept>

#include "references/submissions/command_line.hpp"
#include "references/system/process.hpp"

namespace plumb::cli {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t mebibyte = std::size_t{1} << 20;

/// Programs run elsewhere, so what names a file from here does it from everywhere.
std::string absolute_if_file(const std::string& word) {
  if (word.starts_with("/") || word.find('{') != std::string::npos) return word;
  const bool is_path = word.find('/') != std::string::npos ? fs::exists(word) : fs::is_regular_file(word);
  return is_path ? fs::absolute(word).lexically_normal().string() : word;
}

}  // namespace

Table limit_options(ConfinedOptions& options, const std::string& timeout) {
  return {{"--timeout", &options.timeout, timeout, {.shows_default = true, .range = within(0.1, 86400.0)}},
          {"--cpu",
           &options.cpu,
           "seconds of CPU time of all its processes",
           {.shows_default = true, .range = within(0.1, 86400.0)}},
          {"--memory",
           &options.memory_mib,
           "MiB of all its processes",
           {.shows_default = true, .range = within(16, 1 << 20)}},
          {"--disk",
           &options.disk_mib,
           "MiB of the files that it writes, and as many of what it prints",
           {.shows_default = true, .range = within(1, 1 << 20)}},
          {"--processes",
           &options.processes,
           "processes at once",
           {.shows_default = true, .range = within(3, 10000)}}};
}

submissions::SandboxLimits limits_of(const ConfinedOptions& options) {
  submissions::SandboxLimits limits;
  limits.wall_seconds = options.timeout;
  limits.cpu_seconds = options.cpu;
  limits.memory_bytes = options.memory_mib * mebibyte;
  limits.disk_bytes = options.disk_mib * mebibyte;
  limits.processes = options.processes;
  return limits;
}

std::vector<std::string> readable_paths(const ConfinedOptions& options) {
  std::vector<std::string> paths;
  for (const std::string& path : options.readable) {
    if (!fs::exists(path)) throw std::invalid_argument("--readable: found no " + path);
    paths.push_back(fs::canonical(path).string());
  }
  return paths;
}

std::vector<std::string> renderer_words(const ConfinedOptions& options) {
  std::vector<std::string> words = submissions::split_command(options.renderer);
  for (std::string& word : words) word = absolute_if_file(word);
  return words;
}

std::string found_program(const std::string& asked, const std::string& path) {
  const std::string found = asked.find('/') == std::string::npos ? system::find_program(asked) : path;
  if (found.empty() || !fs::exists(found))
    throw std::invalid_argument("--renderer: found no program `" + asked + "`");
  return found;
}

Table confined_options(ConfinedOptions& options) {
  Table rest = joined({{{"--readable",
                         &options.readable,
                         "what the renderer may read though it lies in a hidden place",
                         {.value = "PATH"}}},
                       limit_options(options, "seconds that the renderer may take for a scene")});
  for (Option& each : rest) each.rules.needs.push_back("--renderer");
  return joined(
      {{{"--renderer",
         &options.renderer,
         "gate this renderer in place of plumb: its command, run confined, with {scene} and {image} "
         "for paths, no shell; {image} is the file that the scene's render line names",
         {.value = "CMD"}}},
       rest});
}

submissions::ConfinedCommand confined_command(const ConfinedOptions& options) {
  submissions::ConfinedCommand command;
  command.words = renderer_words(options);
  command.words.front() =
      found_program(submissions::split_command(options.renderer).front(), command.words.front());
  for (const char* const name : {"scene", "image"}) {
    if (submissions::mentions(command.words, name)) continue;
    throw std::invalid_argument("--renderer: found no {" + std::string(name) + "} in `" + options.renderer +
                                "`, expected e.g. 'my-tracer {scene} {image}'");
  }
  command.readable = readable_paths(options);
  command.limits = limits_of(options);
  return command;
}

}  // namespace plumb::cli
