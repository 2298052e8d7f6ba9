// The lecture's formulas, as far as a reference resolves them.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <random>

#include "tracer/image/pixel_place.hpp"
#include "tracer/textbook/formula_table.hpp"

namespace plumb::attribution {

/// What does not resolve is 0: then an entry is the lecture's. Entries are members: they know lengths, and
/// one takes chances.
struct PerturbedTable : textbook::FormulaTable<double> {
  double touched_edge = 0;     ///< of the way to a box
  double nearest_blocker = 0;  ///< in world lengths
  double nearest_hit = 0;      ///< in world lengths
  std::uint32_t pattern = 0;

  /// Chances are the same for a pattern and a pixel every time.
  void begin_pixel(const PixelPlace& place) const {
    chance_.seed(pattern * 7919U + static_cast<std::uint32_t>(place.y) * 104729U +
                 static_cast<std::uint32_t>(place.x) + 1U);
  }

  // These hide the entries of the table.

  /// Where a ray only touches the edge of a box, it enters and leaves at once: this takes the face it leaves
  /// by.
  std::optional<FaceHit<double>> intersect_box(const Ray<double>& ray, const Corners<double>& box,
                                               Face start) const {
    const auto hit = formulas::intersect_box(ray, box, start);
    if (touched_edge == 0 || !hit || start != no_face) return hit;
    const auto leaving =
        formulas::intersect_box({formulas::point_at(ray, hit->t), ray.direction}, box, hit->face);
    return leaving && leaving->t <= touched_edge * hit->t ? FaceHit<double>{hit->t, leaving->face} : *hit;
  }
  /// What is as near to the lit point, or to the light, as that is taken for the surface itself, or the
  /// light.
  bool blocks_light(double t, double light_distance) const {
    return t > nearest_blocker && t < light_distance - nearest_blocker;
  }
  /// What is as near to the start of a ray is not met at all: of surfaces that coincide one is crossed.
  bool is_ahead(double t, double rounding) const { return t > rounding && t > nearest_hit; }
  /// Of two hits that are as near to each other either is taken, each time by chance.
  bool is_nearer(double t, double nearest, double one_place) const {
    if (nearest_hit == 0) return formulas::is_nearer(t, nearest, one_place);
    return std::abs(t - nearest) <= nearest_hit ? (chance_() & 1U) != 0 : t < nearest;
  }

 private:
  mutable std::minstd_rand chance_;
};

/// For the textbook tracer.
struct PerturbedFormulas {
  const PerturbedTable* operator->() const { return &table; }
  PerturbedTable table;
};

}  // namespace plumb::attribution
