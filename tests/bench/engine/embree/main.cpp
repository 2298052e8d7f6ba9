// Embree at its best on a scene of ours: every mode, render time alone; see --help.
#include <ctime>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "tests/bench/engine/embree/render.hpp"
#include "tracer/format/reader.hpp"
#include "tracer/image/io.hpp"

namespace plumb::bench {
namespace {

struct Options {
  std::string scene;
  std::string mode = "all";
  std::string output;
  EmbreeJob job;
};

double seconds(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// CPU and wall time of a call, in seconds.
template <class Call>
nlohmann::json timed(const Call& call) {
  const double cpu = seconds(CLOCK_PROCESS_CPUTIME_ID), wall = seconds(CLOCK_MONOTONIC);
  call();
  return {{"cpu", seconds(CLOCK_PROCESS_CPUTIME_ID) - cpu}, {"wall", seconds(CLOCK_MONOTONIC) - wall}};
}

nlohmann::json measure(Options options) {
  const Scene scene = load_scene(options.scene, {});
  if (options.job.width == 0) {
    options.job.width = scene.renders.front().width;
    options.job.height = scene.renders.front().height;
  }
  std::unique_ptr<EmbreeScene> embree;
  nlohmann::json result;
  result["build"] = timed([&] { embree = std::make_unique<EmbreeScene>(scene, options.job.threads); });
  result["bytes"] = embree->bytes();
  for (const NamedMode& mode : modes) {
    if (options.mode != "all" && options.mode != mode.name) continue;
    options.job.mode = mode.mode;
    Image image;
    result["modes"][mode.name] = timed([&] { image = render(*embree, scene, options.job); });
    if (!options.output.empty()) write_image(options.output + mode.name + ".pfm", image, Encoding::linear);
  }
  return result;
}

void add_options(CLI::App& app, Options& options) {
  app.add_option("SCENE", options.scene, "scene file")->required();
  app.add_option("--mode", options.mode, "all, single, packet8, packet16, stream1M or streamNM")
      ->check(CLI::IsMember({"all", "single", "packet8", "packet16", "stream1M", "streamNM"}))
      ->capture_default_str();
  app.add_option("-o,--output", options.output, "write PREFIXmode.pfm")->type_name("PREFIX");
  app.add_option("--width", options.job.width, "pixels; default: the scene's")->default_val(0);
  app.add_option("--height", options.job.height, "pixels; default: the scene's")->default_val(0);
  app.add_option("--depth", options.job.depth, "as in plumb render")->capture_default_str();
  app.add_option("--threads", options.job.threads, "threads")->capture_default_str();
  app.add_option("--tile", options.job.tile, "edge of a tile, a multiple of 4")->capture_default_str();
  app.footer(
      "Prints JSON: seconds of building and of rendering in each mode.\n"
      "Example: plumb_bench_embree lecture.sdf --depth 6 -o lecture-");
}

}  // namespace
}  // namespace plumb::bench

int main(int argc, char** argv) {
  CLI::App app("Renders a scene with Embree 3 in float, single rays, packets and streams.");
  plumb::bench::Options options;
  plumb::bench::add_options(app, options);
  CLI11_PARSE(app, argc, argv);
  try {
    std::printf("%s\n", plumb::bench::measure(options).dump(2).c_str());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "plumb_bench_embree: %s\n", error.what());
    return 2;
  }
  return 0;
}
