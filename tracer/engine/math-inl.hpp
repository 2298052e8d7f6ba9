// Vectors of real numbers, and what shading needs of them, for one instruction set.
// No operation is a fused multiply-add, so that every one rounds alike for every width.

#if defined(PLUMB_ENGINE_MATH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUMB_ENGINE_MATH_INL
#undef PLUMB_ENGINE_MATH_INL
#else
#define PLUMB_ENGINE_MATH_INL
#endif

#include <hwy/highway.h>

#include "tracer/engine/streams.hpp"

HWY_BEFORE_NAMESPACE();
namespace plumb::engine::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class Real>
using Tag = hn::CappedTag<Real, 64 / sizeof(Real)>;
template <class Real>
using V = hn::Vec<Tag<Real>>;
template <class Real>
using M = hn::Mask<Tag<Real>>;
template <class Real>
using WordTag = hn::RebindToUnsigned<Tag<Real>>;
template <class Real>
using W = hn::Vec<WordTag<Real>>;

template <class Real>
struct V3 {
  V<Real> x, y, z;
};

template <class Real>
HWY_INLINE std::size_t lanes() {
  return hn::Lanes(Tag<Real>());
}
template <class Real>
HWY_INLINE V<Real> set(Real value) {
  return hn::Set(Tag<Real>(), value);
}
template <class Real>
HWY_INLINE V3<Real> set3(const Vec3<Real>& v) {
  return {set(v.x), set(v.y), set(v.z)};
}
template <class Real>
HWY_INLINE V<Real> load(const Real* from) {
  return hn::LoadU(Tag<Real>(), from);
}
template <class Real>
HWY_INLINE V3<Real> load3(const Lanes3<Real>& from, std::size_t i) {
  return {load(&from.x[i]), load(&from.y[i]), load(&from.z[i])};
}
template <class Real>
HWY_INLINE void store(V<Real> v, Real* to) {
  hn::StoreU(v, Tag<Real>(), to);
}
template <class Real>
HWY_INLINE void store3(const V3<Real>& v, Lanes3<Real>& to, std::size_t i) {
  store<Real>(v.x, &to.x[i]);
  store<Real>(v.y, &to.y[i]);
  store<Real>(v.z, &to.z[i]);
}
template <class Real>
HWY_INLINE V3<Real> sub(const V3<Real>& a, const V3<Real>& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
template <class Real>
HWY_INLINE V3<Real> add(const V3<Real>& a, const V3<Real>& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
template <class Real>
HWY_INLINE V3<Real> mul(const V3<Real>& a, const V3<Real>& b) {
  return {hn::Mul(a.x, b.x), hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)};
}
template <class Real>
HWY_INLINE V3<Real> scaled(const V3<Real>& a, V<Real> s) {
  return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)};
}
template <class Real>
HWY_INLINE V<Real> dot(const V3<Real>& a, const V3<Real>& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
/// 1 / sqrt(x).
template <class Real>
HWY_INLINE V<Real> exact_inverse_root(V<Real> x) {
  return hn::Div(set(Real(1)), hn::Sqrt(x));
}
HWY_INLINE V<float> inverse_root(V<float> x) { return exact_inverse_root<float>(x); }
/// Square roots and quotients of doubles take longest of all, so it takes those of floats and two of Newton's
/// steps.
HWY_INLINE V<double> inverse_root(V<double> x) {
  const hn::Rebind<float, Tag<double>> floats;
  const V<double> half = hn::Mul(x, set(0.5)), three_halves = set(1.5);
  const auto in_float = hn::Div(hn::Set(floats, 1.0F), hn::Sqrt(hn::DemoteTo(floats, x)));
  V<double> root = hn::PromoteTo(Tag<double>(), in_float);
  for (int step = 0; step < 2; ++step)
    root = hn::Mul(root, hn::Sub(three_halves, hn::Mul(hn::Mul(half, root), root)));
  const M<double> fits = hn::And(hn::Gt(x, set(0x1p-120)), hn::Lt(x, set(0x1p120)));
  if (HWY_LIKELY(hn::AllTrue(Tag<double>(), fits))) return root;
  return hn::IfThenElse(fits, root, exact_inverse_root<double>(x));
}
template <class Real>
HWY_INLINE V3<Real> normalised(const V3<Real>& a) {
  return scaled<Real>(a, inverse_root(dot<Real>(a, a)));
}
template <class Real>
HWY_INLINE V3<Real> where(M<Real> mask, const V3<Real>& yes, const V3<Real>& no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y),
          hn::IfThenElse(mask, yes.z, no.z)};
}
template <class Real>
HWY_INLINE bool none(M<Real> mask) {
  return hn::AllFalse(Tag<Real>(), mask);
}
/// Returns the lanes of a mask as bits, the first lane lowest.
template <class Real>
HWY_INLINE unsigned bits_of(M<Real> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(Tag<Real>(), mask, bytes);
  return bytes[0] | static_cast<unsigned>(bytes[1]) << 8;
}
template <class Real>
HWY_INLINE M<Real> first(std::size_t count) {
  return hn::FirstN(Tag<Real>(), count);
}

/// Numbers of a format that log_of and exp_of need.
template <class Real>
struct Format;
template <>
struct Format<double> {
  static constexpr int mantissa_bits = 52;
  static constexpr std::uint64_t exponent_of_one = 0x3ff, one = 0x3ff0000000000000,
                                 mantissa = 0xfffffffffffff;
  static constexpr double integer_magic = 0x1.8p52;  ///< adding it leaves an integer in the low bits
  static constexpr double ln2_high = 0x1.62e42fefa3800p-1, ln2_low = 0x1.ef35793c76730p-45;
  static constexpr double smallest = 1e-300, least_exponent = -708;
  static constexpr int log_terms = 8, exp_terms = 10;
};
template <>
struct Format<float> {
  static constexpr int mantissa_bits = 23;
  static constexpr std::uint32_t exponent_of_one = 0x7f, one = 0x3f800000, mantissa = 0x7fffff;
  static constexpr float integer_magic = 0x1.8p23F;
  static constexpr float ln2_high = 0x1.62e000p-1F, ln2_low = 0x1.0bfbe8p-15F;
  static constexpr float smallest = 1e-37F, least_exponent = -87;
  static constexpr int log_terms = 5, exp_terms = 7;
};

/// Natural logarithm of x >= Format::smallest. x = 2^e f with f about 1; log f = 2 artanh((f - 1) / (f + 1)),
/// by its series (Abramowitz and Stegun, 1964, 4.1.27).
template <class Real>
HWY_INLINE V<Real> log_of(V<Real> x) {
  using F = Format<Real>;
  const Tag<Real> d;
  const WordTag<Real> w;
  const auto bits = hn::BitCast(w, x);
  const V<Real> magic = set(F::integer_magic);
  const V<Real> exponent =
      hn::Sub(hn::BitCast(d, hn::Or(hn::ShiftRight<F::mantissa_bits>(bits), hn::BitCast(w, magic))),
              hn::Add(magic, set(static_cast<Real>(F::exponent_of_one))));
  const V<Real> f = hn::BitCast(d, hn::Or(hn::And(bits, hn::Set(w, F::mantissa)), hn::Set(w, F::one)));
  const M<Real> is_large = hn::Gt(f, set(static_cast<Real>(1.4142135623730951)));
  const V<Real> half = hn::IfThenElse(is_large, hn::Mul(f, set(Real(0.5))), f);
  const V<Real> e = hn::IfThenElse(is_large, hn::Add(exponent, set(Real(1))), exponent);
  const V<Real> s = hn::Div(hn::Sub(half, set(Real(1))), hn::Add(half, set(Real(1))));
  const V<Real> z = hn::Mul(s, s);
  V<Real> series = set(static_cast<Real>(2.0 / (2 * F::log_terms + 1)));
  for (int k = F::log_terms - 1; k >= 1; --k)
    series = hn::Add(hn::Mul(series, z), set(static_cast<Real>(2.0 / (2 * k + 1))));
  const V<Real> log_f = hn::Add(hn::Mul(hn::Mul(series, z), s), hn::Add(s, s));
  return hn::Add(hn::Mul(e, set(F::ln2_high)), hn::Add(log_f, hn::Mul(e, set(F::ln2_low))));
}

constexpr double per_factorial(int n) { return n < 2 ? 1.0 : per_factorial(n - 1) / n; }

/// e^x for x <= 88; 0 below Format::least_exponent. x = k ln 2 + r; e^r is computed by its series.
template <class Real>
HWY_INLINE V<Real> exp_of(V<Real> x) {
  using F = Format<Real>;
  const Tag<Real> d;
  const WordTag<Real> w;
  const V<Real> at_least = hn::Max(x, set(F::least_exponent));
  const V<Real> magic = set(F::integer_magic);
  const V<Real> rounded = hn::Add(hn::Mul(at_least, set(static_cast<Real>(1.4426950408889634))), magic);
  const V<Real> k = hn::Sub(rounded, magic);
  const V<Real> r = hn::Sub(hn::Sub(at_least, hn::Mul(k, set(F::ln2_high))), hn::Mul(k, set(F::ln2_low)));
  V<Real> series = set(static_cast<Real>(per_factorial(F::exp_terms)));
  for (int i = F::exp_terms - 1; i >= 0; --i)
    series = hn::Add(hn::Mul(series, r), set(static_cast<Real>(per_factorial(i))));
  const auto power =
      hn::ShiftLeft<F::mantissa_bits>(hn::Add(hn::BitCast(w, rounded), hn::Set(w, F::exponent_of_one)));
  return hn::IfThenElse(hn::Lt(x, set(F::least_exponent)), set(Real(0)),
                        hn::Mul(series, hn::BitCast(d, power)));
}

/// x^m for 0 < x < 2 and m >= 0.
template <class Real>
HWY_INLINE V<Real> power_of(V<Real> x, V<Real> m) {
  const V<Real> exponent = hn::Mul(m, log_of<Real>(hn::Max(x, set(Format<Real>::smallest))));
  return exp_of<Real>(hn::Min(exponent, set(Real(80))));
}

}  // namespace plumb::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
