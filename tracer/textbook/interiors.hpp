// Nested dielectrics: the media that a ray is inside of.
#pragma once

#include <algorithm>
#include <vector>

#include "tracer/textbook/shape.hpp"

namespace plumb::textbook {

/// A stack of the transmissive instances that were entered and not yet left; below all lies the void with eta
/// 1. Entering one bends by top.eta / new.eta. Leaving the top one bends by eta / below.eta; leaving another
/// does not bend. The stack alone decides whether a surface is entered or left.
template <class Real>
class Interiors {
 public:
  /// Crosses the surface of an instance and returns eta of the side left over eta of the side reached.
  Real cross(InstanceId instance, Real eta) {
    const auto known =
        std::find_if(stack_.rbegin(), stack_.rend(), [&](const Medium& m) { return m.instance == instance; });
    if (known == stack_.rend()) {
      const Real outside = top_eta();
      stack_.push_back({instance, eta});
      return outside / eta;
    }
    const bool was_top = known == stack_.rbegin();
    stack_.erase(std::next(known).base());
    return was_top ? eta / top_eta() : Real(1);
  }

 private:
  struct Medium {
    InstanceId instance;
    Real eta;
  };

  Real top_eta() const { return stack_.empty() ? Real(1) : stack_.back().eta; }

  std::vector<Medium> stack_;
};

}  // namespace plumb::textbook
