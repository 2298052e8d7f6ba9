#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <utility>

#include "references/cli/bounds_options.hpp"
#include "references/cli/commands.hpp"
#include "references/cli/compare_several.hpp"
#include "references/cli/options.hpp"
#include "references/gates/image_pairs.hpp"
#include "references/report/compare_report.hpp"
#include "references/report/findings_json.hpp"
#include "references/report/findings_table.hpp"
#include "references/report/junit.hpp"
#include "references/report/metrics_table.hpp"
#include "tracer/image/format.hpp"
#include "tracer/system/files.hpp"

namespace plumb::cli {
namespace {

namespace fs = std::filesystem;
using gates::Findings;
using report::CompareReport;
using Json = nlohmann::ordered_json;
using report::JunitCase;

/// The masks may be named in a file of bounds; what the command line names is refused before.
void check_difference(const CompareOptions& options) {
  if (options.difference.empty()) return;
  if (options.difference == "-") throw std::invalid_argument("--diff: found -, expected the name of a file");
  if (const auto complaint = complaint_about(options.difference, default_encoding(options.difference)))
    throw std::invalid_argument("--diff: found " + options.difference + ", " + *complaint);
  std::error_code ignored;
  for (const std::string& input : options.bounds.mask_paths()) {
    if (fs::equivalent(input, options.difference, ignored))
      throw std::invalid_argument("--diff: found " + options.difference +
                                  ", which is an input, expected the name of another file");
  }
}

JunitCase junit_case(const CompareOptions& options, const Findings& f) {
  const std::string details = report::details_of(f);
  if (f.agrees()) return {options.test, JunitCase::Outcome::passed, "", "", 0, report::output_of(f)};
  return {options.test, JunitCase::Outcome::failed, details.substr(0, details.find('\n')), details, 0, {}};
}

void write_junit(const CompareOptions& options, const JunitCase& result) {
  if (!options.junit.empty()) write_file(options.junit, report::junit_xml(options.reference, {result}));
}

int compare_one(const CompareOptions& options) {
  check_difference(options);
  Findings findings = gates::compare_files(options.reference, options.test, options.bounds, options.pair);
  const int code = findings.agrees() ? exit_agrees : exit_differs;
  if (options.says_text()) std::fputs(report::table_of(findings).c_str(), stdout);
  const Json json = report::json_of(findings);
  if (!options.json.empty()) report::write_json(options.json, json);
  write_junit(options, junit_case(options, findings));
  if (!options.difference.empty()) write_difference(options.difference, findings, options.says_text());
  if (!options.report.empty()) {
    CompareReport report(options.report, "plumb compare: " + options.test, "against " + options.reference);
    say_left_out(report.add(options.test, std::move(findings), json));
    report.finish();
    if (options.says_text()) say_report(options.report);
  }
  return code;
}

void expect_sensible(const CompareOptions& options, const Request& request) {
  if (options.json == "-" && options.junit == "-")
    throw std::invalid_argument("--json and --junit: found - for both, expected a FILE for one of them");
  if (options.pair.metrics && (request.has("--ignore") || request.has("--only")))
    throw std::invalid_argument("--metrics: they are of whole pictures, expected no --ignore and no --only");
  for (const std::string& channel : options.pair.read.channels)
    if (channel.empty()) throw std::invalid_argument("--channels: found an empty name, expected e.g. R,G,B");
}

/// A directory is compared with nothing but several images.
void expect_both_several(const std::string& several, const std::string& other) {
  if (!fs::exists(other))
    throw std::runtime_error(other + ": there is no such file, expected a directory or a pattern as " +
                             several);
}

int run_compare(const CompareOptions& options, const Request& request) {
  expect_sensible(options, request);
  using gates::names_several;
  try {
    request.read();
    if (names_several(options.reference) && !names_several(options.test))
      expect_both_several(options.reference, options.test);
    if (names_several(options.test) && !names_several(options.reference))
      expect_both_several(options.test, options.reference);
    return names_several(options.reference) && names_several(options.test) ? compare_several(options)
                                                                           : compare_one(options);
  } catch (const std::exception& error) {
    // An error that ends all stands in the file, too: there is no result of an earlier run in its place.
    const std::string message = error.what();
    write_junit(
        options,
        {"plumb compare", JunitCase::Outcome::error, message.substr(0, message.find('\n')), message, 0, {}});
    throw;
  }
}

Table output_options(CompareOptions& options) {
  return {
      output_option("--json", options.json, "write the results as JSON"),
      output_option("--junit", options.junit, "write the results as JUnit XML"),
      {"--report", &options.report, "write a report with the pictures to DIR/index.html", {.value = "DIR"}},
      {"--diff",
       &options.difference,
       "write |test - reference| as an image: .exr and .pfm hold it as it is, .png and .ppm scaled so "
       "that the largest is white; of directories a directory of .exr",
       {.value = "FILE|DIR"}}};
}

Table options_of_pairs(gates::PairOptions& pair) {
  return {{"--channels",
           &pair.read.channels,
           "compare these channels alone, by name, e.g. R,G,B",
           {.value = "NAMES", .is_repeatable = true, .separator = ','}},
          {"--part",
           &pair.read.part,
           "of files with several parts or pages, the one to compare",
           {.value = "NAME|N"}},
          {"--metrics", &pair.metrics, "also " + report::metrics_named()}};
}

}  // namespace

Command compare_command() {
  auto options = std::make_shared<CompareOptions>();
  return {
      .name = "compare",
      .purpose = "Compare two image files of the same size, or those of two directories, value by value.",
      .footer =
          "Example: plumb compare reference.exr mine.exr --tolerance 0.001\n"
          "         plumb compare references mine --junit results.xml\n"
          "         plumb compare 'references/*.exr' 'mine/*.png' --report report\n"
          "Values are compared as they stand in the files; 8 and 16 bits count from 0 to 1.\n"
          "Images of two directories are paired by their names, in subdirectories too; those with another "
          "extension "
          "also, where each side has one. A missing or surplus image is trouble. REFERENCE/bounds.json may "
          "bound "
          "single images: {\"glass\": {\"allow_over\": \"0.1%\", \"ignore\": [\"0,0,64,16\"], \"because\": "
          "\"the "
          "clock\"}}, with tolerance, relative, allow_over, ignore and only as the options.\n" +
          report::metrics_help() + "\nExit codes: 0 agree, 1 differ, 2 trouble.",
      .options = joined({{{"REFERENCE",
                           &options->reference,
                           "image that is taken to be right; a directory of such, or a quoted pattern",
                           {.is_required = true}},
                          {"TEST",
                           &options->test,
                           "image to be judged; a directory of such, or a quoted pattern",
                           {.is_required = true}},
                          tolerance_option(options->bounds.limit.tolerance)},
                         bounds_options(options->bounds),
                         options_of_pairs(options->pair),
                         output_options(*options)}),
      .run = [options](const Request& request) { return run_compare(*options, request); },
      .reads_itself = true};
}

}  // namespace plumb::cli
