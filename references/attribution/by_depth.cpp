#include "references/attribution/by_depth.hpp"

#include "references/attribution/divergence.hpp"

namespace plumb::attribution {
namespace {

/// Whether the test is traced at the asked depth, and the reference, which is another value, at the other.
bool shows_both(const Inquiry& inquiry, const AttributedPixel& p, const PixelTracer& other_depth) {
  const double tolerance = inquiry.job().tolerance;
  const std::optional<Colour> ours = inquiry.still().at(p);
  const std::optional<Colour> other = other_depth.at(p);
  return ours && other && comparison::is_within(inquiry.test(p), ours->data(), tolerance) &&
         comparison::is_within(inquiry.reference(p), other->data(), tolerance) &&
         !comparison::is_within(ours->data(), other->data(), tolerance);
}

}  // namespace

void explain_by_depth(const Inquiry& inquiry, int depth, const SuspectPixels& pixels) {
  if (depth < 1 || inquiry.work().is_over()) return;
  RenderOptions options = inquiry.job().shot.options;
  options.depth = depth;
  const PixelTracer other(inquiry.scene(), inquiry.job(), options, inquiry.work());
  for (AttributedPixel* const p : pixels) {
    if (p->cause != Cause::unexplained || inquiry.work().is_over() || !shows_both(inquiry, *p, other))
      continue;
    if (first_divergence(inquiry.still().tree_of(*p), other.tree_of(*p), inquiry.perturbation().extent(),
                         inquiry.job().resolution) == Cause::depth)
      p->cause = Cause::depth;
  }
}

}  // namespace plumb::attribution
