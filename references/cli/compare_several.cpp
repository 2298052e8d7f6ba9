#include "references/cli/compare_several.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <new>
#include <stdexcept>

#include "references/cli/options.hpp"
#include "references/comparison/difference_image.hpp"
#include "references/gates/bounds_file.hpp"
#include "references/gates/image_pairs.hpp"
#include "references/report/compare_report.hpp"
#include "references/report/findings_json.hpp"
#include "references/report/findings_table.hpp"
#include "references/report/junit.hpp"
#include "references/report/metrics_table.hpp"
#include "references/report/results_table.hpp"
#include "references/report/sentences.hpp"
#include "tracer/system/files.hpp"

namespace plumb::cli {
namespace {

namespace fs = std::filesystem;
using gates::Findings;
using gates::ImagePair;
using report::CompareReport;
using Json = nlohmann::ordered_json;
using report::JunitCase;

/// What is kept of a pair once it is told.
struct PairResult {
  Json json;
  JunitCase junit;
};

int exit_code(JunitCase::Outcome outcome) {
  if (outcome == JunitCase::Outcome::error) return exit_trouble;
  return outcome == JunitCase::Outcome::failed ? exit_differs : exit_agrees;
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// With what follows on lines of its own below the row.
std::string indented(const std::string& text) {
  std::string result;
  for (const char c : text) {
    result += c;
    if (c == '\n') result += "      ";
  }
  return result;
}

class Several {
 public:
  explicit Several(const CompareOptions& options)
      : options_(options),
        bounds_(options.bounds),
        file_(gates::directory_of(options.reference)),
        found_(gates::pair_images(options.reference, options.test, masks())) {
    std::vector<std::string> names;
    for (const ImagePair& pair : found_.pairs) names.push_back(pair.name);
    width_ = report::name_width(names);
    if (const std::string complaint = file_.complaint_about_others(names); !complaint.empty())
      throw std::runtime_error(complaint);
    refuse_differences_among_inputs();
    if (!options.report.empty())
      report_.emplace(options.report, "plumb compare: " + options.test, "against " + options.reference);
  }

  int run() {
    tell("%-*s %10s %10s %8s  %s\n", static_cast<int>(width_), "image", "size", "error", "over", "result");
    for (const ImagePair& pair : found_.pairs) add(pair);
    if (report_) report_->finish();
    if (!options_.json.empty()) report::write_json(options_.json, json());
    if (!options_.junit.empty()) write_file(options_.junit, junit());
    tell_outcome();
    int worst = exit_agrees;
    for (const PairResult& result : results_) worst = std::max(worst, exit_code(result.junit.outcome));
    return worst;
  }

 private:
  std::vector<std::string> masks() const {
    std::vector<std::string> masks = bounds_.mask_paths();
    const std::vector<std::string> others = file_.mask_paths();
    masks.insert(masks.end(), others.begin(), others.end());
    return masks;
  }

  template <typename... Values>
  void tell(const char* format, Values... values) const {
    if (!options_.says_text()) return;
    std::printf(format, values...);
    flush_output();
  }

  std::string difference_path(const ImagePair& pair) const {
    return (fs::path(options_.difference) / (pair.name + ".exr")).string();
  }

  /// What is written would otherwise be compared by the next run.
  void refuse_differences_among_inputs() const {
    if (options_.difference.empty()) return;
    const fs::path differences = fs::weakly_canonical(options_.difference);
    for (const std::string& directory : {found_.reference_directory, found_.test_directory}) {
      const fs::path inputs = fs::weakly_canonical(directory.empty() ? "." : directory);
      const fs::path below = differences.lexically_relative(inputs);
      if (!below.empty() && *below.begin() != "..")
        throw std::invalid_argument("--diff: found " + options_.difference +
                                    ", which is among the inputs in " + inputs.string() +
                                    ", expected another directory");
    }
  }

  void add(const ImagePair& pair) {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    try {
      if (!pair.trouble.empty()) throw std::runtime_error(pair.trouble);
      add_findings(pair, gates::compare_files(pair.reference, pair.test, file_.bounds_of(pair.name, bounds_),
                                              options_.pair));
    } catch (const std::bad_alloc&) {
      add_trouble(pair, pair.test + ": out of memory");
    } catch (const std::exception& error) {
      add_trouble(pair, error.what());
    }
    results_.back().junit.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  }

  void add_findings(const ImagePair& pair, Findings&& f) {
    if (!options_.difference.empty()) write_difference_of(pair, f);
    const bool agrees = f.agrees();
    const std::string details = report::details_of(f), row = row_of(pair.name, f);
    PairResult result{{{"name", pair.name}}, {pair.name, JunitCase::Outcome::passed, "", details, 0, {}}};
    result.json.update(report::json_of(f));
    for (const char* const key : {"tool", "version"}) result.json.erase(key);
    if (agrees) {
      result.junit.output = report::output_of(f);
    } else {
      result.junit.outcome = JunitCase::Outcome::failed;
      result.junit.message = first_line(details);
    }
    if (report_) say_left_out(report_->add(pair.name, std::move(f), result.json));
    results_.push_back(std::move(result));
    tell("%s\n", row.c_str());
  }

  std::string row_of(const std::string& name, const Findings& f) const {
    const comparison::Comparison& c = f.result.comparison;
    const std::string size = std::to_string(f.test.width) + "x" + std::to_string(f.test.height);
    char figures[64];
    std::snprintf(figures, sizeof figures, " %10s %10.2g %8zu  ", size.c_str(), c.judged_error,
                  c.pixels_over);
    const std::string allowed = report::bounds_text(f.bounds, f.result);
    std::string row = name + std::string(std::max<std::size_t>(width_, name.size()) - name.size(), ' ') +
                      figures + report::verdict_of(f);
    const auto add = [&](std::string text) {
      if (!text.empty() && text.back() == '\n') text.pop_back();
      if (!text.empty()) row += "\n      " + indented(text);
    };
    if (f.metrics) add(report::metrics_table(*f.metrics));
    if (!f.no_metrics.empty()) add("no metrics: " + f.no_metrics);
    if (!f.agrees()) {
      add(report::details_of(f));
      return row;
    }
    if (!allowed.empty()) add("bounds: " + allowed);
    add(report::contents_of(f));
    return row;
  }

  void write_difference_of(const ImagePair& pair, const Findings& f) const {
    const std::string path = difference_path(pair);
    fs::create_directories(fs::path(path).parent_path());
    write_difference(path, f, false);
  }

  void add_trouble(const ImagePair& pair, const std::string& message) {
    Json json{{"name", pair.name},
              {"reference", pair.reference},
              {"test", pair.test},
              {"status", "error"},
              {"message", message}};
    results_.push_back({json, {pair.name, JunitCase::Outcome::error, first_line(message), message, 0, {}}});
    tell("%-*s %10s %10s %8s  %s\n      %s\n", static_cast<int>(width_), pair.name.c_str(), "-", "-", "-",
         "error", indented(message).c_str());
    if (report_) report_->add_trouble(pair.name, json);
  }

  std::size_t count(JunitCase::Outcome outcome) const {
    std::size_t number = 0;
    for (const PairResult& result : results_) number += result.junit.outcome == outcome ? 1 : 0;
    return number;
  }

  Json json() const {
    Json pairs = Json::array();
    int worst = exit_agrees;
    for (const PairResult& result : results_) {
      pairs.push_back(result.json);
      worst = std::max(worst, exit_code(result.junit.outcome));
    }
    constexpr const char* words[] = {"agree", "differ", "error"};
    return {{"tool", "plumb"},
            {"version", PLUMB_VERSION},
            {"reference", options_.reference},
            {"test", options_.test},
            {"status", words[worst]},
            {"tolerance", options_.bounds.limit.tolerance},
            {"no_images", found_.others},
            {"pairs", pairs}};
  }

  std::string junit() const {
    std::vector<JunitCase> cases;
    for (const PairResult& result : results_) cases.push_back(result.junit);
    return report::junit_xml(options_.test + " against " + options_.reference, cases);
  }

  void tell_outcome() const {
    constexpr std::size_t most_named = 5;
    std::string named;
    for (std::size_t i = 0; i < std::min(most_named, found_.others.size()); ++i)
      named += (i == 0 ? "" : ", ") + found_.others[i];
    if (found_.others.size() > most_named) named += ", ...";
    if (!named.empty())
      tell("not compared, for these are hidden, no images by name, or no files: %s\n", named.c_str());
    tell("%zu pair%s: %zu agree, %zu differ, %zu in trouble\n", results_.size(),
         results_.size() == 1 ? "" : "s", count(JunitCase::Outcome::passed),
         count(JunitCase::Outcome::failed), count(JunitCase::Outcome::error));
    if (!options_.difference.empty())
      tell("differences: %s, |test - reference| of each pair, linear\n", options_.difference.c_str());
    if (options_.says_text()) say_report(options_.report);
  }

  const CompareOptions& options_;
  const gates::Bounds& bounds_;
  gates::BoundsFile file_;
  gates::ImagePairs found_;
  std::size_t width_ = 0;
  std::optional<CompareReport> report_;
  std::vector<PairResult> results_;
};

}  // namespace

int compare_several(const CompareOptions& options) { return Several(options).run(); }

void say_left_out(const std::string& left_out) {
  if (!left_out.empty()) warn("report: " + left_out);
}

void write_difference(const std::string& path, const Findings& f, bool says_text) {
  const comparison::DifferenceImage written =
      comparison::write_difference(path, f.reference, f.test, f.result.mask);
  if (written.leaves_out_channels)
    warn(path +
         ": holds the differences of the first channels, not those of the others, which were compared");
  if (!says_text) return;
  if (written.is_float) {
    std::printf("difference: %s holds |test - reference|, linear\n", path.c_str());
  } else {
    std::printf("difference: %s holds |test - reference| times %.6g, so that the largest is white%s\n",
                path.c_str(), written.scale, written.has_non_finite ? "; what is not finite is magenta" : "");
  }
}

}  // namespace plumb::cli
