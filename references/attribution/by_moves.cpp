#include "references/attribution/by_moves.hpp"

#include <algorithm>

#include "references/attribution/divergence.hpp"
#include "references/attribution/shapes_that_take_part.hpp"

namespace plumb::attribution {
namespace {

constexpr double smallest_jump = 1e3;  // times the move: a smooth pixel changes by far less
constexpr int most_patterns = 4096;    // for pixels that vary: many ties in one ray tree have many outcomes

/// One pixel over the tolerance and what has been proven about it so far.
struct Suspect {
  AttributedPixel* pixel;
  Colour unmoved;
  bool varies = false;  ///< moving surfaces makes it jump
  // The patterns whose outcomes are the two pictures' values, and what their ray trees differ in.
  std::optional<int> as_test{};
  std::optional<int> as_reference{};
  Colour of_test{};
  Colour of_reference{};
  std::optional<Cause> cause{};

  bool is_proven() const { return varies && cause; }
};

class Moves {
 public:
  explicit Moves(const Inquiry& inquiry) : inquiry_(inquiry), job_(inquiry.job()) {}

  std::set<ShapeId> explain(const SuspectPixels& pixels) const {
    std::vector<Suspect> all = suspects(pixels);
    for (int pattern = 0; pattern < most_patterns && !inquiry_.work().is_over(); ++pattern) {
      if (pattern == usual_patterns) std::erase_if(all, [](const Suspect& s) { return !s.varies; });
      if (std::all_of(all.begin(), all.end(), [](const Suspect& s) { return s.is_proven(); })) break;
      const std::shared_ptr<const PixelTracer> moved = inquiry_.moved_by(pattern);
      for (Suspect& s : all) {
        if (!s.is_proven() && !inquiry_.work().is_over()) try_pattern(pattern, *moved, s);
      }
    }
    std::set<ShapeId> found = shapes_that_take_part(inquiry_, proven_of(all));
    for (const Suspect& s : all) {
      // Whatever it is when no shape takes part, it is no matter of where surfaces are.
      if (s.is_proven() && (!found.empty() || s.cause == Cause::reference_tolerance))
        s.pixel->cause = *s.cause;
    }
    return found;
  }

 private:
  std::vector<Suspect> suspects(const SuspectPixels& pixels) const {
    std::vector<Suspect> all;
    for (AttributedPixel* const p : pixels) {
      if (inquiry_.work().is_over()) break;
      const std::optional<Colour> unmoved = inquiry_.still().at(*p);
      if (!unmoved) continue;
      Suspect& s = all.emplace_back(Suspect{p, *unmoved});
      try_outcome(no_pattern, s.unmoved, s);
    }
    return all;
  }

  static std::vector<ProvenPixel> proven_of(const std::vector<Suspect>& all) {
    std::vector<ProvenPixel> proven;
    for (const Suspect& s : all) {
      if (s.is_proven()) proven.push_back({s.pixel, s.unmoved, *s.as_test, *s.as_reference});
    }
    return proven;
  }

  void try_pattern(int pattern, const PixelTracer& moved, Suspect& s) const {
    const std::optional<Colour> outcome = moved.at(*s.pixel);
    if (!outcome) return;
    s.varies = s.varies || !comparison::is_within(s.unmoved.data(), outcome->data(),
                                                  std::max(job_.tolerance, jump_of(pattern)));
    try_outcome(pattern, *outcome, s);
  }

  /// Whether the outcome is what one of the pictures shows; when both are found, their rays tell the cause.
  void try_outcome(int pattern, const Colour& outcome, Suspect& s) const {
    const auto shows = [&](const float* picture, std::optional<int>& as, Colour& of) {
      if (as || !comparison::is_within(picture, outcome.data(), job_.tolerance)) return;
      as = pattern;
      of = outcome;
      if (!s.as_test || !s.as_reference) return;
      // Two outcomes that are hardly apart, or have the same rays, are no matter of chance.
      if (!comparison::is_within(s.of_test.data(), s.of_reference.data(), jump_of(pattern)))
        s.cause = divergence(s);
      if (!s.cause) as.reset();
    };
    shows(inquiry_.test(*s.pixel), s.as_test, s.of_test);
    shows(inquiry_.reference(*s.pixel), s.as_reference, s.of_reference);
  }

  /// What a smooth pixel never changes by when surfaces move as in this pattern, and half the tolerance: the
  /// two values are more than the tolerance apart, and each outcome is nearly one of them.
  double jump_of(int pattern) const {
    const double factor = pattern == no_pattern ? 1e-3 : Perturbation::factor(pattern);
    return std::max(job_.tolerance / 2, factor * smallest_jump * job_.resolution.step);
  }

  std::optional<Cause> divergence(const Suspect& s) const {
    return first_divergence(inquiry_.tree(*s.as_test, *s.pixel), inquiry_.tree(*s.as_reference, *s.pixel),
                            inquiry_.perturbation().extent(), job_.resolution);
  }

  const Inquiry& inquiry_;
  const AttributionJob& job_;
};

}  // namespace

std::set<ShapeId> explain_by_moves(const Inquiry& inquiry, const SuspectPixels& pixels) {
  return Moves(inquiry).explain(pixels);
}

}  // namespace plumb::attribution
