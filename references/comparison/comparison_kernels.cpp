#include "references/comparison/comparison_kernels.hpp"

#undef HWY_TARGET_INCLUDE
// Left out: what widest_vectors() in tracer/system/vectors.hpp does not choose among; it would never run.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL)
#define HWY_TARGET_INCLUDE "references/comparison/comparison_kernels.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "tracer/system/vectors.hpp"

HWY_BEFORE_NAMESPACE();
namespace plumb::comparison::comparison_kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Doubles = hn::ScalableTag<double>;
using Floats = hn::Rebind<float, Doubles>;
using V = hn::Vec<Doubles>;
using Mask = hn::Mask<Doubles>;

float component(const std::byte* from, std::size_t index) {
  float value = 0;
  std::memcpy(&value, from + index * sizeof(float), sizeof value);
  return value;
}

/// Adds one pixel, for all cases.
void add_pixel(Tally& tally, const std::byte* reference, const std::byte* test, std::size_t channels,
               const Limit& limit, std::size_t number) {
  bool is_finite = true, is_over = false;
  double worst = -std::numeric_limits<double>::infinity(), judged = 0, largest = 0, sum = 0, squares = 0;
  for (std::size_t c = 0; c < channels; ++c) {
    const double r = component(reference, c), t = component(test, c);
    is_finite = is_finite && std::isfinite(r) && std::isfinite(t);
    const double difference = std::abs(t - r), scale = std::max(1.0, std::abs(r));
    is_over = is_over || difference > limit.at(r);
    judged = std::max(judged, difference / scale);
    worst = std::max(worst, (limit.is_relative() ? difference - limit.at(r) : difference) / scale);
    largest = std::max(largest, difference);
    sum += difference;
    squares += difference * difference;
  }
  if (!is_finite) worst = INFINITY;
  if (worst > tally.worst) {
    tally.worst = worst;
    tally.worst_pixel = number;
  }
  tally.pixels_over += is_over || !is_finite ? 1 : 0;
  tally.non_finite += is_finite ? 0 : 1;
  if (!is_finite) return;
  tally.judged_error = std::max(tally.judged_error, judged);
  tally.max_error = std::max(tally.max_error, largest);
  tally.sum += sum;
  tally.sum_of_squares += squares;
}

/// Loads as many components as a vector holds doubles; they need no alignment.
HWY_INLINE V load(const std::byte* from) {
#if HWY_TARGET == HWY_SCALAR
  return hn::Set(Doubles(), component(from, 0));
#else
  const hn::Repartition<std::uint8_t, Floats> bytes;
  return hn::PromoteTo(Doubles(),
                       hn::BitCast(Floats(), hn::LoadU(bytes, reinterpret_cast<const std::uint8_t*>(from))));
#endif
}

struct Sums {
  V largest, sum, squares;
};

/// Adds a vector of pixels, which is `channels` vectors of components. Returns false and adds nothing when a
/// component is not finite or farther off than the worst so far; the caller then adds each pixel by itself.
template <std::size_t channels>
HWY_INLINE bool add_vector(Sums& sums, std::size_t& over, const std::byte* reference, const std::byte* test,
                           double tolerance, double worst) {
  const Doubles d;
  const std::size_t lanes = hn::Lanes(d);
  V difference[channels];
  Mask is_over[channels];
  Mask is_special = hn::MaskFromVec(hn::Zero(d));
  for (std::size_t i = 0; i < channels; ++i) {
    const V r = load(reference + i * lanes * sizeof(float));
    const V t = load(test + i * lanes * sizeof(float));
    difference[i] = hn::Abs(hn::Sub(t, r));
    const V scale = hn::Max(hn::Set(d, 1.0), hn::Abs(r));
    is_over[i] = hn::Gt(difference[i], hn::Mul(hn::Set(d, tolerance), scale));
    // A component that is not finite leaves a difference that is not finite, and so not <= anything finite.
    is_special = hn::Or(is_special, hn::Not(hn::Le(difference[i], hn::Mul(hn::Set(d, worst), scale))));
    is_special = hn::Or(is_special, hn::Not(hn::Le(difference[i], hn::Set(d, 1e300))));
  }
  if (!hn::AllFalse(d, is_special)) return false;
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < channels; ++i) {
    sums.largest = hn::Max(sums.largest, difference[i]);
    sums.sum = hn::Add(sums.sum, difference[i]);
    sums.squares = hn::MulAdd(difference[i], difference[i], sums.squares);
    std::uint8_t mask[8] = {};
    hn::StoreMaskBits(d, is_over[i], mask);
    bits |= static_cast<std::uint64_t>(mask[0]) << (i * lanes);
  }
  if (bits == 0) return true;
  for (std::size_t pixel = 0; pixel < lanes; ++pixel) {
    constexpr std::uint64_t all = (std::uint64_t{1} << channels) - 1;
    over += (bits >> (pixel * channels) & all) != 0 ? 1 : 0;
  }
  return true;
}

template <std::size_t channels>
void add_pixels(Tally& tally, const std::byte* reference, const std::byte* test, std::size_t pixels,
                const Limit& limit, std::size_t first) {
  const Doubles d;
  Sums sums{hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  const std::size_t lanes = hn::Lanes(d);
  constexpr std::size_t size = channels * sizeof(float);
  const auto one_by_one = [&](std::size_t from, std::size_t end) {
    for (std::size_t i = from; i < end; ++i)
      add_pixel(tally, reference + i * size, test + i * size, channels, limit, first + i);
  };
  // The very first pixel is added by itself: it is the worst where all agree, however wide the vectors are.
  std::size_t i = tally.worst < 0 && pixels > 0 ? 1 : 0;
  one_by_one(0, i);
  for (; i + lanes <= pixels; i += lanes) {
    if (!add_vector<channels>(sums, tally.pixels_over, reference + i * size, test + i * size, limit.tolerance,
                              tally.judged_error))
      one_by_one(i, i + lanes);
  }
  one_by_one(i, pixels);
  tally.max_error = std::max(tally.max_error, hn::GetLane(hn::MaxOfLanes(d, sums.largest)));
  tally.sum += hn::GetLane(hn::SumOfLanes(d, sums.sum));
  tally.sum_of_squares += hn::GetLane(hn::SumOfLanes(d, sums.squares));
}

void add_target(Tally& tally, const std::byte* reference, const std::byte* test, std::size_t pixels,
                int channels, const Limit& limit, std::size_t first) {
  if (!limit.is_relative()) {
    if (channels == 1) return add_pixels<1>(tally, reference, test, pixels, limit, first);
    if (channels == 3) return add_pixels<3>(tally, reference, test, pixels, limit, first);
    if (channels == 4) return add_pixels<4>(tally, reference, test, pixels, limit, first);
  }
  const auto count = static_cast<std::size_t>(channels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const std::size_t at = i * count * sizeof(float);
    add_pixel(tally, reference + at, test + at, count, limit, first + i);
  }
}

}  // namespace plumb::comparison::comparison_kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plumb::comparison::comparison_kernels {

void add(Tally& tally, const std::byte* reference, const std::byte* test, std::size_t pixels, int channels,
         const Limit& limit, std::size_t first) {
  chosen(HWY_STATIC_DISPATCH(add_target), N_AVX2::add_target, N_AVX3::add_target)(
      tally, reference, test, pixels, channels, limit, first);
}

}  // namespace plumb::comparison::comparison_kernels
#endif
