#include "references/attribution/causes.hpp"

namespace plumb::attribution {
namespace {

constexpr std::array<CauseRow, cause_count> rows{{
    {Cause::silhouette, "silhouette", "#4e79a7", CauseBound::lines},
    {Cause::shadow_edge, "shadow_edge", "#59a14f", CauseBound::lines},
    {Cause::secondary_edge, "secondary_edge", "#76b7b2", CauseBound::lines},
    {Cause::coincident, "coincident", "#b07aa1", CauseBound::unverified},
    {Cause::reference_tolerance, "reference_tolerance", "#9c755f", CauseBound::unverified},
    {Cause::depth, "depth", "#edc948", CauseBound::few},
    {Cause::quantisation, "quantisation", "#f28e2b", CauseBound::none},
    {Cause::clamped, "clamped", "#bab0ac", CauseBound::none},
    {Cause::undecided, "undecided", "#d37295", CauseBound::unverified},
    {Cause::unexplained, "unexplained", "repeating-linear-gradient(135deg, #e03546 0 3px, #8f0f1d 3px 5px)",
     CauseBound::none},
}};

constexpr bool are_in_order() {
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].cause != static_cast<Cause>(i)) return false;
  return true;
}
static_assert(are_in_order());

}  // namespace

const std::array<CauseRow, cause_count>& cause_rows() { return rows; }

const CauseRow& row_of(Cause cause) { return rows.at(static_cast<std::size_t>(cause)); }

const char* to_string(Cause cause) { return row_of(cause).name.data(); }

}  // namespace plumb::attribution
