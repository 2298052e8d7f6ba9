#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

#include "references/cli/commands.hpp"
#include "references/cli/compare_report.hpp"
#include "references/cli/compared_contents.hpp"
#include "references/cli/metrics.hpp"
#include "references/cli/options.hpp"
#include "references/cli/report.hpp"
#include "references/comparison.hpp"
#include "references/mismatch.hpp"
#include "references/shape_mismatch.hpp"
#include "tracer/image/io.hpp"

namespace plumb::cli {
namespace {

struct Options {
  std::string reference;
  std::string test;
  std::string json;
  std::string report;
  double tolerance = 1e-6;
  bool metrics = false;
};

void refuse_if_unlike(const Options& options, const PixelRows& reference, const PixelRows& test) {
  const auto shape = [](const PixelRows& i) {
    return std::to_string(i.width) + " x " + std::to_string(i.height) + " pixels of " +
           std::to_string(i.channels) + " channel" + (i.channels == 1 ? "" : "s");
  };
  const auto mismatch = references::shape_mismatch(reference, test);
  if (!mismatch) return;
  throw std::invalid_argument(options.test + ": found " + shape(test) + ", expected " + shape(reference) +
                              " as in " + options.reference + "; likely cause: " + *mismatch);
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

struct Findings {
  references::Comparison comparison;
  std::optional<references::LikelyCause> cause;
  std::optional<references::Metrics> metrics;
  std::string contents;
  Json contents_json;
};

void print(const Findings& findings) {
  const references::Comparison& c = findings.comparison;
  if (c.non_finite > 0) std::printf("not finite   %zu pixels\n", c.non_finite);
  std::printf("max error    %.9g\nmean error   %.9g\nRMS error    %.9g\npixels over  %zu of %zu\n",
              c.max_error, c.mean_error, c.rms_error, c.pixels_over, c.pixels);
  std::printf("worst pixel  (%d, %d): test %s, reference %s\n", c.worst.x, c.worst.y,
              components(c.worst.test).c_str(), components(c.worst.reference).c_str());
  if (findings.metrics) std::fputs(metrics_table(*findings.metrics).c_str(), stdout);
  if (findings.cause) std::printf("likely cause: %s\n", cause_text(*findings.cause).c_str());
  std::fputs(findings.contents.c_str(), stdout);
  std::printf("%s\n", c.agrees() ? "agree" : "differ");
}

references::Metrics metrics_of(const PixelRows& reference, const PixelRows& test) {
  const bool is_srgb = reference.sample == Sample::bits8 && test.sample == Sample::bits8;
  const ImageFile r = image_of(reference), t = image_of(test);
  const auto view = [](const ImageFile& i) {
    return references::PictureView{i.width, i.height, i.channels, i.values.data()};
  };
  return references::all_metrics(view(r), view(t),
                                 is_srgb ? references::ColourSpace::srgb : references::ColourSpace::linear);
}

Json json_of(const Options& options, const PixelRows& test, const Findings& findings) {
  const references::Comparison& c = findings.comparison;
  Json json{{"tool", "plumb"},
            {"version", PLUMB_VERSION},
            {"reference", options.reference},
            {"test", options.test},
            {"status", c.agrees() ? "agree" : "differ"},
            {"tolerance", options.tolerance},
            {"width", test.width},
            {"height", test.height}};
  json.update(to_json(c));
  json.update(findings.contents_json);
  json["worst"]["test"] = c.worst.test;
  if (findings.cause) json["likely_cause"] = to_json(*findings.cause);
  if (findings.metrics) json["metrics"] = to_json(*findings.metrics);
  return json;
}

int run_compare(const Options& options) {
  PixelRows reference = open_image(options.reference);
  PixelRows test = open_image(options.test);
  references::leave_out_opaque_alpha(reference, test);
  refuse_if_unlike(options, reference, test);
  const NamedRows named_reference{options.reference, reference}, named_test{options.test, test};
  Findings findings{references::compare(reference, test, options.tolerance), {}, {}, {}, {}};
  const references::Comparison& c = findings.comparison;
  if (!c.agrees()) findings.cause = references::likely_cause(reference, test, options.tolerance, c);
  if (options.metrics) findings.metrics = metrics_of(reference, test);
  findings.contents = contents_text(named_reference, named_test);
  findings.contents_json = contents_json(named_reference, named_test);
  if (options.json != "-") print(findings);
  if (!options.json.empty()) write_json(options.json, json_of(options, test, findings));
  if (!options.report.empty()) {
    const Json json = json_of(options, test, findings);
    write_compare_report(options.report, {options.reference, std::move(reference)},
                         {options.test, std::move(test)}, options.tolerance, json);
    if (options.json != "-") say_report(options.report);
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
  app->add_flag("--metrics", options->metrics, "also PSNR, percentiles, bias, SSIM and FLIP");
  app->add_option("--json", options->json, "write the results as JSON; - is standard output")
      ->type_name("FILE");
  app->add_option("--report", options->report, "write a report with both pictures to DIR/index.html")
      ->type_name("DIR");
  app->footer(
      "Example: plumb compare reference.exr mine.exr --tolerance 0.001\n"
      "Values are compared as they stand in the files; 8 and 16 bits count from 0 to 1.\n" +
      std::string(metrics_help) + "\nExit codes: 0 agree, 1 differ, 2 trouble.");
  return {app, [options] { return run_compare(*options); }};
}

}  // namespace plumb::cli
