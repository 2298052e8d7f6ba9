#include "references/gates/verify.hpp"

#include <cstdio>
#include <memory>

#include "references/cli/commands.hpp"
#include "references/cli/options.hpp"
#include "references/cli/progress.hpp"
#include "references/cli/report.hpp"
#include "references/cli/scene_report.hpp"

namespace plumb::cli {
namespace {

struct Options {
  std::vector<std::string> scenes;
  std::string json;
  std::string report;
  double tolerance = 1e-6;
  bool stored = false;
  bool terms = false;
  bool judge = false;
  int jobs = 0;
  SceneOptions common;
};

references::VerifyOptions verify_options(const Options& options) {
  references::VerifyOptions verify;
  static_cast<references::PictureOptions&>(verify) =
      picture_options(options.common, options.tolerance, !options.report.empty());
  verify.stored = options.stored;
  verify.terms = options.terms;
  verify.judge = options.judge;
  verify.jobs = options.jobs;
  verify.on_notice = warn;
  return verify;
}

int run_verify(const Options& options) {
  const bool table = options.json != "-";
  const std::size_t width = name_width(options.scenes);
  std::size_t done = 0;
  Progress progress("verifying");
  if (table) std::printf("%s\n", table_head(width).c_str());
  SceneReport page(options.report, "plumb verify", options.tolerance);
  // The real type is not explain's: it always traces in double.
  SceneOptions explained = options.common;
  explained.real = SceneOptions{}.real;
  explained.engine = SceneOptions{}.engine;
  const auto report = references::verify(options.scenes, verify_options(options), [&](auto& result) {
    page.add(result, picture_arguments(explained));
    result.pictures.reset();
    progress.clear();
    if (table) {
      std::printf("%s\n", table_row(result, width).c_str());
      flush_output();
    }
    progress.show(static_cast<double>(++done) / static_cast<double>(options.scenes.size()));
  });
  progress.clear();
  if (!report.complaint.empty()) warn(report.complaint);
  if (!options.json.empty()) write_json(options.json, to_json(report));
  page.finish();
  if (table) {
    std::printf("%s\n", outcome(report).c_str());
    say_report(options.report);
  }
  return report.exit_code();
}

}  // namespace

Command add_verify(CLI::App& plumb) {
  CLI::App* app = plumb.add_subcommand(
      "verify", "Render scenes, have POV-Ray render the equivalent export, and compare every pixel.");
  auto options = std::make_shared<Options>();
  app->add_option("SCENE", options->scenes, "scene files")->required()->expected(-1);
  add_tolerance(*app, options->tolerance);
  app->add_flag("--stored", options->stored, "compare with the stored reference images; start no POV-Ray");
  app->add_flag(
      "--terms", options->terms,
      "also compare ambient, diffuse, specular, shadow, mirror and refraction, each alone, and say in "
      "which one a difference lives");
  app->add_flag(
      "--judge", options->judge,
      "also settle in 113 bits, for each pixel over the tolerance, whether ours is wrong, the "
      "reference, or both, or the scene's own last digits leave it open; where ours is wrong, the scene "
      "differs, whatever explains the pixel otherwise");
  app->add_option("--jobs", options->jobs, "scenes at once; default: as many as keep the machine busy")
      ->type_name("N")
      ->check(CLI::Range(1, 256));
  app->add_option("--json", options->json, "write the results as JSON; - is standard output")
      ->type_name("FILE");
  add_report(*app, options->report);
  add_real(*app, options->common);
  add_scene_options(*app, options->common);
  app->footer(
      "Example: plumb verify tests/scenes/*.sdf --json result.json\n"
      "POV-Ray's pictures are kept in $PLUMB_CACHE (default ~/.cache/plumb).\n"
      "Exit codes: 0 all agree, 1 some differ, 2 trouble.");
  return {app, [options] { return run_verify(*options); }};
}

}  // namespace plumb::cli
