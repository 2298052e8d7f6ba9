#include "references/cli/options.hpp"

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "tracer/text/numbers.hpp"
#include "tracer/text/shell_word.hpp"
#include "tracer/text/words.hpp"

namespace plumb::cli {
namespace {

using gates::PictureOptions;

constexpr int largest_side = 65535;
constexpr double most_pixels = 1 << 28;

constexpr Word<GlassShadow> glass_shadows[] = {
    {"full", GlassShadow::full}, {"none", GlassShadow::none}, {"filtered", GlassShadow::filtered}};
constexpr Word<RealType> real_types[] = {{"float", RealType::float32},
                                         {"double", RealType::float64},
                                         {"long-double", RealType::long_double},
                                         {"quad", RealType::quad}};
constexpr Word<renderers::OwnTracer> tracers[] = {{"textbook", renderers::OwnTracer::textbook},
                                                  {"engine", renderers::OwnTracer::engine}};

std::optional<int> whole_number(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

Size size_named(const std::string& text) {
  const std::size_t x = text.find('x');
  const auto width = whole_number(std::string_view(text).substr(0, x));
  const auto height =
      x == std::string::npos ? std::nullopt : whole_number(std::string_view(text).substr(x + 1));
  if (!width || !height)
    throw std::invalid_argument("--size: found '" + text + "', expected WxH, e.g. 480x320");
  const bool fits = *width >= 1 && *height >= 1 && *width <= largest_side && *height <= largest_side &&
                    static_cast<double>(*width) * *height <= most_pixels;
  if (!fits)
    throw std::invalid_argument("--size: found " + text +
                                ", expected 1 to 65535 a side and at most 268435456 pixels");
  return {*width, *height};
}

std::string text_of(const std::optional<Size>& size) {
  return size ? std::to_string(size->width) + "x" + std::to_string(size->height) : "";
}

}  // namespace

Option output_option(const std::string& name, std::string& file, const std::string& purpose) {
  return {name, &file, purpose + "; - is standard output", {.value = "FILE"}};
}

Option report_option(std::string& directory) {
  return {"--report",
          &directory,
          "write a report with all pictures to DIR/index.html, one page that needs no network",
          {.value = "DIR"}};
}

Option dialect_option(Dialect& dialect, std::string* name, const std::string& list) {
  const auto read = [&dialect, name](const std::string& text) {
    if (!text.empty()) dialect = parse_dialect(text);
    if (name != nullptr) *name = text;
  };
  return {"--dialect",
          read,
          "how the file deviates from the course grammar; parts joined by commas" + list,
          {.value = "NAME"}};
}

Option depth_option(int& depth, const std::string& purpose, Rules rules) {
  rules.shows_default = true;
  rules.range = within(1, max_depth);
  return {"--depth", &depth, purpose, rules};
}

Table scene_options(PictureOptions& picture) {
  const auto read_size = [&picture](const std::string& text) {
    if (!text.empty()) picture.size = size_named(text);
  };
  return {{"--size", read_size, "size of the picture instead of the scene's own", {.value = "WxH"}},
          {"--camera", &picture.camera, "camera instead of the scene's own", {.value = "NAME"}},
          depth_option(picture.render.depth,
                       "recursion depth D: trace(depth >= D) is black; the primary ray has depth 0",
                       {.value = "D"}),
          {"--glass-shadow",
           one_of(picture.render.glass_shadow, glass_shadows),
           "full: glass blocks light (the lecture); none: it casts no shadow; filtered: light times kt "
           "a surface",
           {.shows_default = true}},
          dialect_option(picture.dialect, &picture.dialect_name)};
}

Table tracer_options(PictureOptions& picture) {
  return {{"--real",
           one_of(picture.real, real_types),
           "type of real numbers, of 24, 53, 64 and 113 bits; long-double and quad are rendered by the "
           "textbook tracer",
           {.shows_default = true}},
          {"--engine",
           one_of(picture.tracer, tracers),
           "engine: the fast tracer (float and double); textbook: the readable one",
           {.shows_default = true}}};
}

Option tolerance_option(double& tolerance) {
  return {"--tolerance",
          &tolerance,
          "largest error of a linear component, relative above 1, that agrees",
          {.value = "T", .shows_default = true, .complaint = complaint_about_size}};
}

Option error_option(double& error, const std::string& purpose, Rules rules) {
  rules.value = "E";
  rules.complaint = [](const std::string& text) -> std::string {
    const Number number = parse_number(text);
    if (number.complaint.empty() && number.value > 0) return {};
    return "found " + in_quotes(text) + ", expected a finite number > 0, e.g. 0.001";
  };
  return {"--error", &error, purpose, rules};
}

Option hint_option(int& hint) {
  return {"--hint",
          &hint,
          "how much is told: 1 the slide, 2 the mistake, 3 the formula, too",
          {.value = "LEVEL", .shows_default = true, .range = within(1, 3)}};
}

std::string complaint_about_size(const std::string& text) {
  const Number number = parse_number(text);
  if (number.complaint.empty() && number.value >= 0) return {};
  return "found " + in_quotes(text) + ", expected a finite number >= 0";
}

std::string picture_arguments(const PictureOptions& options) {
  const PictureOptions usual;
  std::string text;
  const auto add = [&](const char* name, const std::string& value, const std::string& usual_value) {
    if (value != usual_value) text += std::string(" ") + name + " " + shell_word(value);
  };
  add("--size", text_of(options.size), "");
  add("--camera", options.camera, "");
  add("--depth", std::to_string(options.render.depth), std::to_string(usual.render.depth));
  add("--glass-shadow", word_for(options.render.glass_shadow, glass_shadows), "full");
  add("--real", word_for(options.real, real_types), "double");
  add("--engine", word_for(options.tracer, tracers), "engine");
  add("--dialect", options.dialect_name, "");
  return text;
}

std::string explain_arguments(PictureOptions options) {
  options.real = PictureOptions{}.real;
  options.tracer = PictureOptions{}.tracer;
  return picture_arguments(options);
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
