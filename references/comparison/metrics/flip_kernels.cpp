#include "references/comparison/metrics/flip_kernels.hpp"

#undef HWY_TARGET_INCLUDE
// Left out: what widest_vectors() in tracer/system/vectors.hpp does not choose among; it would never run.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL)
#define HWY_TARGET_INCLUDE "references/comparison/metrics/flip_kernels.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#include <algorithm>

#include "references/comparison/metrics/flip_model.hpp"
#include "tracer/system/vectors.hpp"

HWY_BEFORE_NAMESPACE();
namespace plumb::comparison::flip_kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<float>;
using V = hn::Vec<D>;
using flip_model::Model;
using flip_model::Taps;

struct Triple {
  V a, b, c;
};

HWY_INLINE V constant(float value) { return hn::Set(D(), value); }

/// For x >= 0.
HWY_INLINE V power(V x, V exponent) {
  const V least = constant(1e-30F);
  const V raised = hn::Exp(D(), hn::Mul(hn::Log(D(), hn::Max(x, least)), exponent));
  return hn::IfThenElseZero(hn::Gt(x, least), raised);
}

HWY_INLINE Triple times(const std::array<float, 9>& m, const Triple& v) {
  const auto row = [&](std::size_t r) HWY_ATTR {
    return hn::MulAdd(constant(m[r]), v.a,
                      hn::MulAdd(constant(m[r + 1]), v.b, hn::Mul(constant(m[r + 2]), v.c)));
  };
  return {row(0), row(3), row(6)};
}

/// IEC 61966-2-1.
HWY_INLINE V from_srgb(V v) {
  const V curved = power(hn::Mul(hn::Add(v, constant(0.055F)), constant(1 / 1.055F)), constant(2.4F));
  return hn::IfThenElse(hn::Gt(v, constant(0.04045F)), curved, hn::Mul(v, constant(1 / 12.92F)));
}

/// K. Narkowicz (2016), its pre-exposure of 0.6 taken out; what would overflow is white.
HWY_INLINE V tone_mapped(V light) {
  const V v = hn::Min(hn::Max(light, hn::Zero(D())), constant(1e15F));
  const V above = hn::Mul(v, hn::MulAdd(v, constant(0.36F * 2.51F), constant(0.6F * 0.03F)));
  const V below =
      hn::MulAdd(v, hn::MulAdd(v, constant(0.36F * 2.43F), constant(0.6F * 0.59F)), constant(0.14F));
  return hn::Min(hn::Div(above, below), constant(1));
}

/// One row of r g b, interleaved and padded.
void to_opponent_row(const float* rgb, std::size_t width, ColourSpace space, float exposure, float* y,
                     float* cx, float* cz) {
  const Model& m = flip_model::model();
  const auto linear = [&](V v) HWY_ATTR {
    return space == ColourSpace::srgb ? from_srgb(v) : tone_mapped(hn::Mul(v, constant(exposure)));
  };
  for (std::size_t x = 0; x < width; x += hn::Lanes(D())) {
    V r, g, b;
    hn::LoadInterleaved3(D(), rgb + 3 * x, r, g, b);
    const Triple w = times(m.white_from_rgb, {linear(r), linear(g), linear(b)});
    hn::StoreU(hn::MulSub(constant(116), w.b, constant(16)), D(), y + x);
    hn::StoreU(hn::Mul(constant(500), hn::Sub(w.a, w.b)), D(), cx + x);
    hn::StoreU(hn::Mul(constant(200), hn::Sub(w.b, w.c)), D(), cz + x);
  }
}

/// Size of the room for replicated pixels on the left of a row that was filtered down the columns.
constexpr std::size_t margin = flip_model::most_taps;
enum Filtered { achromatic, red_green, blue_yellow_1, blue_yellow_2, smooth, edge, point, filtered_count };

struct Rows {
  const float* at[2 * flip_model::most_taps];  // rows from centre - radius on; those outside are replicated
};

HWY_INLINE Rows rows_around(const Opponent& picture, int plane, std::size_t y, int radius) {
  Rows rows{};
  for (int k = -radius; k <= radius; ++k) {
    const auto clamped = std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(y) + k, 0,
                                                    static_cast<std::ptrdiff_t>(picture.height) - 1);
    rows.at[k + radius] = picture.planes[plane].data() + static_cast<std::size_t>(clamped) * picture.stride;
  }
  return rows;
}

/// `load(k)` gives what lies k pixels from the centre.
template <bool is_odd, class Load>
HWY_INLINE V filtered(const Taps& taps, int radius, Load load) {
  V sum = is_odd ? hn::Zero(D()) : hn::Mul(constant(taps[0]), load(0));
  for (int k = 1; k <= radius; ++k) {
    const V pair = is_odd ? hn::Sub(load(k), load(-k)) : hn::Add(load(k), load(-k));
    sum = hn::MulAdd(constant(taps[static_cast<std::size_t>(k)]), pair, sum);
  }
  return sum;
}

template <bool is_odd>
HWY_INLINE void down_columns(const Opponent& picture, int plane, std::size_t y, const Taps& taps, int radius,
                             float* out) {
  const Rows rows = rows_around(picture, plane, y, radius);
  for (std::size_t x = 0; x < picture.width; x += hn::Lanes(D())) {
    const auto load = [&](int k) HWY_ATTR { return hn::LoadU(D(), rows.at[k + radius] + x); };
    hn::StoreU(filtered<is_odd>(taps, radius, load), D(), out + margin + x);
  }
  std::fill(out, out + margin, out[margin]);
  std::fill(out + margin + picture.width, out + margin + picture.width + padding,
            out[margin + picture.width - 1]);
}

void all_down_columns(const Opponent& p, std::size_t y, float* const* out) {
  const Model& m = flip_model::model();
  down_columns<false>(p, 0, y, m.achromatic, m.colour_radius, out[achromatic]);
  down_columns<false>(p, 1, y, m.red_green, m.colour_radius, out[red_green]);
  down_columns<false>(p, 2, y, m.blue_yellow_1, m.colour_radius, out[blue_yellow_1]);
  down_columns<false>(p, 2, y, m.blue_yellow_2, m.colour_radius, out[blue_yellow_2]);
  down_columns<false>(p, 0, y, m.smooth, m.feature_radius, out[smooth]);
  down_columns<true>(p, 0, y, m.edge, m.feature_radius, out[edge]);
  down_columns<false>(p, 0, y, m.point, m.feature_radius, out[point]);
}

/// What one picture contributes to the error of a vector of pixels.
struct Seen {
  Triple lab;  // adjusted after Hunt
  V edge, point;
};

HWY_INLINE V lab_curve(V t) {
  const V root = power(t, constant(1.0F / 3));
  const V line = hn::MulAdd(t, constant(841.0F / 108), constant(4.0F / 29));
  return hn::IfThenElse(hn::Gt(t, constant(216.0F / 24389)), root, line);
}

/// Back to linear RGB, clamped to what a screen shows, then CIELAB with Hunt's adjustment (2020, 4.1.2).
HWY_INLINE Triple hunt_lab(V y, V cx, V cz) {
  const Model& m = flip_model::model();
  const V white_y = hn::Mul(hn::Add(y, constant(16)), constant(1.0F / 116));
  const Triple rgb = times(m.rgb_from_white, {hn::MulAdd(cx, constant(1.0F / 500), white_y), white_y,
                                              hn::NegMulAdd(cz, constant(1.0F / 200), white_y)});
  const auto shown = [](V v) HWY_ATTR { return hn::Min(hn::Max(v, hn::Zero(D())), constant(1)); };
  const Triple w = times(m.white_from_rgb, {shown(rgb.a), shown(rgb.b), shown(rgb.c)});
  const V fx = lab_curve(w.a), fy = lab_curve(w.b), fz = lab_curve(w.c);
  const V lightness = hn::MulSub(constant(116), fy, constant(16));
  return {lightness, hn::Mul(hn::Mul(lightness, constant(5)), hn::Sub(fx, fy)),
          hn::Mul(hn::Mul(lightness, constant(2)), hn::Sub(fy, fz))};
}

HWY_INLINE V length(V a, V b) { return hn::Sqrt(hn::MulAdd(a, a, hn::Mul(b, b))); }

HWY_INLINE Seen seen(const float* const* rows, std::size_t x) {
  const Model& m = flip_model::model();
  const auto even = [&](Filtered row, const Taps& taps, int radius) HWY_ATTR {
    return filtered<false>(taps, radius,
                           [&](int k) HWY_ATTR { return hn::LoadU(D(), rows[row] + margin + x + k); });
  };
  const auto odd = [&](Filtered row, const Taps& taps, int radius) HWY_ATTR {
    return filtered<true>(taps, radius,
                          [&](int k) HWY_ATTR { return hn::LoadU(D(), rows[row] + margin + x + k); });
  };
  const int c = m.colour_radius, f = m.feature_radius;
  const V yellow = hn::Add(even(blue_yellow_1, m.blue_yellow_1, c), even(blue_yellow_2, m.blue_yellow_2, c));
  // The features see brightness from 0 to 1: (Y + 16) / 116, of which the derivatives keep the factor.
  const V scale = constant(1.0F / 116);
  return {hunt_lab(even(achromatic, m.achromatic, c), even(red_green, m.red_green, c), yellow),
          hn::Mul(scale, length(odd(smooth, m.edge, f), even(edge, m.smooth, f))),
          hn::Mul(scale, length(even(smooth, m.point, f), even(point, m.smooth, f)))};
}

/// 2020, section 4.1.3: HyAB, to the power of 0.7, stretched so that 0.4 of the largest becomes 0.95.
HWY_INLINE V colour_error(const Triple& r, const Triple& t) {
  const float largest = flip_model::model().largest;
  const float knee = 0.4F * largest;
  const V hyab = hn::Add(hn::Abs(hn::Sub(r.a, t.a)), length(hn::Sub(r.b, t.b), hn::Sub(r.c, t.c)));
  const V raised = power(hyab, constant(0.7F));
  const V above =
      hn::MulAdd(hn::Sub(raised, constant(knee)), constant(0.05F / (largest - knee)), constant(0.95F));
  return hn::IfThenElse(hn::Lt(raised, constant(knee)), hn::Mul(raised, constant(0.95F / knee)), above);
}

/// 2020, sections 4.2.2 and 4.3.
HWY_INLINE V error(const Seen& r, const Seen& t) {
  const V feature = hn::Max(hn::Abs(hn::Sub(r.edge, t.edge)), hn::Abs(hn::Sub(r.point, t.point)));
  const V exponent = hn::Sub(constant(1), hn::Sqrt(hn::Mul(feature, constant(0.70710678F))));
  return hn::Min(power(colour_error(r.lab, t.lab), exponent), constant(1));
}

void raise_errors_target(const Opponent& reference, const Opponent& test, std::size_t first, std::size_t last,
                         float* errors) {
  const std::size_t length_of_row = margin + reference.width + 2 * padding;
  constexpr std::size_t count = 2 * std::size_t{filtered_count};
  std::vector<float> scratch(count * length_of_row + reference.width + padding);
  float* rows[count];
  for (std::size_t i = 0; i < count; ++i) rows[i] = scratch.data() + i * length_of_row;
  float* const row = scratch.data() + count * length_of_row;
  for (std::size_t y = first; y < last; ++y) {
    all_down_columns(reference, y, rows);
    all_down_columns(test, y, rows + filtered_count);
    for (std::size_t x = 0; x < reference.width; x += hn::Lanes(D())) {
      hn::StoreU(error(seen(rows, x), seen(rows + filtered_count, x)), D(), row + x);
    }
    float* const out = errors + y * reference.width;
    for (std::size_t x = 0; x < reference.width; ++x) out[x] = std::max(out[x], row[x]);
  }
}

}  // namespace plumb::comparison::flip_kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plumb::comparison::flip_kernels {

Opponent to_opponent(const PictureView& picture, ColourSpace space, float exposure) {
  Opponent planes;
  planes.width = static_cast<std::size_t>(picture.width);
  planes.height = static_cast<std::size_t>(picture.height);
  planes.stride = planes.width + padding;
  for (std::vector<float>& plane : planes.planes) plane.resize(planes.stride * planes.height);
  std::vector<float> rgb(3 * planes.stride);
  const bool is_grey = picture.channels < 3;
  const auto to_row =
      chosen(HWY_STATIC_DISPATCH(to_opponent_row), N_AVX2::to_opponent_row, N_AVX3::to_opponent_row);
  for (std::size_t y = 0; y < planes.height; ++y) {
    for (std::size_t x = 0; x < planes.width; ++x) {
      const float* const from = picture.pixel(y * planes.width + x);
      for (std::size_t c = 0; c < 3; ++c) rgb[3 * x + c] = from[is_grey ? 0 : c];
    }
    const std::size_t at = y * planes.stride;
    to_row(rgb.data(), planes.width, space, exposure, &planes.planes[0][at], &planes.planes[1][at],
           &planes.planes[2][at]);
  }
  return planes;
}

void raise_errors(const Opponent& reference, const Opponent& test, std::size_t first, std::size_t last,
                  float* errors) {
  chosen(HWY_STATIC_DISPATCH(raise_errors_target), N_AVX2::raise_errors_target, N_AVX3::raise_errors_target)(
      reference, test, first, last, errors);
}

}  // namespace plumb::comparison::flip_kernels
#endif
