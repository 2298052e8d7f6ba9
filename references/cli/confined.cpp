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

std::vector<std::string> words_of(const std::string& renderer) {
  std::vector<std::string> words = references::split_command(renderer);
  const std::string program = words.front();
  for (std::string& word : words) word = absolute_if_file(word);
  const std::string found =
      program.find('/') == std::string::npos ? references::find_program(program) : words.front();
  if (found.empty() || !fs::exists(found))
    throw std::invalid_argument("--renderer: found no program `" + program + "`");
  words.front() = found;
  return words;
}

}  // namespace

CLI::Option* add_confined(CLI::App& app, ConfinedOptions& options) {
  CLI::Option* const renderer =
      app.add_option(
             "--renderer", options.renderer,
             "gate this renderer in place of plumb: its command, run confined, with {scene} and {image} "
             "for paths, no shell; {image} is the file that the scene's render line names")
          ->type_name("CMD");
  app.add_option("--readable", options.readable,
                 "what the renderer may read though it lies in a hidden place")
      ->type_name("PATH")
      ->needs(renderer);
  app.add_option("--timeout", options.timeout, "seconds that the renderer may take for a scene")
      ->check(CLI::Range(0.1, 86400.0))
      ->capture_default_str()
      ->needs(renderer);
  app.add_option("--cpu", options.cpu, "seconds of CPU time of all its processes")
      ->check(CLI::Range(0.1, 86400.0))
      ->capture_default_str()
      ->needs(renderer);
  app.add_option("--memory", options.memory_mib, "MiB of all its processes")
      ->check(CLI::Range(16, 1 << 20))
      ->capture_default_str()
      ->needs(renderer);
  app.add_option("--disk", options.disk_mib, "MiB of the files that it writes, and as many of what it prints")
      ->check(CLI::Range(1, 1 << 20))
      ->capture_default_str()
      ->needs(renderer);
  app.add_option("--processes", options.processes, "processes at once")
      ->check(CLI::Range(3, 10000))
      ->capture_default_str()
      ->needs(renderer);
  return renderer;
}

references::ConfinedCommand confined_command(const ConfinedOptions& options) {
  references::ConfinedCommand command;
  command.words = words_of(options.renderer);
  for (const char* const name : {"scene", "image"}) {
    if (references::mentions(command.words, name)) continue;
    throw std::invalid_argument("--renderer: found no {" + std::string(name) + "} in `" + options.renderer +
                                "`, expected e.g. 'my-tracer {scene} {image}'");
  }
  for (const std::string& path : options.readable) {
    if (!fs::exists(path)) throw std::invalid_argument("--readable: found no " + path);
    command.readable.push_back(fs::canonical(path).string());
  }
  command.limits.wall_seconds = options.timeout;
  command.limits.cpu_seconds = options.cpu;
  command.limits.memory_bytes = options.memory_mib * mebibyte;
  command.limits.disk_bytes = options.disk_mib * mebibyte;
  command.limits.processes = options.processes;
  return command;
}

}  // namespace plumb::cli
