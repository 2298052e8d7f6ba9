// A real type of 113 significant bits, IEEE 754's binary128, in which the oracle computes.
#pragma once

#include <limits>
#include <numbers>
#include <type_traits>

// These belong to GCC's libquadmath. Its header is GCC's own; other compilers that know the type do not find
// it.
extern "C" {
__float128 sqrtq(__float128);
__float128 powq(__float128, __float128);
__float128 sinq(__float128);
__float128 cosq(__float128);
__float128 tanq(__float128);
}

namespace plumb {

/// A binary128, about thirty times slower than a double. GLM needs a class that default construction leaves
/// uninitialised, as it does numbers. Boost.Multiprecision's classes are initialised.
class Quad {
 public:
  Quad() = default;
  // Implicit, so that formulas write numbers of every kind as they are.
  template <class Number>
  requires(!std::is_same_v<Number, Quad> &&
           std::numeric_limits<Number>::is_specialized) constexpr Quad(Number value)
      : value_(static_cast<__float128>(value)) {}
  constexpr Quad(__float128 value) : value_(value) {}

  template <class Number>
  requires(!std::is_same_v<Number, Quad> && std::numeric_limits<Number>::is_specialized) constexpr explicit
  operator Number() const {
    return static_cast<Number>(value_);
  }
  constexpr explicit operator __float128() const { return value_; }

  friend constexpr Quad operator+(Quad a, Quad b) { return a.value_ + b.value_; }
  friend constexpr Quad operator-(Quad a, Quad b) { return a.value_ - b.value_; }
  friend constexpr Quad operator*(Quad a, Quad b) { return a.value_ * b.value_; }
  friend constexpr Quad operator/(Quad a, Quad b) { return a.value_ / b.value_; }
  friend constexpr Quad operator-(Quad a) { return -a.value_; }
  friend constexpr bool operator==(Quad a, Quad b) { return a.value_ == b.value_; }
  friend constexpr bool operator!=(Quad a, Quad b) { return a.value_ != b.value_; }
  friend constexpr bool operator<(Quad a, Quad b) { return a.value_ < b.value_; }
  friend constexpr bool operator<=(Quad a, Quad b) { return a.value_ <= b.value_; }
  friend constexpr bool operator>(Quad a, Quad b) { return a.value_ > b.value_; }
  friend constexpr bool operator>=(Quad a, Quad b) { return a.value_ >= b.value_; }
  constexpr Quad& operator+=(Quad b) { return *this = *this + b; }
  constexpr Quad& operator-=(Quad b) { return *this = *this - b; }
  constexpr Quad& operator*=(Quad b) { return *this = *this * b; }
  constexpr Quad& operator/=(Quad b) { return *this = *this / b; }

  friend Quad sqrt(Quad a) { return sqrtq(a.value_); }
  friend Quad pow(Quad a, Quad b) { return powq(a.value_, b.value_); }
  friend Quad sin(Quad a) { return sinq(a.value_); }
  friend Quad cos(Quad a) { return cosq(a.value_); }
  friend Quad tan(Quad a) { return tanq(a.value_); }
  friend constexpr Quad abs(Quad a) { return a.value_ < 0 ? -a : a; }

 private:
  __float128 value_;
};

}  // namespace plumb

template <>
struct std::numeric_limits<plumb::Quad> {
  static constexpr bool is_specialized = true;
  static constexpr bool is_signed = true;
  static constexpr bool is_integer = false;
  static constexpr bool is_exact = false;
  static constexpr bool is_iec559 = true;
  static constexpr bool has_infinity = true;
  static constexpr bool has_quiet_NaN = true;
  static constexpr int radix = 2;
  static constexpr int digits = 113;
  static constexpr plumb::Quad infinity() { return std::numeric_limits<double>::infinity(); }
  static constexpr plumb::Quad quiet_NaN() { return std::numeric_limits<double>::quiet_NaN(); }
  /// 2^-112
  static constexpr plumb::Quad epsilon() { return plumb::Quad(0x1p-56) * plumb::Quad(0x1p-56); }
};

/// Pi as the sum of three doubles, exact to 2^-161.
template <>
inline constexpr plumb::Quad std::numbers::pi_v<plumb::Quad> =
    plumb::Quad(0x1.921fb54442d18p+1) + plumb::Quad(0x1.1a62633145c07p-53) -
    plumb::Quad(0x1.f1976b7ed8fbcp-109);
