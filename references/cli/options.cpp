#include "references/cli/options.hpp"

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "references/gates/approve.hpp"
#include "tracer/text/numbers.hpp"
#include "tracer/text/words.hpp"

namespace plumb::cli {
namespace {

constexpr int largest_side = 65535;
constexpr double most_pixels = 1 << 28;

std::optional<int> whole_number(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

void add_dialect(CLI::App& app, SceneOptions& options, bool describe) {
  app.add_option("--dialect", options.dialect,
                 "how the file deviates from the course grammar; parts joined by commas" +
                     (describe ? ":\n" + describe_dialects() : ", see plumb lint --help"))
      ->type_name("NAME");
}

void add_scene_options(CLI::App& app, SceneOptions& options, bool has_size) {
  if (has_size)
    app.add_option("--size", options.size, "size of the picture instead of the scene's own")
        ->type_name("WxH");
  app.add_option("--camera", options.camera, "camera instead of the scene's own")->type_name("NAME");
  app.add_option("--depth", options.depth,
                 "recursion depth D: trace(depth >= D) is black; the primary ray has depth 0")
      ->type_name("D")
      ->check(CLI::Range(1, max_depth))
      ->capture_default_str();
  app.add_option("--glass-shadow", options.glass_shadow,
                 "full: glass blocks light (the lecture); none: it casts no shadow; filtered: light times kt "
                 "a surface")
      ->check(CLI::IsMember({"full", "none", "filtered"}))
      ->capture_default_str();
  add_dialect(app, options, false);
}

void add_real(CLI::App& app, SceneOptions& options) {
  app.add_option("--real", options.real,
                 "type of real numbers, of 24, 53, 64 and 113 bits; long-double and quad are rendered by the "
                 "textbook tracer")
      ->check(CLI::IsMember({"float", "double", "long-double", "quad"}))
      ->capture_default_str();
  app.add_option("--engine", options.engine,
                 "engine: the fast tracer (float and double); textbook: the readable one")
      ->check(CLI::IsMember({"textbook", "engine"}))
      ->capture_default_str();
}

void add_tolerance(CLI::App& app, double& tolerance) {
  const CLI::Validator finite_and_positive(
      [](std::string& text) -> std::string {
        const Number number = parse_number(text);
        if (number.complaint.empty() && number.value >= 0) return {};
        return "found " + in_quotes(text) + ", expected a finite number >= 0";
      },
      "");
  app.add_option("--tolerance", tolerance,
                 "largest error of a linear component, relative above 1, that agrees")
      ->type_name("T")
      ->check(finite_and_positive)
      ->capture_default_str();
}

CLI::Option* add_error(CLI::App& app, double& error, const std::string& description) {
  const CLI::Validator finite_and_more_than_0(
      [](std::string& text) -> std::string {
        const Number number = parse_number(text);
        if (number.complaint.empty() && number.value > 0) return {};
        return "found " + in_quotes(text) + ", expected a finite number > 0, e.g. 0.001";
      },
      "");
  return app.add_option("--error", error, description)->type_name("E")->check(finite_and_more_than_0);
}

Dialect dialect_of(const SceneOptions& options) {
  return options.dialect.empty() ? Dialect{} : parse_dialect(options.dialect);
}

RenderOptions render_options_of(const SceneOptions& options) {
  RenderOptions render;
  render.depth = options.depth;
  if (options.glass_shadow == "none") render.glass_shadow = GlassShadow::none;
  if (options.glass_shadow == "filtered") render.glass_shadow = GlassShadow::filtered;
  return render;
}

RealType real_of(const SceneOptions& options) {
  if (options.real == "float") return RealType::float32;
  if (options.real == "double") return RealType::float64;
  return options.real == "quad" ? RealType::quad : RealType::long_double;
}

references::Renderer renderer_of(const SceneOptions& options) {
  return options.engine == "textbook" ? references::Renderer::textbook : references::Renderer::engine;
}

std::optional<references::Size> size_of(const SceneOptions& options) {
  if (options.size.empty()) return std::nullopt;
  const std::size_t x = options.size.find('x');
  const auto width = whole_number(std::string_view(options.size).substr(0, x));
  const auto height =
      x == std::string::npos ? std::nullopt : whole_number(std::string_view(options.size).substr(x + 1));
  if (!width || !height) {
    throw std::invalid_argument("--size: found '" + options.size + "', expected WxH, e.g. 480x320");
  }
  const bool fits = *width >= 1 && *height >= 1 && *width <= largest_side && *height <= largest_side &&
                    static_cast<double>(*width) * *height <= most_pixels;
  if (!fits) {
    throw std::invalid_argument("--size: found " + options.size +
                                ", expected 1 to 65535 a side and at most 268435456 pixels");
  }
  return references::Size{*width, *height};
}

references::PictureOptions picture_options(const SceneOptions& options, double tolerance,
                                           bool keeps_pictures) {
  return {
      size_of(options), options.camera,       tolerance,     dialect_of(options), render_options_of(options),
      real_of(options), renderer_of(options), keeps_pictures};
}

View view_of(const Scene& scene, const SceneOptions& options) {
  const RenderRequest& request = scene.renders.front();
  return {scene.camera(options.camera.empty() ? request.camera : options.camera),
          size_of(options).value_or(references::Size{request.width, request.height})};
}

std::string picture_arguments(const SceneOptions& options) {
  const SceneOptions usual;
  std::string text;
  const auto add = [&](const char* name, const std::string& value, const std::string& usual_value) {
    if (value != usual_value) text += std::string(" ") + name + " " + references::shell_word(value);
  };
  add("--size", options.size, usual.size);
  add("--camera", options.camera, usual.camera);
  add("--depth", std::to_string(options.depth), std::to_string(usual.depth));
  add("--glass-shadow", options.glass_shadow, usual.glass_shadow);
  add("--real", options.real, usual.real);
  add("--engine", options.engine, usual.engine);
  add("--dialect", options.dialect, usual.dialect);
  return text;
}

CLI::Option* add_report(CLI::App& app, std::string& directory) {
  return app
      .add_option("--report", directory,
                  "write a report with all pictures to DIR/index.html, one page that needs no network")
      ->type_name("DIR");
}

void say_report(const std::string& directory) {
  if (directory.empty()) return;
  std::printf("report: %s\n", (std::filesystem::path(directory) / "index.html").c_str());
}

void flush_output() {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  throw std::runtime_error(std::string("standard output: cannot be written: ") + std::strerror(errno));
}

void warn(const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); }

}  // namespace plumb::cli
