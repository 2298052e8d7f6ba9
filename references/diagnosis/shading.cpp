#include "references/diagnosis/shading.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string_view>

#include "references/diagnosis/search.hpp"

namespace plumb::diagnosis {
namespace {

/// A fault that is left out, or most of a tracer, which explains more than one of its details.
bool is_missing_feature(const faults::Fault& fault) { return fault.catalogue == 38; }

/// What a fault costs in misfit. What is missing is asked for first, because tracers have that most.
double price_of(const faults::Fault& fault) {
  constexpr double least = 0.003;
  if (is_missing_feature(fault)) return least;
  return least + 0.0005 + 0.002 / (1 + count_of(fault));
}

bool may_be_of_shading(const faults::Fault& fault) {
  constexpr int pixel_corner = 4, distance_truncated = 8;  // they show at edges, which are left out
  return !is_of_geometry(fault) && fault.catalogue != pixel_corner && fault.catalogue != distance_truncated;
}

/// The faults that may be named: one of a family stands for the fault of the catalogue with its name.
std::vector<std::size_t> faults_of_the_shading() {
  std::set<std::string_view> families;
  for (const faults::Fault& fault : faults::shading_families()) families.insert(fault.id);
  const std::size_t formulas = faults::fault_catalogue().size();
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < formulas; ++i) {
    if (may_be_of_shading(fault_at(i)) && families.count(fault_at(i).id) == 0) all.push_back(i);
  }
  for (std::size_t i = formulas + faults::geometry_families().size(); i < number_of_faults(); ++i)
    all.push_back(i);
  return all;
}

/// Half of the places evenly spread, half of them as many of each surface. Kinds are mixed, so that a first
/// part has all of them.
std::vector<PixelPlace> sample_of(const std::vector<SurfaceSeen>& surfaces) {
  constexpr std::size_t places = 1200;
  std::map<std::uint32_t, std::vector<PixelPlace>> by_surface;
  for (const SurfaceSeen& seen : surfaces) by_surface[seen.surface].push_back(seen.place);
  const std::size_t half = std::min(places / 2, surfaces.size());
  std::vector<PixelPlace> sample;
  for (std::size_t i = 0; i < half; ++i)
    sample.push_back(surfaces[(2 * i + 1) * surfaces.size() / (2 * half)].place);
  for (std::size_t round = 0; sample.size() < 2 * half; ++round) {
    // Steps of the golden ratio spread the places of a surface, however many are taken.
    constexpr double golden = 0.6180339887498949;
    const double at = std::fmod(0.5 + golden * static_cast<double>(round), 1.0);
    for (const auto& [surface, all] : by_surface)
      sample.push_back(all[static_cast<std::size_t>(at * static_cast<double>(all.size()))]);
  }
  std::vector<PixelPlace> mixed;
  for (std::size_t i = 0; i < half; ++i) {
    mixed.push_back(sample[(i * 7919) % half]);  // a prime, so that it visits all
    mixed.push_back(sample[half + i]);
  }
  return mixed;
}

/// What a fault does to the surfaces beside others.
struct Effect {
  std::size_t changed = 0;  ///< pixels
  std::size_t righted = 0;
  std::size_t spoilt = 0;
};

class ShadingSearch {
 public:
  ShadingSearch(Evidence& evidence, const FaultSet& camera, const SurfacesSeen& surfaces)
      : evidence_(evidence),
        camera_(camera),
        candidates_(faults_of_the_shading()),
        pixels_of_place_(surfaces.pixels_of_place) {
    for (const SurfaceSeen& one : surfaces.places) places_.push_back(one.place);
    evidence_.look_at(sample_of(surfaces.places));
  }

  Shading found() const {
    if (places_.empty()) return {{}, camera_, 0};
    Fit best = climbed();
    const std::map<std::size_t, Effect> effects = without_idle(best);
    const double right = share_right(best);
    // because with more left, faults were named that soaked up what others caused
    constexpr double least_right = 0.75;
    if (right < least_right) return {{}, camera_, share_right(fit(camera_))};
    Shading shading{{}, best.set, right};
    for (const auto& [fault, effect] : effects) add_fault(best, fault, effect, shading);
    std::stable_sort(shading.faults.begin(), shading.faults.end(),
                     [](const FoundFault& a, const FoundFault& b) { return a.pixels > b.pixels; });
    return shading;
  }

 private:
  Fit fit(const FaultSet& set) const { return evidence_.fit(set, evidence_.pixels()); }

  bool is_over() const {
    constexpr double most_work = 0.5;
    return evidence_.is_over(most_work);
  }

  bool is_of_camera(std::size_t fault) const {
    return std::binary_search(camera_.begin(), camera_.end(), fault);
  }

  /// True if neither the fault nor another of its family is in the set.
  static bool is_free(std::size_t fault, const FaultSet& set) {
    return std::none_of(set.begin(), set.end(),
                        [&](std::size_t other) { return fault_at(other).id == fault_at(fault).id; });
  }

  static double cost(const Fit& fit) {
    double cost = fit.misfit;
    for (const faults::Fault* fault : faults_of(fit.set)) cost += price_of(*fault);
    return cost;
  }

  std::vector<Fit> best_of(const std::set<FaultSet>& sets) const {
    constexpr std::size_t looked_at_again = 16;
    const std::size_t at_first = evidence_.pixels() / 5;
    const auto sort = [](std::vector<Fit>& fits) {
      std::stable_sort(fits.begin(), fits.end(),
                       [](const Fit& a, const Fit& b) { return cost(a) < cost(b); });
    };
    std::vector<Fit> fits;
    for (const FaultSet& set : sets) {
      if (is_over()) break;
      fits.push_back(evidence_.fit(set, at_first));
    }
    sort(fits);
    fits.resize(std::min(fits.size(), looked_at_again));
    for (Fit& one : fits) one = fit(one.set);
    sort(fits);
    return fits;
  }

  /// Adds one fault at a time to the best few sets, and exchanges those of the best.
  Fit climbed() const {
    constexpr std::size_t kept = 4, most_named = 5;
    std::vector<Fit> beam{fit(camera_)};
    Fit best = beam.front();
    for (std::size_t named = 0; named < most_named; ++named) {
      std::set<FaultSet> sets;
      for (const Fit& from : beam) {
        for (const std::size_t fault : candidates_)
          if (is_free(fault, from.set)) sets.insert(with(from.set, fault));
      }
      beam = best_of(sets);
      // because float and double disagree in some pixels, and what is left may look like anything
      const double least = 0.004 + 0.02 * best.misfit;
      if (beam.empty() || beam.front().misfit >= best.misfit - least) break;
      beam.resize(std::min(beam.size(), kept));
      best = beam.front() = exchanged(beam.front());
    }
    return best;
  }

  /// Takes out what is not needed, and exchanges faults for those that do better.
  Fit exchanged(Fit best) const {
    for (bool improves = true; improves && !is_over();) {
      std::set<FaultSet> sets;
      for (const std::size_t fault : best.set) {
        if (is_of_camera(fault)) continue;
        const FaultSet rest = without(best.set, fault);
        sets.insert(rest);
        for (const std::size_t other : candidates_)
          if (other != fault && is_free(other, rest)) sets.insert(with(rest, other));
      }
      const std::vector<Fit> fits = best_of(sets);
      improves = !fits.empty() && cost(fits.front()) < cost(best);
      if (improves) best = fits.front();
    }
    return best;
  }

  std::vector<bool> right_at(const Fit& fit, const std::vector<PixelPlace>& places) const {
    constexpr float one_level = 1.01F;  // because a tracer rounds as it likes
    std::vector<bool> right;
    for (const float d : evidence_.differences_at(fit, places)) right.push_back(d <= one_level);
    return right;
  }

  double share_right(const Fit& fit) const {
    const auto right = right_at(fit, places_);
    return static_cast<double>(std::count(right.begin(), right.end(), true)) /
           static_cast<double>(right.size());
  }

  Effect effect_of(std::size_t fault, const Fit& best) const {
    const Fit rest = fit(without(best.set, fault));
    const auto with_it = right_at(best, places_), without_it = right_at(rest, places_);
    const std::vector<float> after = evidence_.colours(best.set, places_);
    const std::vector<float> before = evidence_.colours(rest.set, places_);
    Effect effect;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      bool is_changed = false;
      for (std::size_t c = 0; c < 3; ++c) {
        const float apart =
            best.encoding.level(after[3 * i + c], c) - best.encoding.level(before[3 * i + c], c);
        is_changed = is_changed || !(std::abs(apart) <= 1);
      }
      effect.changed += is_changed ? 1 : 0;
      effect.righted += with_it[i] && !without_it[i] ? 1 : 0;
      effect.spoilt += !with_it[i] && without_it[i] ? 1 : 0;
    }
    return effect;
  }

  /// True if what the fault makes right is many pixels, and most of what it changes.
  bool earns_its_name(const Effect& effect) const {
    constexpr double most_of_changed = 0.6;
    constexpr double few = 0.02;           // of the surfaces
    constexpr std::size_t speckles = 400;  // pixels, because slivers and rounding may have any cause
    constexpr double righted_a_spoilt = 10;
    const auto righted = static_cast<double>(effect.righted);
    return effect.righted * pixels_of_place_ >= speckles &&
           righted >= few * static_cast<double>(places_.size()) &&
           righted >= most_of_changed * static_cast<double>(effect.changed) &&
           righted > righted_a_spoilt * static_cast<double>(effect.spoilt);
  }

  /// Takes out faults until each of the others earns its name. Returns what these do.
  std::map<std::size_t, Effect> without_idle(Fit& best) const {
    for (;;) {
      std::map<std::size_t, Effect> effects;
      std::optional<std::size_t> idle;
      for (const std::size_t fault : best.set) {
        if (is_of_camera(fault)) continue;
        effects[fault] = effect_of(fault, best);
        if (!idle && !earns_its_name(effects[fault])) idle = fault;
      }
      if (!idle) return effects;
      best = fit(without(best.set, *idle));
    }
  }

  /// Returns the faults that make about as many pixels right in the place of one, of other families.
  std::vector<const faults::Fault*> alike(const Fit& best, std::size_t fault) const {
    const FaultSet rest = without(best.set, fault);
    const Fit without_it = fit(rest);
    // because the sample has chance in it
    constexpr double nearly = 0.1;
    const double most = best.misfit + nearly * (without_it.misfit - best.misfit);
    std::vector<const faults::Fault*> found;
    for (const std::size_t other : candidates_) {
      if (!is_free(other, best.set) || fit(with(rest, other)).misfit > most) continue;
      const faults::Fault* const same_family = &fault_at(other);
      if (std::none_of(found.begin(), found.end(),
                       [&](const faults::Fault* f) { return f->id == same_family->id; }))
        found.push_back(same_family);
    }
    return found;
  }

  /// Names the fault, unless another mistake explains as much while something else is left open.
  void add_fault(const Fit& best, std::size_t fault, const Effect& effect, Shading& shading) const {
    constexpr std::size_t most_alike = 3;
    constexpr double confidence = 0.95;  // below 1, because not all of the picture is explained
    FoundFault found{&fault_at(fault), 0, effect.righted * pixels_of_place_, alike(best, fault),
                     effect.changed * pixels_of_place_};
    const bool is_one_mistake =
        std::all_of(found.alike.begin(), found.alike.end(),
                    [&](const faults::Fault* other) { return other->catalogue == found.fault->catalogue; });
    constexpr double nearly_all = 0.95;
    if (found.alike.size() > most_alike || (!is_one_mistake && shading.right < nearly_all)) return;
    found.confidence = confidence * shading.right / static_cast<double>(1 + found.alike.size());
    shading.faults.push_back(found);
  }

  Evidence& evidence_;
  FaultSet camera_;
  std::vector<std::size_t> candidates_;
  std::vector<PixelPlace> places_;  ///< that show surfaces
  std::size_t pixels_of_place_;     ///< number that a place stands for
};

}  // namespace

Shading shading_of(Evidence& evidence, const FaultSet& camera, const SurfacesSeen& surfaces) {
  return ShadingSearch(evidence, camera, surfaces).found();
}

}  // namespace plumb::diagnosis
