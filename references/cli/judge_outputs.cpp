#include "references/cli/judge_outputs.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <set>
#include <stdexcept>

#include "references/cli/options.hpp"
#include "references/report/class_json.hpp"
#include "references/report/html/own_page.hpp"
#include "references/report/results_json.hpp"
#include "references/submissions/shown_text.hpp"
#include "tracer/system/files.hpp"

namespace plumb::cli {
namespace {

using submissions::Judged;
using submissions::JudgedPicture;
using submissions::printable;

void print(const JudgedPicture& picture, int hint) {
  std::string why = picture.message;
  if (picture.verdict == Judged::faults)
    for (const diagnosis::FoundFault& found : picture.diagnosis->faults)
      why += (why.empty() ? "" : "; ") + report::found_in_words(found, hint);
  std::printf("%-18s %s  %s  %s\n", to_string(picture.verdict), printable(picture.submission).c_str(),
              printable(picture.scene).c_str(), printable(why).c_str());
}

bool says_on_terminal(const JudgeOutputs& outputs) {
  return outputs.json != "-" && outputs.csv != "-" && outputs.junit != "-";
}

/// What is no place for another file beside it: a pipe, a device, standard output.
bool is_special(const std::string& path) {
  std::error_code none;
  return path == "-" || path.starts_with("/dev/") || path.starts_with("/proc/") ||
         std::filesystem::is_other(path, none);
}

constexpr const char* journal_ending = ".judged.jsonl";

/// In the report, or beside the first output that is a file.
std::string journal_path(const JudgeOutputs& outputs) {
  if (!outputs.resume.empty()) return outputs.resume;
  if (!outputs.report.empty()) return (std::filesystem::path(outputs.report) / "judged.jsonl").string();
  for (const std::string& path : {outputs.json, outputs.csv, outputs.junit})
    if (!path.empty() && !is_special(path)) return path + journal_ending;
  return {};
}

void write_scenes(const std::filesystem::path& folder, const std::vector<submissions::JudgedScene>& scenes) {
  std::filesystem::create_directories(folder);
  for (const submissions::JudgedScene& scene : scenes) write_file(folder / (scene.name + ".sdf"), scene.text);
}

void print_summary(const std::vector<JudgedPicture>& all, const report::RunFacts& facts) {
  for (const std::string& scene : facts.unvaried)
    std::printf("%s is judged as it is: no variation of it shows the same faults\n",
                printable(scene).c_str());
  if (facts.seed)
    std::printf("scenes varied by --shuffle %llu\n", static_cast<unsigned long long>(*facts.seed));
  std::set<std::string> submissions;
  for (const JudgedPicture& picture : all) submissions.insert(picture.submission);
  const auto right =
      std::count_if(all.begin(), all.end(), [](const auto& p) { return p.verdict == Judged::right; });
  const std::size_t scenes = all.size() / submissions.size();
  std::printf("%zu submission%s, %zu scene%s: %td of %zu picture%s right\n", submissions.size(),
              submissions.size() == 1 ? "" : "s", scenes, scenes == 1 ? "" : "s", right, all.size(),
              all.size() == 1 ? " is" : "s are");
  if (const std::size_t done = report::judged_count(all); done != all.size())
    std::printf("interrupted: %zu of %zu pictures were not judged; the same command goes on\n",
                all.size() - done, all.size());
}

bool is_written(const std::string& file, const std::function<void()>& write) {
  if (file.empty()) return true;
  try {
    write();
    return true;
  } catch (const std::exception& error) {
    warn(error.what());
    return false;
  }
}

}  // namespace

Table judge_output_options(JudgeOutputs& outputs) {
  return {hint_option(outputs.hint),
          output_option("--json", outputs.json, "write the results as JSON"),
          output_option("--csv", outputs.csv, "write a line per picture"),
          output_option("--junit", outputs.junit, "write the results as JUnit XML"),
          report_option(outputs.report),
          {"--resume",
           &outputs.resume,
           "keep results here as they come; an interrupted run goes on from it, and judges anew what has "
           "changed; default: DIR/judged.jsonl of the report, else beside the first FILE",
           {.value = "FILE"}}};
}

void check(const JudgeOutputs& outputs) {
  const std::array files{outputs.json, outputs.csv, outputs.junit};
  if (!outputs.report.empty())  // before hours of judging
    report::refuse_to_replace_others((std::filesystem::path(outputs.report) / "index.html").string());
  if (std::count(files.begin(), files.end(), "-") > 1)
    throw std::invalid_argument("--json, --csv, --junit: found - more than once, expected a FILE");
}

std::vector<std::string> places_of_results(const JudgeOutputs& outputs) {
  std::vector<std::string> all;
  for (const std::string& path : {outputs.report, outputs.resume})
    if (!path.empty()) all.push_back(path);
  for (const std::string& path : {outputs.json, outputs.csv, outputs.junit}) {
    if (path.empty() || is_special(path)) continue;
    all.push_back(path);
    all.push_back(path + journal_ending);
  }
  return all;
}

std::unique_ptr<submissions::Journal> open_journal(const JudgeOutputs& outputs) {
  const std::string path = journal_path(outputs);
  if (path.empty()) return nullptr;
  if (!outputs.report.empty()) std::filesystem::create_directories(outputs.report);
  auto journal = std::make_unique<submissions::Journal>(path);
  if (journal->found() > 0)
    warn("going on with " + path + ": an earlier run left " + std::to_string(journal->found()) +
         " results there; those whose inputs have not changed are taken");
  return journal;
}

bool write_all(const JudgeOutputs& outputs, const std::vector<JudgedPicture>& all,
               const report::RunFacts& facts, const std::vector<submissions::JudgedScene>& scenes) {
  const int hint = outputs.hint;
  bool is_well = is_written(outputs.report, [&] {
    report::write_overview(outputs.report, all, hint, facts);
    if (facts.seed) write_scenes(std::filesystem::path(outputs.report) / "scenes", scenes);
    if (says_on_terminal(outputs)) say_report(outputs.report);
  });
  is_well &= is_written(outputs.csv, [&] { write_file(outputs.csv, report::overview_csv(all, hint)); });
  is_well &= is_written(outputs.junit, [&] { write_file(outputs.junit, report::overview_junit(all, hint)); });
  is_well &= is_written(outputs.json,
                        [&] { report::write_json(outputs.json, report::overview_json(all, hint, facts)); });
  return is_well;
}

void print(const JudgeOutputs& outputs, const std::vector<JudgedPicture>& all,
           const report::RunFacts& facts) {
  if (!says_on_terminal(outputs)) return;
  for (const JudgedPicture& picture : all) {
    if (picture.verdict != Judged::not_judged) print(picture, outputs.hint);
  }
  print_summary(all, facts);
}

}  // namespace plumb::cli
