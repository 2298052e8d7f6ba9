// Why a pixel is over the tolerance.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace plumb::attribution {

/// All but the last are matters of chance or of the reference's format, and no fault of either renderer.
enum class Cause {
  silhouette,           ///< the sample lies on the edge of an object or of a face
  shadow_edge,          ///< the point lies on the edge of a shadow, or where n.l is 0
  secondary_edge,       ///< such an edge seen in a mirror or through glass
  coincident,           ///< two surfaces are at one place, and either may be met
  reference_tolerance,  ///< something is nearer to the start of a ray than the reference resolves
  depth,                ///< the reference stopped one ray earlier or later
  quantisation,         ///< the reference holds integers: rounding gives its value exactly
  clamped,              ///< the reference cannot hold more than 1
  undecided,            ///< the scene's last digits leave both values open, see settle_undecided
  unexplained,          ///< none of these: a difference of the model
};
inline constexpr std::size_t cause_count = static_cast<std::size_t>(Cause::unexplained) + 1;

/// How many pixels may be put down to a cause.
enum class CauseBound {
  none,
  lines,       ///< two lines each way, and at most 16 and 5 % of the pixels
  few,         ///< 16 and 1 % of the pixels
  unverified,  ///< 1 % of the pixels, all such causes together: nothing says what colour ours has there
};

/// What is known of a cause beside its proof.
struct CauseRow {
  Cause cause;
  std::string_view name;    ///< as it stands in JSON; in pages a space for each _
  std::string_view colour;  ///< in pages, as CSS has it for a background
  CauseBound bound;
};

/// In the order of the enumeration.
const std::array<CauseRow, cause_count>& cause_rows();
const CauseRow& row_of(Cause cause);

/// As it stands in JSON, e.g. "shadow_edge".
const char* to_string(Cause cause);

}  // namespace plumb::attribution
