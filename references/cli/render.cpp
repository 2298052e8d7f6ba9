#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "references/cli/commands.hpp"
#include "references/cli/options.hpp"
#include "references/cli/progress.hpp"
#include "references/cli/render_statistics.hpp"
#include "references/faults/fault.hpp"
#include "references/renderers/render_to_file.hpp"
#include "references/renderers/unasked_file.hpp"
#include "tracer/format/reader.hpp"
#include "tracer/image/format.hpp"
#include "tracer/image/io.hpp"
#include "tracer/system/files.hpp"
#include "tracer/text/words.hpp"

namespace plumb::cli {
namespace {

struct Options {
  std::string scene;
  std::string image;
  std::string encode;
  int threads = 0;
  int samples = 1;
  std::string pattern;
  bool prints_statistics = false;
  std::string statistics_json;
  std::string faults;
  double error = 0;  // 0: none was asked for
  SceneOptions common;
};

/// Two pictures of so many pixels are held whole to be judged: 192 MiB each.
constexpr std::int64_t most_judged_pixels = std::int64_t{1} << 24;

Encoding encoding_of(const Options& options, const std::string& path) {
  if (options.encode.empty()) return default_encoding(path);
  if (options.encode == "srgb") return Encoding::srgb;
  return options.encode == "course" ? Encoding::course : Encoding::linear;
}

/// The file that the scene's render line names, in the current directory: a scene chooses no directory, and
/// not standard output.
std::string name_from(const Scene& scene) {
  const std::string name = std::filesystem::path(scene.renders.front().file).filename().string();
  const bool is_plain = in_quotes(name) == "'" + name + "'";  // short, and no control characters
  if (const auto complaint = complaint_about(name == "-" || !is_plain ? "" : name, Encoding::linear)) {
    throw std::invalid_argument("the scene's render line names " + in_quotes(name) + ", " + *complaint +
                                "; or name the image with -o");
  }
  return name;
}

/// A grid when the number is a square.
SamplePattern pattern_of(const Options& options) {
  const double edge = std::sqrt(options.samples);
  if (options.pattern.empty() && edge != std::floor(edge)) return SamplePattern::low_discrepancy;
  return options.pattern == "low-discrepancy" ? SamplePattern::low_discrepancy : SamplePattern::grid;
}

void report(const Options& options, const RenderJob& job, RenderStatistics& statistics) {
  statistics.scene = options.scene;
  statistics.has_counts =
      references::renderer_for(renderer_of(options.common), job.real) == references::Renderer::engine;
  statistics.engine = statistics.has_counts ? "engine" : "textbook";
  statistics.real = options.common.real;
  statistics.width = job.width;
  statistics.height = job.height;
  if (options.prints_statistics) std::fprintf(stderr, "%s", as_text(statistics).c_str());
  if (options.statistics_json == "-")
    std::printf("%s", as_json(statistics).c_str());
  else if (!options.statistics_json.empty())
    write_file(options.statistics_json, as_json(statistics));
}

void refuse_too_many(const RenderJob& job) {
  const std::int64_t pixels = std::int64_t{job.width} * job.height;
  if (pixels <= most_judged_pixels) return;
  throw std::invalid_argument(
      "--error: found " + std::to_string(pixels) + " pixels, expected at most " +
      std::to_string(most_judged_pixels) +
      ", because pictures are held whole to be judged; choose a smaller --size, or --real");
}

/// Renders by the cheapest configuration that keeps the error that was asked for, and says why.
references::RenderedFile render_within_error(Options& options, const Scene& scene, const Camera& camera,
                                             RenderJob& job, const std::string& path, Encoding encoding,
                                             RenderStatistics& statistics) {
  refuse_too_many(job);
  references::Choice choice;
  try {
    choice = references::choose(scene, camera, job, options.error);
  } catch (const references::BoundNotReached& error) {
    throw std::runtime_error(options.scene + ": " + error.what());
  }
  const std::string why = references::reason(choice, options.error, job.options.depth);
  warn(why.substr(0, why.size() - 1));
  statistics.counts = choice.chosen.statistics;
  statistics.chosen = ChosenForError{options.error,
                                     job.options.depth,
                                     choice.oracle_pixels,
                                     choice.pixels,
                                     choice.chosen,
                                     choice.tried,
                                     why};
  options.common.real = references::to_string(choice.chosen.real);
  job.real = choice.chosen.real;
  const engine::Stopwatch writing;
  write_image(path, choice.image, encoding);
  return {is_of_one_colour(choice.image), writing.elapsed()};
}

/// Says what was written under a name that the scene chose.
void put_in_place(const std::optional<references::UnaskedFile>& file, const std::string& name) {
  if (!file) return;
  file->put_in_place();
  std::printf("%s\n", name.c_str());
}

int render(Options options) {
  RenderStatistics statistics;
  const engine::Stopwatch reading;
  const Scene scene = load_scene(options.scene, dialect_of(options.common), warn);
  statistics.read = reading.elapsed();
  const View view = view_of(scene, options.common);
  const std::string asked = options.image.empty() ? name_from(scene) : options.image;
  const Encoding encoding = encoding_of(options, asked);
  if (const auto complaint = complaint_about(asked, encoding)) {
    throw std::invalid_argument(in_quotes(asked) + ": " + *complaint);
  }
  std::optional<references::UnaskedFile> unasked;
  if (options.image.empty()) unasked.emplace(asked);
  const std::string path = unasked ? unasked->aside() : asked;
  if (path == "-" && options.statistics_json == "-")
    throw std::invalid_argument(
        "found the picture and the statistics on standard output, expected one of them; name a file");
  RenderJob job;
  job.width = view.size.width;
  job.height = view.size.height;
  job.options = render_options_of(options.common);
  job.real = real_of(options.common);
  job.threads = options.threads;
  job.samples = options.samples;
  job.pattern = pattern_of(options);
  Progress progress("rendering " + options.scene);
  job.progress = [&](double fraction) { progress.show(fraction); };
  if (!options.faults.empty()) {
    write_image(path, references::render_with(scene, view.camera, job, faults_named(options.faults)),
                encoding);
    progress.clear();
    put_in_place(unasked, asked);
    return exit_agrees;
  }
  const references::RenderedFile file =
      options.error > 0 ? render_within_error(options, scene, view.camera, job, path, encoding, statistics)
                        : references::render_to_file(renderer_of(options.common), scene, view.camera, job,
                                                     path, encoding, &statistics.counts);
  progress.clear();
  put_in_place(unasked, asked);
  statistics.write = file.write;
  if (file.is_of_one_colour)
    warn(options.scene + ": warning: nothing is seen: every pixel has the same colour");
  report(options, job, statistics);
  return exit_agrees;
}

}  // namespace

Command add_render(CLI::App& plumb) {
  CLI::App* app = plumb.add_subcommand("render", "Render a scene to an image.");
  auto options = std::make_shared<Options>();
  app->add_option("SCENE", options->scene, "scene file")->required();
  app->add_option(
         "-o,--output", options->image,
         "image: .exr and .pfm (linear floats), .png, .ppm; - is standard output. Default: the file named by "
         "the scene's render line, in the current directory, unless one is there that plumb didn't write")
      ->type_name("IMAGE");
  app->add_option(
         "--encode", options->encode,
         "linear; srgb (8 bits); course (tone map c/(c+1), then the framework's truncating 8-bit PPM). "
         "Default: linear for floats, srgb for png, course for ppm")
      ->check(CLI::IsMember({"linear", "srgb", "course"}));
  app->add_option("--threads", options->threads, "threads; default: all")->check(CLI::Range(1, 1024));
  app->add_option(
         "--samples", options->samples,
         "samples of a pixel, averaged; one is the pixel's centre, and all that the textbook tracer takes")
      ->type_name("N")
      ->check(CLI::Range(1, 65536))
      ->capture_default_str();
  app->add_option("--pattern", options->pattern,
                  "where they lie: grid, a square number; low-discrepancy, any number. Default: what fits")
      ->check(CLI::IsMember({"grid", "low-discrepancy"}));
  app->add_flag(
      "--stats", options->prints_statistics,
      "print what was done on standard error: the kernel and why, rays by kind, times, bytes an object");
  app->add_option("--stats-json", options->statistics_json, "write that as JSON; - is standard output")
      ->type_name("FILE");
  app->add_option(
         "--fault", options->faults,
         "render with mistakes of real tracers, by the textbook tracer in double: ids of plumb faults, "
         "joined by commas")
      ->type_name("ID")
      ->excludes("--stats")
      ->excludes("--stats-json")
      ->excludes("--samples");
  add_real(*app, options->common);
  add_error(
      *app, options->error,
      "choose the cheapest real type and depth whose measured error is at most E, relative above 1, and "
      "say why on standard error; exit code 2 when there is none. --depth remains what is aimed at")
      ->excludes("--real")
      ->excludes("--engine")
      ->excludes("--fault");
  add_scene_options(*app, options->common);
  app->footer(
      "Example: plumb render tests/scenes/phong.sdf -o phong.png --size 640x480\n"
      "--error measures against 113 bits on some pixels and against double on all; see plumb needs.\n"
      "Exit codes: 0 rendered, 2 trouble.");
  return {app, [options] { return render(*options); }};
}

}  // namespace plumb::cli
