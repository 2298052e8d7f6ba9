#include <algorithm>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "references/submissions/grade.hpp"
#include "references/submissions/run_tracer.hpp"
#include "references/submissions/shown_text.hpp"
#include "tracer/format/reader.hpp"
#include "tracer/image/format.hpp"
#include "tracer/system/installation.hpp"

namespace plumb::submissions {
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

bool is_picture_name(const fs::path& path) {
  const std::vector<std::string> all = picture_extensions();
  return std::find(all.begin(), all.end(), extension_of(path.string())) != all.end();
}

/// A link that is handed in is not followed, because it may lead to what is not the submission's. Judging it
/// reports the link.
Submission submission_at(const fs::path& path) {
  return {shown_name(path.filename().string()),
          (fs::canonical(path.parent_path()) / path.filename()).string()};
}

}  // namespace

std::vector<JudgedScene> scenes_to_judge(const std::string& directory, const Dialect& dialect) {
  const std::string place = directory.empty() ? data_directory(Data::scenes) : directory;
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
  bool has_directories = false, has_pictures = false;
  for (const fs::path& path : entries_of(directory)) {
    std::error_code none;
    const bool is_link = fs::is_symlink(path, none);
    has_pictures |= is_picture_name(path) && !fs::is_directory(path, none);
    if (!fs::is_directory(path, none)) continue;
    has_directories |= !is_link;
    all.push_back(submission_at(path));
  }
  if (has_directories || (!all.empty() && !has_pictures)) return all;
  const fs::path self = fs::canonical(directory);
  return {{shown_name(self.filename().string()), self.string()}};
}

std::vector<std::string> pictures_of_no_scene(const std::string& directory,
                                              const std::vector<Submission>& submissions,
                                              const std::vector<JudgedScene>& scenes) {
  std::set<std::string> names;
  for (const JudgedScene& scene : scenes) {
    for (const std::string& extension : picture_extensions()) names.insert(scene.name + extension);
  }
  const fs::path top = fs::canonical(directory);
  std::vector<std::string> found;
  const auto look = [&](const fs::path& place, bool is_submission) {
    std::error_code unreadable;
    for (fs::directory_iterator at(place, unreadable), end; !unreadable && at != end;
         at.increment(unreadable)) {
      const fs::path& path = at->path();
      std::error_code none;
      if (!is_picture_name(path) || fs::is_directory(path, none)) continue;
      if (!is_submission || !names.contains(path.filename().string()))
        found.push_back(shown_name(path.lexically_relative(top).string()));
    }
  };
  bool has_directories = true;
  for (const Submission& submission : submissions) {
    has_directories &= submission.path != top;
    if (!fs::is_symlink(submission.path)) look(submission.path, true);
  }
  if (has_directories) look(top, false);
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace plumb::submissions
