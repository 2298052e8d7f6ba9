#include <cstdio>
#include <filesystem>
#include <memory>

#include "references/cli/commands.hpp"
#include "references/cli/options.hpp"
#include "references/cli/progress.hpp"
#include "references/renderers/cache.hpp"
#include "references/report/atlas.hpp"
#include "references/system/json.hpp"
#include "tracer/system/files.hpp"

namespace plumb::cli {
namespace {

struct Options {
  bool quick = false;
  std::string condition, json, report;
};

int run_stability(const Options& options) {
  Progress progress("stability");
  studies::stability::Sweep sweep{options.quick, options.condition,
                                  [&](double fraction) { progress.show(fraction); },
                                  renderers::Cache().directory()};
  const auto found = studies::stability::stability(sweep);
  progress.clear();
  if (options.json != "-") std::fputs(report::table_of(found).c_str(), stdout);
  if (!options.json.empty()) write_file(options.json, system::json_text(report::to_json(found), 1) + "\n");
  if (options.report.empty()) return exit_agrees;
  std::filesystem::create_directories(options.report);
  write_file(options.report + "/stability.html", report::page_of(found));
  if (options.json != "-") std::printf("%s/stability.html\n", options.report.c_str());
  return exit_agrees;
}

}  // namespace

Command stability_command() {
  auto options = std::make_shared<Options>();
  return {
      .name = "stability",
      .purpose = "Find where each method, POV-Ray and Embree fail, as distance, scale, angle and so on grow.",
      .footer =
          "Example: plumb stability --quick --condition distance --report atlas\n"
          "Finished rows are kept in the cache, so an interrupted run resumes. Exit codes: 0 done, 2 "
          "trouble.",
      .options =
          {{"--quick", &options->quick, "fewer values and rays"},
           {"--condition", &options->condition, "sweep this one alone", {.value = "NAME"}},
           output_option("--json", options->json, "write all sweeps as JSON"),
           {"--report", &options->report, "write a page with a map of each condition", {.value = "DIR"}}},
      .run = [options](auto&) { return run_stability(*options); }};
}

}  // namespace plumb::cli
