#include "references/diagnosis/pixel_beside.hpp"

#include <cmath>

#include "references/diagnosis/evidence.hpp"

namespace plumb::diagnosis {
namespace {

/// From the scale of 0 to 255 to what the file holds.
double in_file(float level, const OutputEncoding& encoding, std::size_t channel) {
  if (encoding.is_float) return double{level} / 255;
  return std::round(double{level} / 255 * (encoding.levels[channel] - 1));
}

}  // namespace

PixelBeside pixel_beside(const Shot& shot, const ImageFile& seen, int x, int y) {
  Evidence evidence(shot.scene, shot.camera, job_of(shot), seen, {});
  evidence.look_at(evidence.survey());
  const OutputEncoding encoding = evidence.fit({}, evidence.pixels()).encoding;
  const std::size_t pixel = evidence.index_of({x, y});
  const float* const right = evidence.picture_with({}).pixel(x, y);
  PixelBeside beside{.seen = {}, .expected = {}, .encoding = encoding};
  for (std::size_t channel = 0; channel < 3; ++channel) {
    beside.seen[channel] = in_file(evidence.seen(pixel)[channel], encoding, channel);
    beside.expected[channel] = in_file(encoding.level(right[channel], channel), encoding, channel);
  }
  return beside;
}

}  // namespace plumb::diagnosis
