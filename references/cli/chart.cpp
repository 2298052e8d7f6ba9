#include "references/studies/chart/chart.hpp"

#include <cstdio>
#include <filesystem>
#include <memory>

#include "references/cli/commands.hpp"
#include "references/cli/options.hpp"
#include "references/cli/progress.hpp"
#include "references/report/chart_json.hpp"
#include "references/report/results_json.hpp"
#include "references/studies/chart/plot.hpp"
#include "references/system/json.hpp"

namespace plumb::cli {
namespace {

struct Options {
  std::vector<std::string> scenes;
  std::string json, svg, png;
  gates::PictureOptions picture;
  studies::ChartOptions chart;
};

/// The pictures that are asked for; all files when none is.
std::vector<std::string> pictures(Options& options) {
  if (options.json.empty() && options.svg.empty() && options.png.empty()) {
    options.json = "chart.json";
    options.svg = "chart.svg";
    options.png = "chart.png";
  }
  std::vector<std::string> files;
  for (const auto& [path, extension] : {std::pair(options.svg, ".svg"), std::pair(options.png, ".png")}) {
    if (path.empty()) continue;
    if (std::filesystem::path(path).extension() != extension)
      throw std::invalid_argument("found '" + path + "', expected a name that ends in " + extension);
    files.push_back(path);
  }
  return files;
}

/// What no option says by itself.
void complete(Options& options) {
  studies::ChartOptions& chart = options.chart;
  chart.size = options.picture.size.value_or(chart.size);
  chart.camera = options.picture.camera;
  chart.dialect = options.picture.dialect;
  chart.render = options.picture.render;
  chart.warn = warn;
}

/// What lies on the fronts, the fastest first as they were measured.
void print_fronts(const studies::ChartScene& scene) {
  std::printf("%s\n", scene.scene.c_str());
  for (const auto& point : scene.points) {
    if (!point.pareto) continue;
    std::printf("  %-32s %8.3g x  rms %8.2g  %zu pixels over  (%s)\n", point.way.title.c_str(),
                point.ratio.median, point.error.rms, point.error.pixels_over,
                point.way.truth == studies::Truth::pixel_centres ? "exactness" : "sampling");
  }
}

int run_chart(Options& options) {
  const std::vector<std::string> files = pictures(options);
  if (!files.empty()) studies::check_plotting();
  complete(options);
  Progress progress("measuring");
  options.chart.progress = [&](double fraction) { progress.show(fraction); };
  const studies::Chart chart = studies::measure_chart(options.scenes, options.chart);
  progress.clear();
  if (!chart.instructions.empty())
    warn("INSTRUCTIONS ARE NOT COUNTED: " + chart.instructions + "; they are null in the JSON");
  const nlohmann::ordered_json json = report::to_json(chart);
  if (!files.empty()) studies::plot_chart(system::json_text(json), files);
  if (!options.json.empty()) report::write_json(options.json, json);
  if (options.json == "-") return exit_agrees;
  for (const auto& scene : chart.scenes) {
    print_fronts(scene);
    for (const std::string& note : scene.left_out) std::printf("  left out: %s\n", note.c_str());
  }
  return exit_agrees;
}

Table picture_options(gates::PictureOptions& picture) {
  Table table = scene_options(picture);
  table.front().purpose = "size of all pictures";
  table.front().rules.default_text = "160x120";
  return table;
}

}  // namespace

Command chart_command() {
  auto options = std::make_shared<Options>();
  return {
      .name = "chart",
      .purpose =
          "Chart speed against accuracy: every way to render scenes, what it costs and how far it is off.",
      .footer =
          "Example: plumb chart tests/scenes/combined-still-life.sdf tests/scenes/mirror.sdf --svg "
          "chart.svg\n"
          "Without --json, --svg and --png: chart.json, chart.svg and chart.png in the current directory.\n"
          "Errors are counted from the textbook tracer in 113 bits; those of several samples a pixel from "
          "1024 of "
          "them.\n"
          "Every run is kept in $PLUMB_CACHE (default ~/.cache/plumb), so a chart that was broken off goes "
          "on.\n"
          "Needs python3-matplotlib to draw.\n"
          "Exit codes: 0 measured, 2 trouble.",
      .options = joined(
          {{{"SCENE", &options->scenes, "scene files; up to 10 make a readable page", {.is_required = true}},
            output_option("--json", options->json, "write the figures as JSON"),
            {"--svg", &options->svg, "draw the chart; text stays text", {.value = "FILE"}},
            {"--png", &options->png, "draw the chart at 150 dots an inch", {.value = "FILE"}},
            {"--runs",
             &options->chart.runs,
             "measurements of each cost; the chart shows median and range",
             {.value = "N", .shows_default = true, .range = within(1, 1000)}},
            {"--fresh", &options->chart.fresh, "measure all anew; use nothing that is kept in the cache"}},
           picture_options(options->picture)}),
      .run = [options](auto&) { return run_chart(*options); }};
}

}  // namespace plumb::cli
