#include "references/submissions/run_tracer.hpp"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <mutex>
#include <shared_mutex>
#include <stdexcept>
#include <tuple>

#include "references/submissions/collect.hpp"
#include "references/submissions/command_line.hpp"
#include "references/submissions/no_picture.hpp"
#include "references/submissions/sandbox/shown_places.hpp"
#include "references/submissions/shown_text.hpp"
#include "references/system/process.hpp"
#include "tracer/image/format.hpp"
#include "tracer/system/files.hpp"

namespace plumb::submissions {
namespace {

namespace fs = std::filesystem;

/// True if a directory may be shown. Homes and top directories hold more than a program and what lies beside
/// it.
bool is_a_room_of_its_own(const fs::path& directory) {
  const char* const home = std::getenv("HOME");
  const fs::path above = directory.parent_path();
  return directory != "/" && above != "/" && above != "/home" && directory != "/var/tmp" &&
         (home == nullptr || directory != fs::path(home).lexically_normal());
}

bool is_plumb(const fs::path& file) {
  std::error_code none;
  return fs::equivalent(file, "/proc/self/exe", none);
}

/// Adds what may be read for a word of the command that names a file: its directory, for what lies beside a
/// program; or the file alone where that directory is a home or the like, or holds all submissions. Plumb is
/// shown to a run of plumb that was asked for.
void allow(const std::string& word, const JudgeOptions& options, std::vector<std::string>& readable) {
  std::error_code none;
  if (!word.starts_with("/") || !fs::exists(word, none)) return;
  const fs::path path = fs::path(word).lexically_normal();
  if (path == "/" || path == "/tmp" || path == "/tmp/") return;  // the program has others at these places
  const std::string parent = path.parent_path().string();
  const bool has_beside = !fs::is_directory(path) && is_a_room_of_its_own(parent) &&
                          fs::weakly_canonical(parent, none) != options.submissions_directory;
  readable.push_back(has_beside ? parent : path.string());
  if (is_plumb(path)) readable.push_back(path.string());
}

std::vector<std::string> readable_by_all(const JudgeOptions& options) {
  std::vector<std::string> readable = options.readable;
  for (const std::string& word : options.command) allow(word, options, readable);
  return readable;
}

/// Of a directory with what is shown the pages and journals alone.
void hide(const std::string& result, const std::vector<std::string>& readable,
          std::vector<std::string>& hidden) {
  std::error_code none;
  const fs::path real = fs::weakly_canonical(fs::absolute(result), none);
  const bool is_shared = std::any_of(readable.begin(), readable.end(), [&](const std::string& path) {
    return lies_in(fs::weakly_canonical(path, none), real);
  });
  if (!is_shared || !fs::is_directory(real, none)) return hidden.push_back(real.string());
  for (const auto& entry : fs::directory_iterator(real, none)) {
    const fs::path kind = entry.path().extension();
    if (kind == ".html" || kind == ".jsonl") hidden.push_back(entry.path().string());
  }
}

SandboxView view_for(const Submission& submission, const JudgeOptions& options, const std::string& given) {
  SandboxView view{given, readable_by_all(options), hidden_from_runs(options)};
  if (!options.submissions_directory.empty()) view.readable.push_back(submission.path);
  return view;
}

/// Lets runs go side by side, except one that has to be alone.
class Runway {
 public:
  SandboxRun run_beside_others(const std::function<SandboxRun()>& run) {
    std::unique_lock turn(turnstile_);
    const std::shared_lock lock(runway_);
    turn.unlock();
    return run();
  }
  SandboxRun run_alone(const std::function<SandboxRun()>& run) {
    const std::scoped_lock turn(turnstile_);  // so that no others begin meanwhile
    const std::scoped_lock lock(runway_);
    return run();
  }

 private:
  std::mutex turnstile_;
  std::shared_mutex runway_;
};

/// Runs the command, and once more, alone, when it timed out because others had the cores.
SandboxRun fair_run(const std::vector<std::string>& command, const SandboxView& view,
                    const SandboxLimits& limits) {
  static Runway runway;
  const auto run = [&] { return run_confined(command, view, limits); };
  SandboxRun first = runway.run_beside_others(run);
  return first.was_starved ? runway.run_alone(run) : first;
}

Judged verdict_of(Ending ending) {
  switch (ending) {
    case Ending::timed_out:
      return Judged::timed_out;
    case Ending::too_much_cpu:
      return Judged::too_much_cpu;
    case Ending::too_much_memory:
      return Judged::too_much_memory;
    case Ending::too_many_processes:
      return Judged::too_many_processes;
    case Ending::too_much_output:
      return Judged::too_much_output;
    case Ending::finished:
      break;
  }
  return Judged::no_image;
}

const char* what_raises(Ending ending) {
  switch (ending) {
    case Ending::timed_out:
      return " (--timeout raises it)";
    case Ending::too_much_cpu:
      return " (--cpu raises it)";
    case Ending::too_much_memory:
      return " (--memory raises it)";
    case Ending::too_many_processes:
      return " (--processes raises it)";
    case Ending::too_much_output:
      return " of what it writes, of what it prints, or of files (--disk raises the first two)";
    case Ending::finished:
      break;
  }
  return "";
}

/// For a message: the last line that was printed, shortened; empty when nothing was.
std::string last_words(const std::string& printed) {
  constexpr std::size_t longest = 120;
  const std::size_t end = printed.find_last_not_of(" \t\r\n");
  if (end == std::string::npos) return {};
  const std::size_t before = printed.find_last_of('\n', end);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  return "; its last words: " + printed.substr(begin, std::min(longest, end + 1 - begin));
}

/// Programs of root run as somebody else. What only its owner may read or execute would have run for the
/// owner, so this complains of it. `words` are those of the command; in the submission it looks at the first
/// files.
void require_open_to_others(const std::vector<std::string>& words, const std::string& submission) {
  if (geteuid() != 0) return;
  constexpr int most_files = 10'000;
  const auto require = [](const fs::path& file) {
    std::error_code none;
    const fs::file_status status = fs::symlink_status(file, none);
    if (!fs::is_regular_file(status)) return;
    for (const auto& [own, of_others, verb] :
         {std::tuple(fs::perms::owner_read, fs::perms::others_read, "read"),
          std::tuple(fs::perms::owner_exec, fs::perms::others_exec, "execute")})
      if ((status.permissions() & own) == own && (status.permissions() & of_others) != of_others)
        throw std::runtime_error(file.string() + ": others may not " + verb +
                                 " it, and a program that root judges " +
                                 "runs as somebody else; expected chmod -R go+rX");
  };
  for (const std::string& word : words)
    if (word.starts_with("/")) require(word);
  std::error_code none;
  int files = 0;
  for (fs::recursive_directory_iterator at(submission, none), end; !none && at != end && files < most_files;
       at.increment(none), ++files)
    require(at->path());
}

/// True when the run itself is the verdict.
bool ended_badly(const SandboxRun& run, JudgedPicture& result) {
  result.printed = run.printed;
  result.wall_seconds = run.wall_seconds;
  if (run.ending != Ending::finished) {
    result.verdict = verdict_of(run.ending);
    result.message = "stopped at a limit after " + std::to_string(run.wall_seconds).substr(0, 4) + " s" +
                     what_raises(run.ending);
    const std::string kind =
        run.ending == Ending::too_much_output ? printed_image(run.printed) : std::string();
    if (!kind.empty())
      result.message += "; a picture was printed to standard output as " + kind + ", expected it in {image}";
  } else if (!run.not_executed.empty()) {
    result.verdict = Judged::crashed;
    result.message = "cannot be executed: " + run.not_executed +
                     ": is it there, executable, and the interpreter of its first line, too?";
  } else if (run.signal != 0) {
    result.verdict = Judged::crashed;
    result.message = "ended by signal " + std::to_string(run.signal) + ", or exit code " +
                     std::to_string(run.exit_code) + last_words(run.printed);
  }
  return !result.message.empty();
}

/// `what_else` is said where there is nothing at all.
void say_why_none(Found found, int exit_code, const std::string& what_else, JudgedPicture& result) {
  result.verdict = Judged::no_image;
  result.message = what_else;
  if (found == Found::forbidden) {
    result.verdict = Judged::unreadable;
    result.message = "the picture's file forbids that it is read";
  } else if (found == Found::not_a_file) {
    result.message = "a link, a pipe or a directory stands where the picture should be";
  } else if (found == Found::too_large) {
    result.verdict = Judged::too_much_output;
    result.message = "the picture's file is larger than allowed";
  } else if (exit_code != 0) {
    result.verdict = Judged::crashed;
    result.message = "exit code " + std::to_string(exit_code) + " and no picture: " + what_else;
    if (exit_code == 127)
      result.message +=
          "; a shell says 127 for a program that is not there: what lies outside the system's "
          "directories is seen with --readable alone";
    result.message += last_words(result.printed);
  }
}

/// What course tracers call their picture.
std::string name_in_scene(const JudgedScene& scene) {
  return fs::path(scene.scene.renders.front().file).lexically_normal().string();
}

std::string target_in(const std::string& directory, const std::string& name) {
  const std::string extension = extension_of(name);
  return directory + "/picture" + (extension.empty() ? ".ppm" : extension);
}

}  // namespace

void require_confined_runs(const Submission& submission, const JudgeOptions& options) {
  const std::string& program = options.command.front();
  require_sandbox(view_for(submission, options, {}), program.starts_with("/") ? program : std::string());
}

std::string picture_of_run(const Submission& submission, const JudgedScene& scene,
                           const JudgeOptions& options, const std::string& own_directory,
                           JudgedPicture& result) {
  const system::TemporaryDirectory work;
  const std::string inside = std::string(sandbox_directory) + "/" + scene.name;
  const std::string scene_file = scene.name + ".sdf";
  write_file(work.path() + "/" + scene_file, scene.text);
  const auto command =
      substituted(options.command,
                  {{"scene", inside + ".sdf"}, {"image", inside + ".ppm"}, {"submission", submission.path}});
  const SandboxRun run = fair_run(command, view_for(submission, options, work.path()), options.limits);
  if (!run.not_executed.empty()) require_open_to_others(command, submission.path);
  if (ended_badly(run, result)) return {};
  Found found = Found::nothing;
  const std::vector<std::string> names{scene.name + ".ppm", name_in_scene(scene)};
  for (const std::string& name : names) {
    const std::string target = target_in(own_directory, name);
    found = take_file(run.directory(), name, options.limits.disk_bytes, target);
    if (found == Found::picture) return target;
    if (found != Found::nothing) break;
  }
  if (found == Found::nothing && run.exit_code != 0) require_open_to_others(command, submission.path);
  const std::string expected = shown_name(names[0] == names[1] ? names[0] : names[0] + " or " + names[1]);
  say_why_none(found, run.exit_code,
               why_no_picture(run.printed, files_left_in(run.directory(), scene_file), expected), result);
  return {};
}

std::vector<std::string> picture_extensions() {
  std::vector<std::string> all{".ppm", ".png",  ".pfm", ".exr", ".tif", ".tiff",
                               ".jpg", ".jpeg", ".bmp", ".tga", ".hdr"};
  for (std::size_t i = 0, lower = all.size(); i < lower; ++i) {
    std::string upper = all[i];
    for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    all.push_back(upper);
  }
  return all;
}

std::string picture_handed_in(const Submission& submission, const JudgedScene& scene,
                              const JudgeOptions& options, const std::string& own_directory,
                              JudgedPicture& result) {
  Found found = Found::nothing;
  std::string name, taken;
  for (const std::string& extension : picture_extensions()) {
    const std::string other = scene.name + extension, target = target_in(own_directory, other);
    const Found now = take_file(submission.path, other, options.limits.disk_bytes, target);
    if (now == Found::nothing) continue;
    if (found != Found::nothing)
      throw std::runtime_error(submission.path + ": found " + shown_name(name) + " and " + shown_name(other) +
                               ", expected one picture of each scene");
    found = now;
    name = other;
    taken = target;
  }
  if (found == Found::picture) return taken;
  if (found == Found::not_a_file && fs::is_symlink(fs::path(submission.path) / name))
    throw std::runtime_error(submission.path + "/" + shown_name(name) +
                             ": found a link, which may lead to what is not the submission's, expected a "
                             "picture; put a copy in its place (cp -L)");
  if (found == Found::forbidden)
    throw std::runtime_error(submission.path + ": we may not read it; chmod -R u+rX, or judge as its owner");
  say_why_none(found, 0, "no picture " + shown_name(scene.name) + ".ppm, .png, ... was handed in", result);
  return {};
}

std::vector<std::string> files_of_command(const JudgeOptions& options) {
  std::vector<std::string> files = readable_by_all(options);
  std::error_code none;
  for (const std::string& word : options.command)
    if (word.starts_with("/") && fs::is_regular_file(word, none)) files.push_back(word);
  return files;
}

std::vector<std::string> hidden_from_runs(const JudgeOptions& options) {
  std::vector<std::string> hidden;
  if (!options.submissions_directory.empty()) hidden.push_back(options.submissions_directory);
  const std::vector<std::string> readable = readable_by_all(options);
  for (const std::string& result : options.results) hide(result, readable, hidden);
  return hidden;
}

}  // namespace plumb::submissions
