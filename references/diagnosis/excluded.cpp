#include "references/diagnosis/excluded.hpp"

#include <algorithm>
#include <cstddef>

#include "references/diagnosis/remains.hpp"

namespace plumb::diagnosis {
namespace {

bool knows_the_camera(const Diagnosis& d) {
  return d.verdict != PictureVerdict::unexplained || d.certain.camera == Certainty::right;
}

bool is_named(const Diagnosis& d, const faults::Fault& fault) {
  return std::ranges::any_of(d.faults, [&](const FoundFault& found) {
    return found.fault->id == fault.id || std::ranges::any_of(found.alike, [&](const faults::Fault* other) {
             return other->id == fault.id;
           });
  });
}

/// Pixels that are right with what is named, and what a further fault does to them.
class Pixels {
 public:
  Pixels(const Evidence& evidence, const Diagnosis& d, std::size_t most)
      : evidence_(evidence), encoding_(d.encoding), places_(evidence.survey()) {
    places_.resize(std::min(most, places_.size()));
    std::vector<const faults::Fault*> named;
    for (const FoundFault& found : d.faults) named.push_back(found.fault);
    set_ = set_of(named);
    as_named_ = within(evidence_, set_, encoding_, places_);
  }

  /// Counts the pixels that are right without the fault alone, and those that are right with it alone.
  struct Effect {
    std::size_t lost = 0, gained = 0;
  };
  Effect effect_of(std::size_t fault) const {
    Effect effect;
    if (std::ranges::find(set_, fault) != set_.end()) return effect;
    const std::vector<bool> otherwise = within(evidence_, with(set_, fault), encoding_, places_);
    for (std::size_t i = 0; i < otherwise.size(); ++i) {
      effect.lost += as_named_[i] && !otherwise[i] ? 1 : 0;
      effect.gained += !as_named_[i] && otherwise[i] ? 1 : 0;
    }
    return effect;
  }
  std::size_t count() const { return places_.size(); }

 private:
  const Evidence& evidence_;
  OutputEncoding encoding_;
  std::vector<PixelPlace> places_;
  FaultSet set_;
  std::vector<bool> as_named_;
};

}  // namespace

std::vector<const faults::Fault*> excluded_by(const Evidence& evidence, const Diagnosis& diagnosis) {
  if (!knows_the_camera(diagnosis) || diagnosis.is_of_one_colour) return {};
  // because outlines and roundings are less than a hundredth, and what is lost by chance is gained as often
  constexpr std::size_t one_in = 100, times = 8, some = 200, most = 1000;
  const Pixels first(evidence, diagnosis, some), all(evidence, diagnosis, most);
  std::vector<const faults::Fault*> excluded;
  for (std::size_t i = 0; i < number_of_faults(); ++i) {
    const faults::Fault& fault = fault_at(i);
    if (is_named(diagnosis, fault) || first.effect_of(i).lost == 0) continue;
    const auto [lost, gained] = all.effect_of(i);
    if (lost >= all.count() / one_in && lost > 0 && lost >= times * gained) excluded.push_back(&fault);
  }
  return excluded;
}

}  // namespace plumb::diagnosis
