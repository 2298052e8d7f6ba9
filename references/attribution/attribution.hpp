// The pixel budget: every pixel over the tolerance gets exactly one cause, which tracing it again has proven.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "references/attribution/causes.hpp"
#include "references/comparison/comparison.hpp"
#include "references/renderers/holds.hpp"
#include "references/renderers/resolution.hpp"
#include "tracer/scene/shot.hpp"

namespace plumb::attribution {

struct AttributedPixel {
  int x;
  int y;
  Cause cause;
};

struct Budget {
  std::vector<AttributedPixel> pixels;  ///< all that are over, row by row
  std::vector<std::string> shapes;      ///< names of those whose move alone changes an edge or a coincidence
  std::size_t unexamined = 0;           ///< number of unexplained ones that were not tried to the end

  std::size_t count(Cause cause) const;
  /// Where the reference shows another surface than ours, or another shadow, because two are nearer to each
  /// other than it resolves, and where both values are open: nobody but us said what colour our surface has
  /// there. (At an edge the pixels beside it say so.)
  std::size_t unverified() const;
  std::size_t explained() const { return pixels.size() - count(Cause::unexplained); }
};

/// What a budget is made from. The scene is as read_scene returns it; both pictures have the shot's size.
struct AttributionJob {
  Shot shot;
  const Image& reference;
  const Image& test;
  double tolerance;                                    ///< as in compare()
  const renderers::Resolution& resolution;             ///< of what made the reference
  renderers::Holds holds = renderers::Holds::float32;  ///< the reference
  double work = 2.5e8;  ///< units of Work that are spent at most, about 5 s; a fifth more to name the shapes
};

/// Finds the cause of every pixel over the tolerance.
/// An edge, a coincidence or the reference's tolerance is proven when three things hold. Moving surfaces by a
/// distance that the reference does not resolve (see Perturbation) makes the traced pixel jump, by more than
/// the tolerance and 1e3 times the move (in shares of the extent). One of the outcomes is the reference's
/// value and another one the test's, each within the tolerance. The ray trees of these two have another hit,
/// light or ray; their first difference names the cause.
/// Depth is proven when the test's value is traced, one ray more or less gives the reference's, which is
/// another one, and the ray trees part at the limit. Against a baseline it is no excuse. Rounding is proven
/// by making it, clamping by tracing the test's value, too.
/// Pixels with more rays than are traced (see TreeTracer) and non-finite ones are never explained. Of more
/// than 2,000 pixels 256 are tried first. When one of them has no cause, the verdict is settled, and the
/// others are unexamined. So are those that are left when the work (see Work) is done.
Budget attribute(const AttributionJob& job);

/// More pixels than chance gives: put down to this cause, or unverified where there is none.
struct BrokenBound {
  std::optional<Cause> cause;
  std::size_t found;
  std::size_t allowed;
};

/// The bound that is broken; nothing when all hold. An edge meets pixel centres by chance at
/// some points, or along a line when it runs along the pixels: two lines each way, and at most 16 and 5 % of
/// the pixels, are allowed for each kind of edge. Of the pixels where rays end at the depth limit, 16 and
/// 1 %: more would be seen, and be the model. Of the picture 1 % may be unverified. Quantised values are each
/// reproduced exactly, so these have no bound.
std::optional<BrokenBound> broken_bound(const Budget& budget, int width, int height);

}  // namespace plumb::attribution
