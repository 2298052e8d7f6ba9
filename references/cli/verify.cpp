#include "references/gates/verify.hpp"

#include <cstdio>
#include <memory>

#include "references/cli/commands.hpp"
#include "references/cli/options.hpp"
#include "references/cli/progress.hpp"
#include "references/report/results_json.hpp"
#include "references/report/results_table.hpp"
#include "references/report/scene_report.hpp"
#include "references/report/sentences.hpp"

namespace plumb::cli {
namespace {

struct Options {
  std::vector<std::string> scenes;
  std::string json;
  std::string report;
  gates::VerifyOptions verify;
};

int run_verify(Options& options) {
  options.verify.keeps_pictures = !options.report.empty();
  options.verify.on_notice = warn;
  const bool table = options.json != "-";
  const std::size_t width = report::name_width(options.scenes);
  std::size_t done = 0;
  Progress progress("verifying");
  if (table) std::printf("%s\n", report::table_head(width).c_str());
  report::SceneReport page(options.report, "plumb verify", options.verify.tolerance);
  const auto report = gates::verify(options.scenes, options.verify, [&](auto& result) {
    page.add(result, explain_arguments(options.verify));
    result.pictures.reset();
    progress.clear();
    if (table) {
      std::printf("%s\n", report::table_row(result, report::message_of(result), width).c_str());
      flush_output();
    }
    progress.show(static_cast<double>(++done) / static_cast<double>(options.scenes.size()));
  });
  progress.clear();
  if (!report.complaint.empty()) warn(report.complaint);
  if (!options.json.empty()) report::write_json(options.json, report::to_json(report));
  page.finish();
  if (table) {
    std::printf("%s\n", report::outcome(report).c_str());
    say_report(options.report);
  }
  return report.exit_code();
}

}  // namespace

Command verify_command() {
  auto options = std::make_shared<Options>();
  gates::VerifyOptions& verify = options->verify;
  return {.name = "verify",
          .purpose = "Render scenes, have POV-Ray render the equivalent export, and compare every pixel.",
          .footer =
              "Example: plumb verify tests/scenes/*.sdf --json result.json\n"
              "POV-Ray's pictures are kept in $PLUMB_CACHE (default ~/.cache/plumb).\n"
              "Exit codes: 0 all agree, 1 some differ, 2 trouble.",
          .options = joined(
              {{{"SCENE", &options->scenes, "scene files", {.is_required = true}},
                tolerance_option(verify.tolerance),
                {"--stored", &verify.reference.stored,
                 "compare with the stored reference images; start no POV-Ray"},
                {"--terms", &verify.terms,
                 "also compare ambient, diffuse, specular, shadow, mirror and refraction, each alone, "
                 "and say in which one a difference lives"},
                {"--judge", &verify.judge,
                 "also settle in 113 bits, for each pixel over the tolerance, whether ours is wrong, the "
                 "reference, or both, or the scene's own last digits leave it open; where ours is wrong, "
                 "the scene differs, whatever explains the pixel otherwise"},
                {"--jobs",
                 &verify.jobs,
                 "scenes at once; default: as many as keep the machine busy",
                 {.value = "N", .range = within(1, 256)}},
                output_option("--json", options->json, "write the results as JSON"),
                report_option(options->report)},
               tracer_options(verify),
               scene_options(verify)}),
          .run = [options](auto&) { return run_verify(*options); }};
}

}  // namespace plumb::cli
