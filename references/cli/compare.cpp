#include <cstdio>
#include <memory>

#include "references/cli/commands.hpp"
#include "references/cli/compare_report.hpp"
#include "references/cli/options.hpp"
#include "references/cli/report.hpp"
#include "references/comparison.hpp"
#include "tracer/image/io.hpp"

namespace plumb::cli {
namespace {

struct Options {
  std::string reference;
  std::string test;
  std::string json;
  std::string report;
  double tolerance = 1e-6;
};

void refuse_if_unlike(const Options& options, const ImageFile& reference, const ImageFile& test) {
  const auto shape = [](const ImageFile& i) {
    return std::to_string(i.width) + " x " + std::to_string(i.height) + " pixels of " +
           std::to_string(i.channels) + " channels";
  };
  if (reference.width == test.width && reference.height == test.height && reference.channels == test.channels)
    return;
  throw std::invalid_argument(options.test + ": found " + shape(test) + ", expected " + shape(reference) +
                              " as in " + options.reference);
}

std::string components(const std::vector<float>& values) {
  std::string text;
  for (const float v : values) {
    char number[32];
    std::snprintf(number, sizeof number, "%s%.9g", text.empty() ? "" : " ", static_cast<double>(v));
    text += number;
  }
  return text;
}

void print(const references::Comparison& c) {
  if (c.non_finite > 0) std::printf("not finite   %zu pixels\n", c.non_finite);
  std::printf("max error    %.9g\nmean error   %.9g\nRMS error    %.9g\npixels over  %zu of %zu\n",
              c.max_error, c.mean_error, c.rms_error, c.pixels_over, c.pixels);
  std::printf("worst pixel  (%d, %d): test %s, reference %s\n", c.worst.x, c.worst.y,
              components(c.worst.test).c_str(), components(c.worst.reference).c_str());
  std::printf("%s\n", c.agrees() ? "agree" : "differ");
}

Json result_json(const Options& options, const ImageFile& test, const references::Comparison& c) {
  Json json{{"tool", "plumb"},
            {"version", PLUMB_VERSION},
            {"reference", options.reference},
            {"test", options.test},
            {"status", c.agrees() ? "agree" : "differ"},
            {"tolerance", options.tolerance},
            {"width", test.width},
            {"height", test.height}};
  json.update(to_json(c));
  json["worst"]["test"] = c.worst.test;
  return json;
}

int run_compare(const Options& options) {
  const ImageFile reference = read_image(options.reference);
  const ImageFile test = read_image(options.test);
  refuse_if_unlike(options, reference, test);
  const auto c = references::compare(test.width, test.height, test.channels, reference.values, test.values,
                                     options.tolerance);
  if (options.json != "-") print(c);
  if (!options.json.empty()) write_json(options.json, result_json(options, test, c));
  if (!options.report.empty()) {
    write_compare_report(options.report, {options.reference, reference}, {options.test, test},
                         options.tolerance, result_json(options, test, c));
  }
  return c.agrees() ? exit_agrees : exit_differs;
}

}  // namespace

Command add_compare(CLI::App& plumb) {
  CLI::App* app =
      plumb.add_subcommand("compare", "Compare two image files of the same size, value by value.");
  auto options = std::make_shared<Options>();
  app->add_option("REFERENCE", options->reference, "image that is taken to be right")->required();
  app->add_option("TEST", options->test, "image to be judged")->required();
  add_tolerance(*app, options->tolerance);
  app->add_option("--json", options->json, "write the results as JSON; - is standard output")
      ->type_name("FILE");
  app->add_option("--report", options->report, "write a report with both pictures to DIR/index.html")
      ->type_name("DIR");
  app->footer(
      "Example: plumb compare reference.exr mine.exr --tolerance 0.001\n"
      "Values are compared as they stand in the files; 8 and 16 bits count from 0 to 1.\n"
      "Exit codes: 0 agree, 1 differ, 2 trouble.");
  return {app, [options] { return run_compare(*options); }};
}

}  // namespace plumb::cli
