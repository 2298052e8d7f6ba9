// Nested dielectrics: the media that rays are inside of.
#pragma once

#include <cstdint>
#include <vector>

namespace plumb::engine {

/// Many stacks of transmissive instances, which share their lower parts. A stack is the number of its top.
/// The rules are those of textbook::Interiors: entering pushes, leaving the top bends, leaving another does
/// not.
template <class Real>
class Interiors {
 public:
  static constexpr std::int32_t nothing = -1;

  struct Crossed {
    std::int32_t interior;  ///< the stack beyond the surface
    Real ratio;             ///< eta of the side left over eta of the side reached
  };

  std::int32_t entered(std::int32_t stack, std::uint64_t instance, Real eta) {
    media_.push_back({instance, eta, stack});
    return static_cast<std::int32_t>(media_.size()) - 1;
  }

  Crossed cross(std::int32_t stack, std::uint64_t instance, Real eta) {
    if (!contains(stack, instance)) return {entered(stack, instance, eta), eta_of(stack) / eta};
    const auto beyond = without(stack, instance);
    const bool was_top = at(stack).instance == instance;
    return {beyond, was_top ? eta / eta_of(beyond) : Real(1)};
  }

  std::size_t size() const { return media_.size(); }
  /// Forgets all stacks that were made since size() returned this.
  void shrink(std::size_t size) { media_.resize(size); }

 private:
  struct Medium {
    std::uint64_t instance;
    Real eta;
    std::int32_t below;
  };

  Medium at(std::int32_t stack) const { return media_[static_cast<std::size_t>(stack)]; }
  Real eta_of(std::int32_t stack) const { return stack == nothing ? Real(1) : at(stack).eta; }

  bool contains(std::int32_t stack, std::uint64_t instance) const {
    for (; stack != nothing; stack = at(stack).below) {
      if (at(stack).instance == instance) return true;
    }
    return false;
  }

  std::int32_t without(std::int32_t stack, std::uint64_t instance) {
    std::vector<Medium> above;
    for (; at(stack).instance != instance; stack = at(stack).below) above.push_back(at(stack));
    std::int32_t rest = at(stack).below;
    for (auto medium = above.rbegin(); medium != above.rend(); ++medium)
      rest = entered(rest, medium->instance, medium->eta);
    return rest;
  }

  std::vector<Medium> media_;
};

}  // namespace plumb::engine
