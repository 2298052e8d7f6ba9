// Why methods fail under one condition and not under another.
#include <algorithm>
#include <string_view>
#include <vector>

#include "references/studies/stability/catalogue.hpp"

namespace plumb::studies::stability {
namespace {

/// Explains all methods whose id begins like this, unless a line above fits.
struct Explanation {
  std::string_view condition, method, cause, remedy;
};

constexpr std::string_view wider = "a wider real type, or coordinates near the object";
constexpr std::string_view by_id = "exclude the surface by its id";
constexpr std::string_view scaled = "export the scene scaled";
constexpr std::string_view judge = "no scale fits both sizes: judge the pixels by 113 bits";
constexpr std::string_view own_space = "tolerances hold in the object's own space, which is stretched";
constexpr std::string_view longer = "1e-4 is as long as the chord: the far side is passed by";
constexpr std::string_view why_farther =
    "the point lies more than 1e-4 beside the surface, as large coordinates do";
constexpr std::string_view resolved = "the chord is shorter than the resolution of t at such coordinates";

const std::vector<Explanation>& explanations() {
  static const std::vector<Explanation> all{
      {"", "embree-secondary", "from tnear = 0 a ray meets the surface that it leaves",
       "tnear beyond the error bound, or a filter on the id"},
      {"distance", "povray-rescaled", "one scale holds eye and ball: the ball falls below the tolerances",
       judge},
      {"distance", "povray", "boxes around objects are float32, and spheres vanish past 1e7 units", scaled},
      {"distance", "start-epsilon", why_farther, by_id},
      {"distance", "start-normal", why_farther, by_id},
      {"distance", "lecture", "the direction is rounded by more than the ball is wide", "a wider real type"},
      {"distance", "sphere-haines", "the direction is rounded by more than the ball is wide",
       "a wider real type"},
      {"distance", "embree", "the direction is rounded by more than the ball is wide", "a wider real type"},
      {"small-radius", "povray-rescaled", "one scale holds eye and ball: the ball falls below the tolerances",
       judge},
      {"small-radius", "povray", "the ball is smaller than the tolerance of the nearest hit, 1e-4", scaled},
      {"small-radius", "start-id", resolved, wider},
      {"small-radius", "start-epsilon", longer, by_id},
      {"small-radius", "start-normal", longer, by_id},
      {"small-radius", "start-waechter", "256 ulp of the coordinates are as long as the chord", wider},
      {"small-radius", "start-error", "the point's error bound is as long as the chord", wider},
      {"small-radius", "lecture", "centre and direction are rounded by more than the ball is wide", wider},
      {"small-radius", "sphere-haines", "centre and direction are rounded by more than the ball is wide",
       wider},
      {"small-radius", "embree", "centre and direction are rounded by more than the ball is wide", wider},
      {"scale-up", "povray", "spheres vanish past 1e7 units", scaled},
      {"scale-up", "start-epsilon", why_farther, by_id},
      {"scale-up", "start-normal", why_farther, by_id},
      {"scale-down", "povray", "depth 1e-6, nearest hit 1e-4 and shadow 1e-3 are as large as the scene",
       scaled},
      {"scale-down", "start-epsilon", longer, by_id},
      {"scale-down", "start-normal", longer, by_id},
      {"scale-down", "start-waechter", "near the origin it moves by at least 1/65536, more than the chord",
       by_id},
      {"offset", "povray", "boxes around objects are float32: far off the origin they lose parts", scaled},
      {"offset", "start-id", resolved, wider},
      {"offset", "start-epsilon", why_farther, by_id},
      {"offset", "start-normal", why_farther, by_id},
      {"offset", "start-waechter", "256 ulp of the coordinates are as long as the chord", wider},
      {"offset", "start-error", "the point's error bound is as long as the chord", wider},
      {"offset", "", "coordinates are spaced as wide as the ball", "coordinates near the object"},
      {"grazing", "sphere", "both roots lie together: a rounding of the discriminant is its root wide",
       "take the discriminant from the centre's distance to the line"},
      {"box-aspect", "box-ize", "2 ulp do not cover a rounded reciprocal times a rounded difference",
       "4 ulp, or divide"},
      {"box-aspect", "box", "distances to both sides of the plate are rounded into the wrong order",
       "widen the far side by 2 ulp"},
      {"box-aspect", "lecture", "distances to both sides of the plate are rounded into the wrong order",
       "widen the far side by 2 ulp"},
      {"box-edge", "lecture", "the aim lies nearer to the edge than distances are rounded",
       "widen the far side by 2 ulp"},
      {"flattening", "povray", own_space, judge},
      {"flattening", "embree", "the inverse enlarges the rounding of the ray by the flattening", "doubles"},
      {"flattening", "lecture", "the inverse enlarges the rounding of the ray by the flattening",
       "a wider real type"},
      {"condition-number", "povray", own_space, judge},
      {"condition-number", "embree", "the inverse enlarges the rounding of the ray by the condition number",
       "doubles"},
      {"condition-number", "lecture", "the inverse enlarges the rounding of the ray by the condition number",
       "a wider real type"},
      {"condition-number", "direction",
       "the inverse enlarges the rounding of the ray by the condition number", "a wider real type"},
      {"nesting", "", "rounding of every matrix adds up", "a wider real type for the product"},
      {"thin-glass", "povray-rescaled", "even scaled, the pane is thinner than the nearest hit's 1e-4",
       judge},
      {"thin-glass", "povray", "the far side of a pane thinner than 1e-4 is passed by", scaled},
      {"thin-glass", "lecture", "the pane is thinner than the resolution of t", wider},
      {"gap", "povray-rescaled", "even scaled, the gap is narrower than the nearest hit's 1e-4", judge},
      {"gap", "povray", "a floor less than 1e-4 under the glass is passed by", scaled},
      {"gap", "lecture", "the gap is narrower than the resolution of t: both surfaces are one place", wider},
  };
  return all;
}

}  // namespace

void explain(const std::string& condition, Method& method) {
  const auto found = std::find_if(explanations().begin(), explanations().end(), [&](const Explanation& e) {
    return (e.condition.empty() || e.condition == condition) && method.id.starts_with(e.method);
  });
  if (found == explanations().end()) return;
  method.cause = found->cause;
  method.remedy = found->remedy;
}

}  // namespace plumb::studies::stability
