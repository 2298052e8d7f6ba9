#include "references/cli/compare_pair.hpp"

#include <cstdio>
#include <stdexcept>

#include "references/cli/bounds_options.hpp"
#include "references/cli/compared_contents.hpp"
#include "references/cli/metrics.hpp"
#include "references/comparison/shape_mismatch.hpp"

namespace plumb::cli {
namespace {

void refuse_if_unlike(const Findings& f) {
  const auto shape = [](const PixelRows& i) {
    return std::to_string(i.width) + " x " + std::to_string(i.height) + " pixels of " +
           std::to_string(i.channels) + " channel" + (i.channels == 1 ? "" : "s");
  };
  const auto mismatch = references::shape_mismatch(f.reference, f.test);
  if (!mismatch) return;
  throw std::invalid_argument(f.test_path + ": found " + shape(f.test) + ", expected " + shape(f.reference) +
                              " as in " + f.reference_path + "; likely cause: " + *mismatch);
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

references::Metrics metrics_of(const PixelRows& reference, const PixelRows& test) {
  const bool is_srgb = reference.sample == Sample::bits8 && test.sample == Sample::bits8;
  const ImageFile r = image_of(reference), t = image_of(test);
  const auto view = [](const ImageFile& i) {
    return references::PictureView{i.width, i.height, i.channels, i.values.data()};
  };
  return references::all_metrics(view(r), view(t),
                                 is_srgb ? references::ColourSpace::srgb : references::ColourSpace::linear);
}

}  // namespace

std::string contents_of(const Findings& f) {
  return contents_text({f.reference_path, f.reference}, {f.test_path, f.test});
}

std::string verdict_of(const Findings& f) {
  if (!f.agrees()) return "differ";
  return f.result.comparison.pixels_over > 0 ? "agree within the bounds" : "agree";
}

Findings compare_files(const std::string& reference, const std::string& test,
                       const references::Bounds& bounds, const PairOptions& options) {
  Findings f;
  f.reference_path = reference;
  f.test_path = test;
  f.bounds = bounds;
  f.reference = open_image(reference, options.read);
  f.test = open_image(test, options.read);
  references::leave_out_opaque_alpha(f.reference, f.test);
  refuse_if_unlike(f);
  f.result = references::compare_within(f.reference, f.test, bounds);
  const references::Comparison& c = f.result.comparison;
  if (!c.agrees()) f.cause = references::likely_cause(f.reference, f.test, bounds.limit, c, f.result.mask);
  if (options.metrics && bounds.has_regions())
    f.no_metrics = "they are of whole pictures, and pixels are ignored";
  if (options.metrics && f.no_metrics.empty()) f.metrics = metrics_of(f.reference, f.test);
  return f;
}

void print(const Findings& f) {
  const references::Comparison& c = f.result.comparison;
  if (c.non_finite > 0) std::printf("not finite   %zu pixels\n", c.non_finite);
  std::printf("max error    %.9g\nmean error   %.9g\nRMS error    %.9g\npixels over  %zu of %zu\n",
              c.max_error, c.mean_error, c.rms_error, c.pixels_over, c.pixels);
  std::printf("worst pixel  (%d, %d): test %s, reference %s\n", c.worst.x, c.worst.y,
              components(c.worst.test).c_str(), components(c.worst.reference).c_str());
  const std::string allowed = bounds_text(f.bounds, f.result);
  if (!allowed.empty()) std::printf("bounds       %s\n", allowed.c_str());
  if (f.metrics) std::fputs(metrics_table(*f.metrics).c_str(), stdout);
  if (!f.no_metrics.empty()) std::printf("no metrics: %s\n", f.no_metrics.c_str());
  if (f.cause) std::printf("likely cause: %s\n", cause_text(*f.cause).c_str());
  std::fputs(contents_of(f).c_str(), stdout);
  std::printf("%s\n", verdict_of(f).c_str());
}

Json json_of(const Findings& f) {
  const references::Comparison& c = f.result.comparison;
  Json json{{"tool", "plumb"},
            {"version", PLUMB_VERSION},
            {"reference", f.reference_path},
            {"test", f.test_path},
            {"status", f.agrees() ? "agree" : "differ"},
            {"tolerance", f.bounds.limit.tolerance},
            {"width", f.test.width},
            {"height", f.test.height}};
  json.update(to_json(c));
  json.update(contents_json({f.reference_path, f.reference}, {f.test_path, f.test}));
  json["worst"]["test"] = c.worst.test;
  if (!f.bounds.are_plain()) json["bounds"] = to_json(f.bounds, f.result);
  if (f.cause) json["likely_cause"] = to_json(*f.cause);
  if (f.metrics) json["metrics"] = to_json(*f.metrics);
  if (!f.no_metrics.empty()) json["no_metrics"] = f.no_metrics;
  return json;
}

std::string details_of(const Findings& f) {
  const references::Comparison& c = f.result.comparison;
  std::string text = std::to_string(c.pixels_over) + " of " + std::to_string(c.pixels) + " pixels are over";
  if (c.non_finite > 0) text += ", " + std::to_string(c.non_finite) + " of them are not finite";
  text += "; worst pixel (" + std::to_string(c.worst.x) + ", " + std::to_string(c.worst.y) + "): test " +
          components(c.worst.test) + ", reference " + components(c.worst.reference);
  const std::string allowed = bounds_text(f.bounds, f.result);
  if (!allowed.empty()) text += "\nbounds: " + allowed;
  if (f.cause) text += "\nlikely cause: " + cause_text(*f.cause);
  const std::string contents = contents_of(f);
  return contents.empty() ? text : text + "\n" + contents.substr(0, contents.size() - 1);
}

std::string output_of(const Findings& f) {
  const bool is_plain = f.bounds.are_plain() && contents_of(f).empty();
  return is_plain ? "" : details_of(f);
}

}  // namespace plumb::cli
