#include <cstdio>
#include <memory>

#include "references/cli/commands.hpp"
#include "references/cli/options.hpp"
#include "references/cli/progress.hpp"
#include "references/report/needs_json.hpp"
#include "references/report/results_json.hpp"
#include "tracer/format/reader.hpp"

namespace plumb::cli {
namespace {

/// So many pixels are rendered some twenty times.
constexpr std::int64_t most_pixels = std::int64_t{1} << 22;

struct Options {
  std::string scene;
  std::string json;
  double error = 1e-6;
  gates::PictureOptions picture;
};

void check_size(const Shot& shot) {
  const std::int64_t pixels = std::int64_t{shot.width} * shot.height;
  if (pixels > most_pixels)
    throw std::invalid_argument("found " + std::to_string(pixels) + " pixels, expected at most " +
                                std::to_string(most_pixels) +
                                ", because the picture is rendered many times; choose a smaller --size");
}

int run_needs(const Options& options) {
  const Scene scene = load_scene(options.scene, options.picture.dialect, warn);
  const Shot shot = shot_of(scene, options.picture);
  check_size(shot);
  RenderJob job = job_of(shot);
  Progress progress("looking at " + options.scene);
  job.progress = [&](double fraction) { progress.show(fraction); };
  const report::NeedsReport report{options.scene, scene,
                                   shot.width,    shot.height,
                                   options.error, studies::needs_of(scene, shot.camera, job, options.error)};
  progress.clear();
  if (options.json != "-") std::printf("%s", as_text(report).c_str());
  if (!options.json.empty()) report::write_json(options.json, to_json(report));
  return exit_agrees;
}

}  // namespace

Command needs_command() {
  auto options = std::make_shared<Options>();
  return {.name = "needs",
          .purpose =
              "List what a scene's picture needs: features, real type, depth, objects; and what each costs.",
          .footer =
              "Example: plumb needs tests/scenes/combined-still-life.sdf\n"
              "Errors are measured, against 113 bits on some pixels: it is said on how many. plumb render "
              "--error "
              "E\npicks the cheapest of what suffices. Exit codes: 0 listed, 2 trouble.",
          .options = joined(
              {{{"SCENE", &options->scene, "scene file", {.is_required = true}},
                error_option(options->error,
                             "largest error of a linear component, relative above 1, that is to be kept",
                             {.shows_default = true}),
                output_option("--json", options->json, "write the same as JSON")},
               scene_options(options->picture)}),
          .run = [options](auto&) { return run_needs(*options); }};
}

}  // namespace plumb::cli
