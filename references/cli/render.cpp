#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "references/cli/commands.hpp"
#include "references/cli/layers_option.hpp"
#include "references/cli/options.hpp"
#include "references/cli/progress.hpp"
#include "references/faults/fault.hpp"
#include "references/renderers/render_to_file.hpp"
#include "references/renderers/unasked_file.hpp"
#include "references/report/render_statistics_json.hpp"
#include "tracer/format/reader.hpp"
#include "tracer/image/format.hpp"
#include "tracer/image/io.hpp"
#include "tracer/system/files.hpp"
#include "tracer/text/words.hpp"

namespace plumb::cli {
namespace {

using report::ChosenForError;
using report::RenderStatistics;

struct Options {
  std::string scene;
  std::string image;
  std::optional<Encoding> encode;
  std::optional<SamplePattern> pattern;
  bool prints_statistics = false;
  std::string statistics_json;
  std::vector<const faults::Fault*> faults;
  std::vector<textbook::Layer> layers;
  double error = 0;  ///< 0: none was asked for
  gates::PictureOptions picture;
  RenderJob job;
};

constexpr Word<Encoding> encodings[] = {
    {"linear", Encoding::linear}, {"srgb", Encoding::srgb}, {"course", Encoding::course}};
constexpr Word<SamplePattern> patterns[] = {{"grid", SamplePattern::grid},
                                            {"low-discrepancy", SamplePattern::low_discrepancy}};

/// Two pictures of so many pixels are held whole to be judged: 192 MiB each.
constexpr std::int64_t most_judged_pixels = std::int64_t{1} << 24;

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
SamplePattern pattern_for(int samples) {
  const double edge = std::sqrt(samples);
  return edge != std::floor(edge) ? SamplePattern::low_discrepancy : SamplePattern::grid;
}

void report(const Options& options, const RenderJob& job, RenderStatistics& statistics) {
  statistics.scene = options.scene;
  statistics.has_counts =
      renderers::tracer_for(options.picture.tracer, job.real) == renderers::OwnTracer::engine;
  statistics.engine = statistics.has_counts ? "engine" : "textbook";
  statistics.real = studies::to_string(job.real);
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
renderers::RenderedFile render_within_error(const Options& options, const Scene& scene, const Camera& camera,
                                            RenderJob& job, const std::string& path, Encoding encoding,
                                            RenderStatistics& statistics) {
  refuse_too_many(job);
  studies::Choice choice;
  try {
    choice = studies::choose(scene, camera, job, options.error);
  } catch (const studies::BoundNotReached& error) {
    throw std::runtime_error(options.scene + ": " + error.what());
  }
  const std::string why = studies::reason(choice, options.error, job.options.depth);
  warn(why.substr(0, why.size() - 1));
  statistics.counts = choice.chosen.statistics;
  statistics.chosen = ChosenForError{options.error,
                                     job.options.depth,
                                     choice.oracle_pixels,
                                     choice.pixels,
                                     choice.chosen,
                                     choice.tried,
                                     why};
  job.real = choice.chosen.real;
  const engine::Stopwatch writing;
  write_image(path, choice.image, encoding);
  return {is_of_one_colour(choice.image), writing.elapsed()};
}

/// Says what was written under a name that the scene chose.
void put_in_place(const std::optional<renderers::UnaskedFile>& file, const std::string& name) {
  if (!file) return;
  file->put_in_place();
  std::printf("%s\n", name.c_str());
}

int render(Options& options) {
  RenderStatistics statistics;
  const engine::Stopwatch reading;
  const Scene scene = load_scene(options.scene, options.picture.dialect, warn);
  statistics.read = reading.elapsed();
  const Shot shot = shot_of(scene, options.picture);
  const std::string asked = options.image.empty() ? name_from(scene) : options.image;
  const Encoding encoding = options.encode.value_or(default_encoding(asked));
  if (const auto complaint = complaint_about(asked, encoding)) {
    throw std::invalid_argument(in_quotes(asked) + ": " + *complaint);
  }
  if (!options.layers.empty()) {
    Progress progress("rendering " + options.scene);
    options.job.progress = [&](double fraction) { progress.show(fraction); };
    write_layers(options.image, shot, job_of(shot, options.job), options.layers);
    return exit_agrees;
  }
  std::optional<renderers::UnaskedFile> unasked;
  if (options.image.empty()) unasked.emplace(asked);
  const std::string path = unasked ? unasked->aside() : asked;
  if (path == "-" && options.statistics_json == "-")
    throw std::invalid_argument(
        "found the picture and the statistics on standard output, expected one of them; name a file");
  RenderJob& job = options.job = job_of(shot, options.job);
  job.real = options.picture.real;
  job.pattern = options.pattern.value_or(pattern_for(job.samples));
  Progress progress("rendering " + options.scene);
  job.progress = [&](double fraction) { progress.show(fraction); };
  if (!options.faults.empty()) {
    write_image(path, faults::render_with(scene, shot.camera, job, options.faults), encoding);
    progress.clear();
    put_in_place(unasked, asked);
    return exit_agrees;
  }
  const renderers::RenderedFile file =
      options.error > 0 ? render_within_error(options, scene, shot.camera, job, path, encoding, statistics)
                        : renderers::render_to_file(options.picture.tracer, scene, shot.camera, job, path,
                                                    encoding, &statistics.counts);
  progress.clear();
  put_in_place(unasked, asked);
  statistics.write = file.write;
  if (file.is_of_one_colour)
    warn(options.scene + ": warning: nothing is seen: every pixel has the same colour");
  report(options, job, statistics);
  return exit_agrees;
}

Table picture_file_options(Options& options) {
  return {{"SCENE", &options.scene, "scene file", {.is_required = true}},
          {"-o,--output",
           &options.image,
           "image: .exr and .pfm (linear floats), .png, .ppm; - is standard output. Default: the file named "
           "by the scene's render line, in the current directory, unless one is there that plumb didn't "
           "write",
           {.value = "IMAGE"}},
          {"--encode", one_of(options.encode, encodings),
           "linear; srgb (8 bits); course (tone map c/(c+1), then the framework's truncating 8-bit PPM). "
           "Default: linear for floats, srgb for png, course for ppm"}};
}

Table job_options(Options& options) {
  return {{"--threads", &options.job.threads, "threads; default: all", {.range = within(1, 1024)}},
          {"--samples",
           &options.job.samples,
           "samples of a pixel, averaged; one is the pixel's centre, and all that the textbook tracer takes",
           {.value = "N", .shows_default = true, .range = within(1, 65536)}},
          {"--pattern", one_of(options.pattern, patterns),
           "where they lie: grid, a square number; low-discrepancy, any number. Default: what fits"},
          {"--stats", &options.prints_statistics,
           "print what was done on standard error: the kernel and why, rays by kind, times, bytes an object"},
          output_option("--stats-json", options.statistics_json, "write that as JSON"),
          {"--fault",
           [&options](const std::string& ids) {
             if (!ids.empty()) options.faults = faults_named(ids);
           },
           "render with mistakes of real tracers, by the textbook tracer in double: ids of plumb faults, "
           "joined by commas",
           {.value = "ID", .excludes = {"--stats", "--stats-json", "--samples"}}},
          layers_option(options.layers)};
}

}  // namespace

Command render_command() {
  auto options = std::make_shared<Options>();
  return {.name = "render",
          .purpose = "Render a scene to an image.",
          .footer =
              "Example: plumb render tests/scenes/phong.sdf -o phong.png --size 640x480\n"
              "Example: plumb render tests/scenes/phong.sdf -o phong.exr --layers normal,depth,shadow\n"
              "--error measures against 113 bits on some pixels and against double on all; see plumb needs.\n"
              "Exit codes: 0 rendered, 2 trouble.",
          .options = joined(
              {picture_file_options(*options),
               job_options(*options),
               tracer_options(options->picture),
               {error_option(
                   options->error,
                   "choose the cheapest real type and depth whose measured error is at most E, relative "
                   "above 1, and say why on standard error; exit code 2 when there is none. --depth "
                   "remains what is aimed at",
                   {.excludes = {"--real", "--engine", "--fault"}})},
               scene_options(options->picture)}),
          .run = [options](auto&) { return render(*options); }};
}

}  // namespace plumb::cli
