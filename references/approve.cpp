#include "references/approve.hpp"

#include <pwd.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <stdexcept>
#include <string_view>

#include "references/digest.hpp"
#include "tracer/scene/lexer.hpp"
#include "tracer/scene/reader.hpp"

namespace plumb::references {
namespace {

namespace fs = std::filesystem;

bool is_among(const std::vector<std::string>& sorted, const std::string& name) {
  return std::binary_search(sorted.begin(), sorted.end(), name);
}

std::string who_asks() {
  if (const char* name = std::getenv("GIT_AUTHOR_NAME"); name != nullptr && *name != '\0') return name;
  const passwd* const user = getpwuid(getuid());
  return user != nullptr ? user->pw_name : "user " + std::to_string(getuid());
}

std::string now() {
  const std::time_t time = std::time(nullptr);
  std::tm utc{};
  char text[sizeof "2000-01-01T00:00:00Z"];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", gmtime_r(&time, &utc));
  return text;
}

/// The last part of a path into the directory; other text as it stands.
std::string part_within(const std::string& text, const std::string& directory) {
  const fs::path path(text);
  const bool is_within =
      path.has_parent_path() && fs::weakly_canonical(path.parent_path()) == fs::canonical(directory);
  return is_within ? path.filename().string() : text;
}

/// The scene, or the baseline without one, that the text names.
std::string name_meant(const std::string& text, const std::string& directory,
                       const std::vector<std::string>& known) {
  const std::string within = part_within(text, directory);
  constexpr std::string_view extension = ".sdf";
  const bool is_file = within.ends_with(extension);
  const std::string name = is_file ? within.substr(0, within.size() - extension.size()) : within;
  if (is_among(known, name)) return name;
  if (is_among(known, within)) return within;
  const auto nearest = nearest_name(name, {known.begin(), known.end()});
  throw std::invalid_argument("--update: found " + in_quotes(text) + ", expected a scene in " + directory +
                              (nearest ? "; did you mean '" + *nearest + "'?" : ""));
}

Baseline record_of(const std::string& path, const std::string& name, const ApprovalRequest& request) {
  Baseline record;
  record.name = name;
  record.who = who_asks();
  record.when = now();
  record.why = request.why;
  record.version = PLUMB_VERSION;
  record.scene_sha256 = sha256(read_text_file(path));
  const std::string file = (name.front() == '-' ? "./" : "") + name + ".sdf";  // not to be an option
  record.command = "plumb render " + shell_word(file) + " -o " + shell_word("baselines/" + name + ".exr") +
                   request.arguments;
  return record;
}

void refuse_non_finite(const Image& image, const std::string& path) {
  const std::string complaint = non_finite_pixels(image);
  if (complaint.empty()) return;
  throw std::runtime_error(path + ": not approved, nothing is stored: " + complaint +
                           "; is a light or a colour far too bright?");
}

std::vector<std::string> sorted_union(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  std::sort(a.begin(), a.end());
  a.erase(std::unique(a.begin(), a.end()), a.end());
  return a;
}

}  // namespace

std::vector<Approved> approve(const std::string& directory, const RegressOptions& options,
                              const ApprovalRequest& request) {
  const std::vector<std::string> scenes = scene_names(directory);
  const std::vector<std::string> known = sorted_union(scenes, Baselines(baselines_of(directory)).names());
  std::vector<std::string> meant;
  for (const std::string& text : request.scenes) meant.push_back(name_meant(text, directory, known));
  BaselineUpdate update(baselines_of(directory), directory);
  std::vector<Approved> result;
  for (const std::string& name : sorted_union(meant, {})) {
    if (!is_among(scenes, name)) {
      update.forget(name);
      result.push_back({name, true});
      continue;
    }
    const std::string path = scene_path(directory, name);
    const Baseline record = record_of(path, name, request);
    const Image image = rendered(load_scene(path, options.dialect, request.warn), options);
    refuse_non_finite(image, path);
    update.add(record, image);
    result.push_back({name, false, is_of_one_colour(image), image.width, image.height});
  }
  update.commit();
  return result;
}

std::string shell_word(const std::string& text) {
  constexpr std::string_view plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=,:@%+";
  if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

}  // namespace plumb::references
