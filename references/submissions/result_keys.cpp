#include "references/submissions/result_keys.hpp"

#include <filesystem>

#include "references/submissions/fingerprint.hpp"
#include "references/submissions/run_tracer.hpp"
#include "references/system/digest.hpp"
#include "tracer/format/writer.hpp"
#include "tracer/text/numbers.hpp"

namespace plumb::submissions {
namespace {

/// Joins texts, each behind its length, so that no two lists give the same text.
std::string joined(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += std::to_string(text.size()) + ":" + text;
  return all;
}

std::string of_limits(const SandboxLimits& limits) {
  return joined({to_text(limits.wall_seconds), to_text(limits.cpu_seconds),
                 std::to_string(limits.memory_bytes), std::to_string(limits.processes),
                 std::to_string(limits.disk_bytes), std::to_string(limits.files)});
}

std::string of_this_program() {
  std::error_code none;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", none);
  return joined({PLUMB_VERSION, none ? std::string() : fingerprint_of(self.string())});
}

std::string of_options(const JudgeOptions& options) {
  return joined({joined(options.command), joined(options.readable), of_limits(options.limits),
                 options.keeps_pictures ? "pictures" : "", std::to_string(options.render.depth),
                 std::to_string(static_cast<int>(options.render.glass_shadow)),
                 options.tolerance ? to_text(*options.tolerance) : ""});
}

}  // namespace

ResultKeys::ResultKeys(const JudgeOptions& options) : options_(options) {
  if (options.journal == nullptr) return;
  hidden_ = hidden_from_runs(options);
  common_ = joined({of_this_program(), of_options(options)});
}

std::string ResultKeys::state_of_file(const std::string& path) {
  const std::scoped_lock lock(mutex_);
  std::string& state = files_[path];
  if (state.empty()) state = system::sha256(fingerprint_of(path, hidden_));
  return state;
}

std::string ResultKeys::state_of(const Submission& submission) {
  std::string state = submission.path;
  if (!submission.path.empty()) state += state_of_file(submission.path);
  for (const std::string& path : files_of_command(options_)) state += state_of_file(path);
  return state;
}

std::string ResultKeys::of(const Submission& submission, const JudgedScene& scene) {
  return system::sha256(
      joined({common_, state_of(submission), scene.name, scene.text, write_scene(scene.scene)}));
}

}  // namespace plumb::submissions
