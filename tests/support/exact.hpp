// Rational arithmetic, which does not round, for what one ray meets; and rays to try.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <random>

#include "tracer/formulas/quad.hpp"
#include "tracer/formulas/ray.hpp"

namespace plumb::tests {

using Exact = boost::multiprecision::cpp_rational;
using Vec3d = Vec3<double>;

/// A 113-bit number is the sum of three doubles.
inline Exact exact(Quad value) {
  Exact sum = 0;
  for (int part = 0; part < 3; ++part) {
    const auto rounded = static_cast<double>(value);
    sum += Exact(rounded);
    value -= rounded;
  }
  return sum;
}

struct Exact3 {
  explicit Exact3(const Vec3d& v) : at{Exact(v.x), Exact(v.y), Exact(v.z)} {}
  Exact at[3];
};

inline Exact dot(const Exact3& a, const Exact3& b) {
  return a.at[0] * b.at[0] + a.at[1] * b.at[1] + a.at[2] * b.at[2];
}

struct Line {
  Vec3d origin;
  Vec3d direction;
};

inline Ray<Quad> in_quad(const Line& line) { return {Vec3<Quad>(line.origin), Vec3<Quad>(line.direction)}; }

/// Numbers with all their 53 bits.
class Random {
 public:
  explicit Random(unsigned seed) : random_(seed) {}

  double real(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
  int whole(int low, int high) { return std::uniform_int_distribution(low, high)(random_); }
  double size(double least, double most) { return std::exp(real(std::log(least), std::log(most))); }
  Vec3d vector(double most) { return {real(-most, most), real(-most, most), real(-most, most)}; }
  Vec3d wholes(int most) { return Vec3d(whole(-most, most), whole(-most, most), whole(-most, most)); }

 private:
  std::mt19937 random_;
};

/// Counts of what a test met, so that it cannot pass by meeting nothing.
struct Met {
  int hits = 0;
  int misses = 0;
  int tangents = 0;
};

}  // namespace plumb::tests
