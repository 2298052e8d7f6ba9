#include "references/cli/own_inputs.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "references/submissions/command_line.hpp"

namespace plumb::cli {
namespace {

namespace fs = std::filesystem;

bool is_one_of(const std::string& word, const std::vector<std::string>& all) {
  return std::find(all.begin(), all.end(), word) != all.end();
}

/// Whether it holds text or a drawing about results: never a scene or a picture.
bool holds_results(const std::string& option) {
  return is_one_of(option, {"--json", "--csv", "--junit", "--stats-json", "--svg"});
}

bool is_output(const std::string& option) {
  return holds_results(option) || is_one_of(option, {"--output", "--diff"});
}

bool is_input_by_name(const fs::path& path) {
  return is_one_of(path.extension().string(), {".sdf", ".ppm", ".pgm", ".pbm", ".pfm", ".png", ".exr", ".tif",
                                               ".tiff", ".bmp", ".tga", ".jpg", ".jpeg", ".hdr"}) ||
         is_one_of(path.filename().string(), {"baselines.json", "bounds.json"});
}

[[noreturn]] void refuse(const std::string& option, const std::string& file) {
  throw std::invalid_argument(option + ": found " + file +
                              ", which is an input, expected the name of another file");
}

/// As a path that tells whether two names are of one file, which need not be there yet.
fs::path place_of(const std::string& file) {
  std::error_code none;
  fs::path place = fs::weakly_canonical(fs::absolute(file, none), none);
  return place.empty() ? fs::path(file).lexically_normal() : place;
}

bool is_no_place(const std::string& file) {
  std::error_code none;
  return file.empty() || file == "-" || fs::is_other(file, none);
}

void refuse_one_file_twice(const Request& request) {
  std::map<fs::path, std::string> taken;
  fs::path report;
  for (const auto& [name, values] : request.given) {
    if (name == "--report" && !values.empty()) report = place_of(values.front());
    if (!is_output(name) && name != "--resume") continue;
    for (const std::string& file : values) {
      if (is_no_place(file)) continue;
      const auto [at, is_new] = taken.emplace(place_of(file), name);
      if (!is_new)
        throw std::invalid_argument(name + ": found " + file + ", which " + at->second +
                                    " names, too, expected the name of another file");
    }
  }
  for (const auto& [place, name] : taken) {
    const std::string kind = place.extension().string();
    const bool is_reports = name == "--resume" ? kind == ".html" : kind == ".html" || kind == ".jsonl";
    if (!report.empty() && place.parent_path() == report && is_reports)
      throw std::invalid_argument(name + ": found " + place.string() +
                                  ", as --report may name its own files, expected another name or place");
  }
}

/// What a command runs: a word of --renderer, or anything below --submissions.
bool is_run(const Request::Given& given, const std::string& file) {
  std::error_code none;
  for (const std::string& value : given.values) {
    if (given.option == "--submissions") {
      const fs::path below = place_of(file).lexically_relative(place_of(value));
      if (!below.empty() && *below.begin() != "..") return true;
    }
    if (given.option != "--renderer") continue;
    for (const std::string& word : submissions::split_command(value))
      if (fs::equivalent(word, file, none)) return true;
  }
  return false;
}

}  // namespace

void refuse_to_overwrite_inputs(const Request& request) {
  refuse_one_file_twice(request);
  for (const auto& [name, files] : request.given) {
    if (!is_output(name)) continue;
    for (const std::string& file : files) {
      std::error_code none;
      if (!fs::is_regular_file(file, none)) continue;
      if (holds_results(name) && is_input_by_name(file)) refuse(name, file);
      for (const Request::Given& other : request.given) {
        if (is_output(other.option)) continue;
        if (is_run(other, file)) refuse(name, file);
        for (const std::string& input : other.values)
          if (fs::equivalent(input, file, none)) refuse(name, file);
      }
    }
  }
}

}  // namespace plumb::cli
