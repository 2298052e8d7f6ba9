#include "references/studies/chart/chart.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <stdexcept>
#include <thread>
#include <utility>

#include "references/comparison/comparison.hpp"
#include "references/renderers/cache.hpp"
#include "references/renderers/povray.hpp"
#include "references/studies/chart/pareto.hpp"
#include "references/studies/chart/truth.hpp"
#include "references/system/digest.hpp"
#include "tracer/format/reader.hpp"
#include "tracer/format/writer.hpp"

namespace plumb::studies {
namespace {

constexpr double tolerance = 1e-6;      // that of plumb verify
constexpr double least_seconds = 0.02;  // of one measurement: a thousand times the clock's resolution
constexpr double most_seconds = 1.5;    // what took longer in all is not run again, because it varies little
/// The shares of a scene's work that are done after the truths and after the errors, for the progress.
constexpr double truths_end = 0.25, errors_end = 0.4;

std::string machine() {
  std::ifstream file("/proc/cpuinfo");
  std::string model = "unknown processor";
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("model name")) continue;
    model = line.substr(line.find(": ") + 2);
    break;
  }
  return model + ", " + std::to_string(std::thread::hardware_concurrency()) + " threads";
}

/// Identifies this build of the program. What another build measured tells nothing of it.
std::string build() {
  struct stat info {};
  stat("/proc/self/exe", &info);
  return PLUMB_VERSION " " + std::to_string(info.st_size) + " " + std::to_string(info.st_mtim.tv_sec) + "." +
         std::to_string(info.st_mtim.tv_nsec);
}

/// What all scenes share.
struct Tools {
  Tools() {
    try {
      povray_version = cache.version_of(renderers::PovrayRenderer());
    } catch (const renderers::PovrayError&) {
      // The chart says so.
    }
  }
  bool has_povray() const { return !povray_version.empty(); }
  std::string directory() const { return cache.directory() + "/chart"; }

  renderers::Cache cache;
  std::string povray_version;  // empty when there is none
  InstructionCounter counter;
};

class SceneMeasurer {
 public:
  SceneMeasurer(const Tools& tools, const Shot& shot, const ChartOptions& options,
                std::function<void(double)> progress)
      : tools_(tools), shot_(shot), options_(options), progress_(std::move(progress)) {
    const RenderOptions& o = shot.options;
    about_ = "plumb chart 1\n" + build() + "\n" + machine() + "\n" + std::to_string(shot.width) + "x" +
             std::to_string(shot.height) + " camera " + shot.camera.name + " depth " +
             std::to_string(o.depth) + " glass " + std::to_string(static_cast<int>(o.glass_shadow)) + "\n" +
             write_scene(shot.scene);
  }

  ChartScene measure(const std::string& name) {
    const auto ways = configurations(shot_.scene, tools_.has_povray());
    std::vector<Entry> entries;
    for (const Configuration& way : ways) entries.push_back(entry_of(way));
    ChartScene scene{name, {}, left_out(shot_.scene, tools_.has_povray())};
    find_errors(entries, scene.left_out);
    for (int run = 0; run < options_.runs; ++run) measure_run(entries, run);
    for (const Entry& entry : entries) scene.points.push_back(point_of(entry));
    finish(scene.points);
    return scene;
  }

 private:
  struct Entry {
    Configuration way;
    std::string path;
    Measurement measured;
    bool was_complete;
  };

  std::string path_of(const std::string& what) const {
    return tools_.directory() + "/" + system::sha256(about_ + "\n" + what);
  }

  Entry entry_of(const Configuration& way) const {
    const std::string path =
        path_of("way " + way.id + (way.is_program ? " " + tools_.povray_version : "")) + ".json";
    Entry entry{way, path, options_.fresh ? Measurement{} : load_measurement(path), false};
    entry.was_complete = is_complete(entry.measured, options_.runs);
    return entry;
  }

  static bool is_complete(const Measurement& measured, int runs) {
    return measured.runs.size() >= static_cast<std::size_t>(runs) || measured.seconds() > most_seconds;
  }

  const Image& truth(Truth which) {
    const auto known = truths_.find(which);
    if (known != truths_.end()) return known->second;
    const std::string path = path_of(which == Truth::pixel_centres ? "oracle" : "areas") + ".truth";
    const double begin = which == Truth::pixel_centres ? 0 : truths_end;
    return truths_[which] = stored_truth(shot_, which, path, options_.fresh, [&](double fraction) {
             progress_(begin + fraction * (truths_end - begin));
           });
  }

  /// Removes the ways that make no picture of this scene at all, and says why. A method that fails is no
  /// reason to have no chart.
  void find_errors(std::vector<Entry>& entries, std::vector<std::string>& failed) {
    std::vector<Entry> rendered;
    std::size_t done = 0;
    for (Entry& entry : entries) {
      progress_(truths_end + (errors_end - truths_end) * static_cast<double>(done++) /
                                 static_cast<double>(entries.size()));
      if (!entry.measured.error) {
        const Image& right = truth(entry.way.truth);
        const auto image = picture_by(entry.way, failed);
        if (!image) continue;
        const comparison::Comparison c = comparison::compare(right, *image, tolerance);
        entry.measured.error = {c.max_error, c.rms_error, c.pixels_over, c.non_finite};
        store_measurement(entry.path, entry.measured);
      }
      rendered.push_back(std::move(entry));
    }
    entries = std::move(rendered);
  }

  std::optional<Image> picture_by(const Configuration& way, std::vector<std::string>& failed) const {
    try {
      return way.renderer->render(shot_).image;
    } catch (const std::runtime_error& error) {
      failed.push_back(way.title + ": " + error.what());
      return std::nullopt;
    }
  }

  void measure_run(std::vector<Entry>& entries, int run) {
    std::map<std::string, MeasuredRun> timed;
    std::optional<WorkCost> start;
    std::size_t done = 0;
    for (Entry& entry : entries) {
      const double part = static_cast<double>(done++) / static_cast<double>(entries.size());
      progress_(errors_end + (1 - errors_end) * (run + part) / options_.runs);
      std::vector<MeasuredRun>& runs = entry.measured.runs;
      if (!is_complete(entry.measured, run + 1)) {
        const auto same = timed.find(entry.way.work);
        runs.push_back(same == timed.end() ? time(entry.way, start) : same->second);
        store_measurement(entry.path, entry.measured);
      }
      const auto at = static_cast<std::size_t>(run);
      if (at < runs.size()) timed.emplace(entry.way.work, runs[at]);
    }
  }

  /// `start` is the cost of the start in this run, once it is known.
  MeasuredRun time(const Configuration& way, std::optional<WorkCost>& start) const {
    if (way.is_program && !start) start = cost_of_start(*way.renderer);
    const WorkCost unit = cost_of([&] { yardstick_.renderer->render(shot_); }, tools_.counter, least_seconds);
    const WorkCost cost = cost_of([&] { way.renderer->render(shot_); }, tools_.counter, least_seconds);
    return {way.is_program ? without_start(cost, *start) : cost, unit.cpu_seconds};
  }

  /// The same work for next to no pixels.
  WorkCost cost_of_start(const renderers::Renderer& renderer) const {
    Shot tiny = shot_;
    tiny.width = tiny.height = 2;
    return cost_of([&] { renderer.render(tiny); }, tools_.counter, 0);
  }

  /// Subtracts the start, down to a hundredth of it: less cannot be told from its own variation.
  static WorkCost without_start(const WorkCost& all, const WorkCost& start) {
    WorkCost rest{std::max(all.cpu_seconds - start.cpu_seconds, 0.01 * start.cpu_seconds), std::nullopt};
    if (all.instructions && start.instructions)
      rest.instructions = *all.instructions - std::min(*all.instructions, *start.instructions);
    return rest;
  }

  ChartPoint point_of(const Entry& entry) const {
    std::vector<double> seconds, ratios, instructions;
    const auto wanted = static_cast<std::size_t>(options_.runs);
    for (const MeasuredRun& run : entry.measured.runs) {
      if (seconds.size() == wanted) break;
      seconds.push_back(run.cost.cpu_seconds);
      ratios.push_back(run.cost.cpu_seconds / run.yardstick_seconds);
      if (run.cost.instructions) instructions.push_back(static_cast<double>(*run.cost.instructions));
    }
    ChartPoint point{entry.way, *entry.measured.error, spread_of(seconds), spread_of(ratios), std::nullopt};
    if (instructions.size() == seconds.size())
      point.instructions = static_cast<std::uint64_t>(spread_of(instructions).median);
    point.runs = static_cast<int>(seconds.size());
    point.measured_before = entry.was_complete;
    return point;
  }

  /// Turns ratios to the yardstick into ratios to the fastest, and finds the fronts.
  static void finish(std::vector<ChartPoint>& points) {
    double fastest = std::numeric_limits<double>::infinity(), fewest = fastest;
    for (ChartPoint& point : points) {
      point.fails = point.error.non_finite > 0 || !(point.error.rms <= 1);
      if (point.fails) continue;
      fastest = std::min(fastest, point.ratio.median);
      if (point.instructions) fewest = std::min(fewest, static_cast<double>(*point.instructions));
    }
    if (!std::isfinite(fastest)) fastest = points.front().ratio.median;
    for (ChartPoint& point : points) {
      Spread& ratio = point.ratio;
      ratio = {ratio.median / fastest, ratio.min / fastest, ratio.max / fastest};
      if (point.instructions && std::isfinite(fewest))
        point.instructions_ratio = static_cast<double>(*point.instructions) / fewest;
    }
    for (const Truth truth : {Truth::pixel_centres, Truth::pixel_areas}) mark_front(points, truth);
  }

  static void mark_front(std::vector<ChartPoint>& points, Truth truth) {
    std::vector<CostAndError> figures;
    std::vector<ChartPoint*> marked;
    for (ChartPoint& point : points) {
      if (point.way.truth != truth || point.fails) continue;
      figures.push_back({point.ratio.median, point.error.rms});
      marked.push_back(&point);
    }
    const std::vector<bool> front = pareto_front(figures);
    for (std::size_t i = 0; i < marked.size(); ++i) marked[i]->pareto = front[i];
  }

  const Tools& tools_;
  const Shot& shot_;
  const ChartOptions& options_;
  std::function<void(double)> progress_;
  std::string about_;
  std::map<Truth, Image> truths_;
  const Configuration yardstick_ = yardstick();
};

}  // namespace

Spread spread_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  const double median = values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
  return {median, values.front(), values.back()};
}

Chart measure_chart(const std::vector<std::string>& scenes, const ChartOptions& options) {
  const Tools tools;
  std::filesystem::create_directories(tools.directory());
  Chart chart{options, {}, machine(), tools.povray_version, tools.counter.complaint()};
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const Scene scene = load_scene(scenes[i], options.dialect, options.warn);
    const Shot shot = shot_of(scene, {options.size, options.camera, options.render}, scenes[i]);
    SceneMeasurer measurer(tools, shot, options, [&](double fraction) {
      if (options.progress)
        options.progress((static_cast<double>(i) + fraction) / static_cast<double>(scenes.size()));
    });
    chart.scenes.push_back(measurer.measure(scenes[i]));
  }
  return chart;
}

}  // namespace plumb::studies
