#include "references/attribution/by_format.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumb::attribution {
namespace {

bool is_traced(const Inquiry& inquiry, const AttributedPixel& p, const PixelTracer& tracer) {
  const std::optional<Colour> traced = tracer.at(p);
  return traced && comparison::is_within(inquiry.test(p), traced->data(), inquiry.job().tolerance);
}

/// To the last bit but for the rounding of the float itself. A clamped reference does not tell the test's
/// value; that must be what is traced.
void explain_one(const Inquiry& inquiry, AttributedPixel& p, const PixelTracer& tracer) {
  const double levels = inquiry.job().holds == renderers::Holds::bits8 ? 255 : 65535;
  bool clamps = false;
  for (int c = 0; c < 3; ++c) {
    const double value = inquiry.test(p)[c];
    const double held = std::clamp(value, 0.0, 1.0);
    clamps = clamps || held != value;
    // Half a level is rounded away; the test may be off by its own tolerance, which decides a tie.
    const double allowed = 0.5 / levels + inquiry.job().tolerance;
    if (std::abs(held - static_cast<double>(inquiry.reference(p)[c])) > allowed) return;
  }
  if (clamps && !is_traced(inquiry, p, tracer)) return;
  p.cause = clamps ? Cause::clamped : Cause::quantisation;
}

}  // namespace

void explain_by_format(const Inquiry& inquiry, const SuspectPixels& pixels) {
  textbook::Work one_picture(std::numeric_limits<double>::infinity());
  const PixelTracer tracer(inquiry.scene(), inquiry.job(), inquiry.job().shot.options, one_picture);
  for (AttributedPixel* const p : pixels) explain_one(inquiry, *p, tracer);
}

}  // namespace plumb::attribution
