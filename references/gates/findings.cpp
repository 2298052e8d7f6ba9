#include "references/gates/findings.hpp"

#include <stdexcept>

#include "references/comparison/shape_mismatch.hpp"

namespace plumb::gates {
namespace {

void refuse_if_unlike(const Findings& f) {
  const auto shape = [](const PixelRows& i) {
    return std::to_string(i.width) + " x " + std::to_string(i.height) + " pixels of " +
           std::to_string(i.channels) + " channel" + (i.channels == 1 ? "" : "s");
  };
  const auto mismatch = comparison::shape_mismatch(f.reference, f.test);
  if (!mismatch) return;
  throw std::invalid_argument(f.test_path + ": found " + shape(f.test) + ", expected " + shape(f.reference) +
                              " as in " + f.reference_path + "; likely cause: " + *mismatch);
}

comparison::Metrics metrics_of(const PixelRows& reference, const PixelRows& test) {
  const bool is_srgb = reference.sample == Sample::bits8 && test.sample == Sample::bits8;
  const ImageFile r = image_of(reference), t = image_of(test);
  const auto view = [](const ImageFile& i) {
    return comparison::PictureView{i.width, i.height, i.channels, i.values.data()};
  };
  return comparison::all_metrics(view(r), view(t),
                                 is_srgb ? comparison::ColourSpace::srgb : comparison::ColourSpace::linear);
}

}  // namespace

Findings compare_files(const std::string& reference, const std::string& test, const Bounds& bounds,
                       const PairOptions& options) {
  Findings f;
  f.reference_path = reference;
  f.test_path = test;
  f.bounds = bounds;
  f.reference = open_image(reference, options.read);
  f.test = open_image(test, options.read);
  comparison::leave_out_opaque_alpha(f.reference, f.test);
  refuse_if_unlike(f);
  f.result = compare_within(f.reference, f.test, bounds);
  const comparison::Comparison& c = f.result.comparison;
  if (!c.agrees()) f.cause = comparison::likely_cause(f.reference, f.test, bounds.limit, c, f.result.mask);
  if (options.metrics && bounds.has_regions())
    f.no_metrics = "they are of whole pictures, and pixels are ignored";
  if (options.metrics && f.no_metrics.empty()) f.metrics = metrics_of(f.reference, f.test);
  return f;
}

}  // namespace plumb::gates
