#include "references/diagnosis/layer_diagnosis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "references/diagnosis/layer_encoding.hpp"
#include "references/diagnosis/search.hpp"
#include "tracer/textbook/sampled_pixels.hpp"

namespace plumb::diagnosis {
namespace {

using textbook::Layer;
using Faults = std::vector<const faults::Fault*>;

constexpr std::size_t most_pixels = 4000;  // because then one in a hundred is 40, far more than chance makes
constexpr std::size_t channels = 3 + 3 + 1 + 3 + 1;  // colour, normal, depth, direction and object
constexpr double least_share = 0.99;  // because outlines and rounding take less than one in a hundred

/// Faults of which a picture of the layer is the same picture turned over.
bool turns_rows(const faults::Fault& fault) { return fault.id == "upside-down"; }
bool turns_columns(const faults::Fault& fault) { return fault.id == "left-right-swapped"; }

/// What a set of faults leaves of the layer.
struct LayerCandidate {
  Faults faults;
  std::string encoding;
  std::size_t unexplained = std::numeric_limits<std::size_t>::max();
  std::vector<float> layers;  ///< as the tracer would have them, at the pixels that were looked at
};

bool is_smaller(const LayerCandidate& a, const LayerCandidate& b) { return a.unexplained < b.unexplained; }

class LayerSearch {
 public:
  LayerSearch(const Shot& shot, const ImageFile& seen, Layer layer)
      : shot_(shot),
        seen_(seen),
        layer_(layer),
        job_(job_of(shot)),
        places_(textbook::spread_pixels(shot.width, shot.height, most_pixels)) {
    job_.options.depth = 1;
    job_.options.shadows = false;
    is_rounded_ = seen.sample != Sample::float32 && seen.sample != Sample::half;
  }

  LayerDiagnosis result() {
    fit(right_);
    std::vector<LayerCandidate> singles = with_one_fault();
    LayerDiagnosis diagnosis;
    diagnosis.pixels = places_.size();
    const bool one_is_better = !singles.empty() && is_clearly_better(singles.front(), right_);
    if (is_enough(right_) && !one_is_better) return told(diagnosis, LayerVerdict::right, right_, {});
    if (!singles.empty() && is_enough(singles.front()) && one_is_better)
      return told(diagnosis, LayerVerdict::faults, singles.front(), singles);
    const auto pair = with_two_faults(singles);
    if (pair) return told(diagnosis, LayerVerdict::faults, *pair, {});
    return diagnosis;
  }

 private:
  bool is_enough(const LayerCandidate& candidate) const {
    const auto allowed = (1 - least_share) * static_cast<double>(places_.size());
    return static_cast<double>(candidate.unexplained) <= allowed;
  }

  /// Half as many are left, and too many fewer for chance.
  static bool is_clearly_better(const LayerCandidate& a, const LayerCandidate& b) {
    constexpr std::size_t least = 12;
    return b.unexplained >= 2 * a.unexplained && b.unexplained >= a.unexplained + least;
  }

  /// Tries all faults.
  std::vector<LayerCandidate> with_one_fault() {
    std::vector<Faults> sets;
    for (std::size_t i = 0; i < number_of_faults(); ++i) {
      const faults::Fault& fault = fault_at(i);
      const bool is_a_picture_s = fault.after && !turns_rows(fault) && !turns_columns(fault);
      if (!is_a_picture_s) sets.push_back({&fault});
    }
    return best_of(sets);
  }

  /// Where it has none, it has none beside another fault, either, of those that matter.
  bool has_effect(const LayerCandidate& single) const {
    if (turns_rows(*single.faults.front()) || turns_columns(*single.faults.front())) return true;
    for (std::size_t i = 0; i < single.layers.size(); ++i)
      if (i % channels >= 3 && single.layers[i] != right_.layers[i]) return true;
    return false;
  }

  /// Tries the best faults with all others that have an effect.
  std::optional<LayerCandidate> with_two_faults(const std::vector<LayerCandidate>& singles) {
    constexpr std::size_t most_first = 6;
    std::vector<Faults> sets;
    for (std::size_t i = 0; i < std::min(most_first, singles.size()); ++i) {
      for (std::size_t j = i + 1; j < singles.size(); ++j)
        if (has_effect(singles[j])) sets.push_back({singles[i].faults.front(), singles[j].faults.front()});
    }
    for (const LayerCandidate& pair : best_of(sets)) {
      const bool each_is_needed = std::ranges::all_of(pair.faults, [&](const faults::Fault* fault) {
        return is_clearly_better(pair, candidate({fault}));
      });
      if (is_enough(pair) && each_is_needed) return pair;
    }
    return {};
  }

  /// Fits sets at some of the pixels, and those that leave least there at all. Returns all, the best first.
  std::vector<LayerCandidate> best_of(const std::vector<Faults>& sets) {
    constexpr std::size_t some_pixels = 600, most_fitted_again = 16;
    const auto all_places = places_;
    places_.resize(std::min(places_.size(), some_pixels));
    std::vector<LayerCandidate> all;
    for (const Faults& faults : sets) all.push_back(candidate(faults));
    std::ranges::stable_sort(all, &is_smaller);
    places_ = all_places;
    const std::size_t again = std::min(most_fitted_again, all.size());
    for (std::size_t i = 0; i < again; ++i) all[i] = candidate(all[i].faults);
    for (std::size_t i = again; i < all.size(); ++i) all[i].unexplained = places_.size();
    std::ranges::stable_sort(all, &is_smaller);
    return all;
  }

  Seen seen_at(PixelPlace place, const Faults& faults) const {
    for (const faults::Fault* fault : faults) {
      if (turns_rows(*fault)) place.y = seen_.height - 1 - place.y;
      if (turns_columns(*fault)) place.x = seen_.width - 1 - place.x;
    }
    const auto in_file = static_cast<std::size_t>(seen_.channels);
    const std::size_t pixel = static_cast<std::size_t>(place.y) * static_cast<std::size_t>(seen_.width) +
                              static_cast<std::size_t>(place.x);
    const float* const values = &seen_.values[in_file * pixel];
    return in_file < 3 ? Seen{values[0], values[0], values[0]} : Seen{values[0], values[1], values[2]};
  }

  LayerCandidate candidate(const Faults& faults) const {
    LayerCandidate candidate;
    candidate.faults = faults;
    try {
      fit(candidate);
    } catch (const std::runtime_error&) {
      // A scene that cannot be traced with these faults explains nothing.
    }
    return candidate;
  }

  void fit(LayerCandidate& candidate) const {
    const std::vector<float> values =
        faults::layers_with(shot_.scene, shot_.camera, job_, candidate.faults,
                            {Layer::normal, Layer::depth, Layer::direction, Layer::object}, places_);
    std::vector<std::array<float, 3>> normals;
    std::vector<float> along_ray, along_camera;
    std::vector<Seen> of_surfaces, of_nothing;
    const Vec3d forward = glm::normalize(shot_.camera.direction);
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const float* const v = &values[channels * i];
      const Seen seen = seen_at(places_[i], candidate.faults);
      if (v[10] == 0) {
        of_nothing.push_back(seen);
        continue;
      }
      normals.push_back({v[3], v[4], v[5]});
      along_ray.push_back(v[6]);
      along_camera.push_back(v[6] * static_cast<float>(glm::dot(forward, Vec3d(v[7], v[8], v[9]))));
      of_surfaces.push_back(seen);
    }
    candidate.layers = values;
    candidate.unexplained = places_.size();
    // because fewer show one face or two, which many encodings give
    constexpr std::size_t one_in = 40, least = 20;
    if (of_surfaces.size() < std::max(least, places_.size() / one_in)) return;
    const auto fitted = layer_ == Layer::normal
                            ? std::optional(fit_of_normals(normals, of_surfaces, is_rounded_))
                            : fit_of_depths(along_ray, along_camera, of_surfaces, is_rounded_);
    if (!fitted) return;
    candidate.encoding = fitted->encoding;
    candidate.unexplained = static_cast<std::size_t>(std::ranges::count(fitted->explained, false)) +
                            unlike_the_background(of_nothing);
  }

  /// The number that do not have the colour that most have where nothing is met.
  std::size_t unlike_the_background(std::vector<Seen> of_nothing) const {
    if (of_nothing.empty()) return 0;
    std::ranges::sort(of_nothing);
    std::size_t most = 0, run = 0;
    for (std::size_t i = 0; i < of_nothing.size(); ++i) {
      run = i > 0 && of_nothing[i] == of_nothing[i - 1] ? run + 1 : 1;
      most = std::max(most, run);
    }
    return of_nothing.size() - most;
  }

  /// Others that leave as much stand beside the commonest of them.
  LayerDiagnosis told(LayerDiagnosis diagnosis, LayerVerdict verdict, const LayerCandidate& best,
                      const std::vector<LayerCandidate>& others) const {
    diagnosis.verdict = verdict;
    diagnosis.encoding = best.encoding;
    diagnosis.explained = places_.size() - best.unexplained;
    if (verdict == LayerVerdict::right) return diagnosis;
    for (const faults::Fault* fault : best.faults) diagnosis.faults.push_back({fault, {}});
    Faults alike;
    for (const LayerCandidate& other : others)
      if (is_enough(other) && !is_clearly_better(best, other)) alike.push_back(other.faults.front());
    if (alike.size() < 2) return diagnosis;
    std::ranges::stable_sort(
        alike, [](const faults::Fault* a, const faults::Fault* b) { return count_of(*a) > count_of(*b); });
    constexpr std::size_t most_alike = 3;
    alike.resize(std::min(most_alike, alike.size()));
    diagnosis.faults = {{alike.front(), {alike.begin() + 1, alike.end()}}};
    return diagnosis;
  }

  const Shot& shot_;
  const ImageFile& seen_;
  Layer layer_;
  textbook::RenderJob job_;
  std::vector<PixelPlace> places_;
  bool is_rounded_;
  LayerCandidate right_;
};

}  // namespace

LayerDiagnosis diagnose_layer(const Shot& shot, const ImageFile& seen, Layer layer) {
  if (layer != Layer::normal && layer != Layer::depth)
    throw std::invalid_argument("found another layer, expected normal or depth");
  return LayerSearch(shot, seen, layer).result();
}

}  // namespace plumb::diagnosis
