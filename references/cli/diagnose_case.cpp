#include "references/cli/diagnose_case.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "references/cli/command_line.hpp"
#include "references/cli/handed_in_picture.hpp"
#include "references/cli/options.hpp"
#include "references/cli/progress.hpp"
#include "references/cli/told_fault.hpp"
#include "references/diagnosis/case.hpp"
#include "references/gates/image_pairs.hpp"
#include "references/report/diagnosis_json.hpp"
#include "references/report/results_json.hpp"
#include "references/submissions/shown_text.hpp"
#include "tracer/format/reader.hpp"
#include "tracer/system/installation.hpp"
#include "tracer/text/words.hpp"

namespace plumb::cli {
namespace {

namespace fs = std::filesystem;
using diagnosis::CaseDiagnosis;
using diagnosis::CaseFault;
using diagnosis::PictureVerdict;
using Json = nlohmann::ordered_json;

/// A picture and the scene that it is to show.
struct Pair {
  std::string scene, image;
};

struct CasePicture {
  std::string name;
  diagnosis::Diagnosis diagnosis;
};

/// What was looked at, and what was not.
struct Case {
  std::vector<Pair> pairs;  // of each picture
  std::vector<CasePicture> pictures;
  std::vector<std::pair<std::string, std::string>> left_out;  // an image, and why
  bool is_whole = true;  // false: a picture of a scene could not be diagnosed
};

/// The files of a directory by name.
std::vector<fs::path> files_in(const std::string& directory) {
  std::error_code error;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(directory, error)) {
    std::error_code none;
    if (entry.is_regular_file(none)) files.push_back(entry.path());
  }
  if (error)
    throw std::invalid_argument("diagnose: found no directory " + in_quotes(directory) +
                                " that can be read, expected one with pictures");
  std::ranges::sort(files);
  return files;
}

/// Scene files by their name without .sdf.
std::map<std::string, std::string> scenes_in(const std::string& directory) {
  std::map<std::string, std::string> scenes;
  for (const fs::path& file : files_in(directory))
    if (file.extension() == ".sdf") scenes.emplace(file.stem().string(), file.string());
  return scenes;
}

std::map<std::string, std::string> scenes_of(const CaseOptions& options) {
  if (!options.scenes.empty()) return scenes_in(options.scenes);
  auto beside = scenes_in(options.directory);
  return beside.empty() ? scenes_in(data_directory(Data::scenes)) : beside;
}

std::vector<Pair> pairs_of(const CaseOptions& options, Case& of) {
  const auto scenes = scenes_of(options);
  std::vector<Pair> pairs;
  for (const fs::path& file : files_in(options.directory)) {
    if (!gates::is_image_name(file.string())) continue;
    const auto scene = scenes.find(file.stem().string());
    if (scene == scenes.end()) {
      of.left_out.emplace_back(file.string(), "no scene has its name");
    } else if (!pairs.empty() && pairs.back().scene == scene->second) {
      of.left_out.emplace_back(file.string(), "another picture of this scene, " + pairs.back().image +
                                                  ", was taken; a case has one of each");
    } else {
      pairs.push_back({scene->second, file.string()});
    }
  }
  if (pairs.empty())
    throw std::invalid_argument("diagnose: found no picture in " + in_quotes(options.directory) +
                                " that has the name of a scene, expected e.g. phong.ppm beside phong.sdf, or "
                                "pass --scenes DIR");
  return pairs;
}

/// A picture that cannot be diagnosed is left out with its reason; the others are.
void add(const Pair& pair, const CaseOptions& options, Case& of) {
  try {
    const Scene scene = load_scene(pair.scene, options.picture.dialect, warn);
    Shot shot = shot_of(scene, options.picture);
    const auto [seen, not_looked_at] = handed_in_picture(pair.image, pair.scene, options.picture, shot);
    auto diagnosis = diagnosis::diagnose(scene, shot.camera, job_of(shot), seen, options.tolerance);
    of.pictures.push_back(
        {submissions::printable(fs::path(pair.image).filename().string()), std::move(diagnosis)});
    of.pairs.push_back(pair);
  } catch (const std::exception& error) {
    of.left_out.emplace_back(pair.image, error.what());
    of.is_whole = false;
  }
}

Case diagnosed(const CaseOptions& options) {
  Case all;
  const std::vector<Pair> pairs = pairs_of(options, all);
  Progress progress("diagnosing " + options.directory);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    progress.show(static_cast<double>(i) / static_cast<double>(pairs.size()));
    add(pairs[i], options, all);
  }
  return all;
}

std::string names_of(const std::vector<std::size_t>& numbers, const std::vector<CasePicture>& pictures) {
  std::string text;
  for (const std::size_t i : numbers) text += (text.empty() ? "" : ", ") + pictures[i].name;
  return text;
}

void print(const CaseFault& found, const std::vector<CasePicture>& pictures, int hint) {
  const faults::Fault& fault = *found.fault;
  if (hint == 1) {
    std::printf("  look at the slide \"%s\" (%s)\n", text_of(fault.slide).c_str(),
                names_of(found.pictures, pictures).c_str());
    return;
  }
  std::printf("  %s (slide \"%s\"; confidence %.2f; %s)\n", text_of(fault.explanation).c_str(),
              text_of(fault.slide).c_str(), found.confidence, names_of(found.pictures, pictures).c_str());
  if (hint == 2) return;
  print_formulas(fault);
  constexpr std::size_t most_alike = 3;
  for (std::size_t i = 0; i < std::min(most_alike, found.alike.size()); ++i)
    std::printf("      or     %s: no picture here tells it from the first\n",
                text_of(found.alike[i]->id).c_str());
}

std::string line_of(const diagnosis::Diagnosis& d) {
  if (d.verdict == PictureVerdict::right) return "right";
  const std::string summary = summary_of(d);
  return summary.empty() ? "the faults explain it" : summary;
}

void print(const CaseOptions& options, const Case& of, const CaseDiagnosis& joined) {
  std::printf("%s: %zu picture%s, %zu fault%s\n", options.directory.c_str(), of.pictures.size(),
              of.pictures.size() == 1 ? "" : "s", joined.faults.size(), joined.faults.size() == 1 ? "" : "s");
  for (const CaseFault& found : joined.faults) print(found, of.pictures, options.hint);
  if (options.hint == 3)
    for (const auto& [fault, picture, by] : joined.withdrawn)
      std::printf("  not %s, which %s alone would show: %s is right without it\n", text_of(fault->id).c_str(),
                  of.pictures[picture].name.c_str(), of.pictures[by].name.c_str());
  for (const CasePicture& picture : of.pictures) {
    std::printf("%s: %s\n", picture.name.c_str(), line_of(picture.diagnosis).c_str());
    for (const diagnosis::Habit& habit : picture.diagnosis.habits)
      std::printf("  habit: %s (%.3g %.3g %.3g)\n", habit.title.c_str(), habit.value.r, habit.value.g,
                  habit.value.b);
  }
  for (const auto& [image, why] : of.left_out)
    std::printf("left out: %s: %s\n", submissions::printable(image).c_str(),
                submissions::printable(why).c_str());
}

bool all_are_right(const Case& of) {
  return std::ranges::all_of(of.pictures, [](const CasePicture& picture) {
    return picture.diagnosis.verdict == PictureVerdict::right;
  });
}

int exit_code_of(const Case& of) {
  if (of.pictures.empty()) return exit_trouble;
  if (all_are_right(of)) return of.is_whole ? exit_agrees : exit_trouble;
  const bool is_something = std::ranges::any_of(of.pictures, [](const CasePicture& picture) {
    return picture.diagnosis.tells_something() || picture.diagnosis.verdict == PictureVerdict::right;
  });
  return is_something ? exit_differs : exit_abstains;
}

const char* verdict_of(const Case& of, const CaseDiagnosis& joined) {
  if (of.pictures.empty()) return "unexplained";
  return of.is_whole && all_are_right(of) ? "right" : joined.faults.empty() ? "unexplained" : "faults";
}

Json to_json(const CaseOptions& options, const Case& of, const CaseDiagnosis& joined) {
  Json pictures = Json::array(), left_out = Json::array();
  std::vector<std::string> names;
  for (const CasePicture& picture : of.pictures) names.push_back(picture.name);
  for (std::size_t i = 0; i < of.pictures.size(); ++i) {
    Json json{{"scene", of.pairs[i].scene}, {"image", of.pairs[i].image}};
    json.update(report::to_json(of.pictures[i].diagnosis, options.hint));
    pictures.push_back(std::move(json));
  }
  for (const auto& [image, why] : of.left_out)
    left_out.push_back({{"image", submissions::printable(image)}, {"why", submissions::printable(why)}});
  Json json{{"tool", "plumb"},
            {"version", PLUMB_VERSION},
            {"case", options.directory},
            {"verdict", verdict_of(of, joined)}};
  json.update(report::to_json(joined, names, options.hint));
  json["pictures"] = pictures;
  json["left_out"] = left_out;
  return json;
}

}  // namespace

int diagnose_case(const CaseOptions& options) {
  const Case all = diagnosed(options);
  std::vector<const diagnosis::Diagnosis*> told;
  for (const CasePicture& picture : all.pictures) told.push_back(&picture.diagnosis);
  const CaseDiagnosis joined = diagnosis::diagnosis_of_case(told);
  if (options.json != "-") print(options, all, joined);
  if (!options.json.empty()) report::write_json(options.json, to_json(options, all, joined));
  return exit_code_of(all);
}

}  // namespace plumb::cli
