#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "references/judging/judging.hpp"
#include "references/judging/shown_text.hpp"
#include "tracer/scene/reader.hpp"

namespace plumb::references {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> entries_of(const std::string& directory) {
  if (!fs::is_directory(directory)) throw std::runtime_error(directory + ": found no directory of that name");
  std::vector<fs::path> all;
  for (const auto& entry : fs::directory_iterator(directory))
    if (!entry.path().filename().string().starts_with(".")) all.push_back(entry.path());
  std::sort(all.begin(), all.end());
  return all;
}

/// A link that is handed in is not followed: it may lead to what is not the submission's.
Submission submission_at(const fs::path& path) {
  return {shown_name(path.filename().string()),
          (fs::canonical(path.parent_path()) / path.filename()).string()};
}

}  // namespace

std::vector<JudgedScene> scenes_to_judge(const std::string& directory, const Dialect& dialect) {
  const std::string place = directory.empty() ? PLUMB_SOURCE_DIRECTORY "/tests/scenes" : directory;
  std::vector<JudgedScene> scenes;
  for (const fs::path& path : entries_of(place)) {
    if (path.extension() != ".sdf") continue;
    if (directory.empty() && path.filename().string().starts_with("combined-")) continue;
    scenes.push_back(
        {path.stem().string(), read_text_file(path.string()), load_scene(path.string(), dialect)});
  }
  if (scenes.empty()) throw std::runtime_error(place + ": found no scene, expected *.sdf");
  return scenes;
}

std::vector<Submission> submissions_in(const std::string& directory) {
  std::vector<Submission> all;
  for (const fs::path& path : entries_of(directory)) all.push_back(submission_at(path));
  if (all.empty()) throw std::runtime_error(directory + ": found nothing in it, expected submissions");
  return all;
}

std::vector<Submission> pictures_in(const std::string& directory) {
  std::vector<Submission> all;
  for (const fs::path& path : entries_of(directory))
    if (fs::is_directory(fs::symlink_status(path))) all.push_back(submission_at(path));
  if (all.empty()) {
    const fs::path self = fs::canonical(directory);
    all.push_back({shown_name(self.filename().string()), self.string()});
  }
  return all;
}

}  // namespace plumb::references
