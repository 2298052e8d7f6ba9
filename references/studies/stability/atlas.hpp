// The atlas of failures: where each method breaks, under which condition, in which real type.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace plumb::studies::stability {

/// The first value of the condition at which it happens to any ray; nothing when it does not within the
/// sweep.
struct Breaks {
  std::optional<double> missed;       ///< a hit is lost
  std::optional<double> ulp16;        ///< t is off by more than 16 ulp
  std::optional<double> e6;           ///< ... by more than 1e-6 of it
  std::optional<double> percent;      ///< ... by more than 1 %
  std::optional<double> self_shadow;  ///< a surface meets itself

  bool any() const { return missed || ulp16 || e6 || percent || self_shadow; }
};

struct Row {
  std::string method, real, source;
  Breaks breaks;
  std::string cause, remedy;  ///< one line each
  /// Value and largest relative error: 1 for a lost or false hit, NaN where the rounding of the inputs left
  /// no true hit to ask for.
  std::vector<std::pair<double, double>> curve;
  std::vector<std::pair<double, double>> wrong;  ///< value, share of rays or pixels that are wrong
  std::string measures;                          ///< "t", "direction" or "point" of rays, or "pixels"
  std::string unavailable;                       ///< why nothing was measured: a renderer is missing
};

struct Condition {
  std::string name, unit;
  double last;  ///< of the sweep, which begins at 1
  std::vector<Row> rows;
};

struct Sweep {
  bool quick = false;
  std::string condition;  ///< the only one; empty: all
  std::function<void(double)> progress;
  std::string cache;  ///< directory for finished rows; empty: none are kept
};

/// Sweeps and returns the conditions. Throws std::invalid_argument, naming the known ones, when there is none
/// of that name. The same sweep gives the same numbers.
std::vector<Condition> stability(const Sweep& sweep);

}  // namespace plumb::studies::stability
