#include "references/diagnosis/search.hpp"

#include <algorithm>
#include <cstdlib>
#include <set>

namespace plumb::references {
namespace {

constexpr std::size_t beam_width = 4;
constexpr std::size_t first_beam_width = 10;  // because of several faults each alone explains little
constexpr std::size_t most_faults = 7;
constexpr std::size_t screened = 14;  // of the first look, that are looked at with all pixels
constexpr std::size_t telling_of_fault = 3;
constexpr std::size_t glance = 60;  // pixels, at pairs of faults
constexpr double most_units = 8e7;  // of Work: some 3 s
constexpr double nothing_left =
    0.005;                     // because float and double disagree by a level in some of a thousand pixels
constexpr double looks = 450;  // at all even pixels, in a search for two or three faults

/// How many of the tracers that were read have the fault.
int count_of(const Fault& fault) { return std::max(0, std::atoi(fault.how_common.data())); }

class Search {
 public:
  explicit Search(Evidence& evidence)
      : evidence_(evidence),
        even_(std::min(evidence.pixels_of_picture() / 4 + 1,
                       static_cast<std::size_t>(
                           std::clamp(most_units / (looks * evidence.units_of_pixel()), 150.0, 1500.0)))),
        has_effect_(fault_catalogue().size(), false) {}

  Fit best() {
    std::vector<Fit> beam{{}};
    look_again(beam);
    if (beam.front().misfit <= nothing_left) return beam.front();
    choose_telling_pixels();
    look_again(beam);
    Fit best = climbed(beam);
    if (best.misfit <= nothing_left || evidence_.is_over()) return best;
    std::vector<Fit> seeds = pairs();
    if (seeds.empty()) return best;
    const Fit from_pairs = climbed(std::move(seeds));
    best = evidence_.fit(best.set, evidence_.pixels());
    return cost(from_pairs) < cost(best) ? from_pairs : best;
  }

 private:
  /// The best set that is reached by one more fault at a time, refined.
  Fit climbed(std::vector<Fit> beam) {
    Fit best = beam.front();
    // Of two faults that spoil the same pixels neither alone need bring a gain: one more level is tried.
    for (int patience = 2; patience > 0 && !evidence_.is_over() && best.misfit > nothing_left &&
                           beam.front().set.size() < most_faults;) {
      std::vector<Fit> next = expanded(beam);
      if (next.empty()) break;
      beam = std::move(next);
      const bool gains = beam.front().misfit < best.misfit - gain_of(beam.front(), best);
      look_again(beam);
      patience = gains ? 2 : patience - 1;
      best = gains ? beam.front() : evidence_.fit(best.set, evidence_.pixels());
    }
    return refined(best);
  }

  /// A few pixels for each fault that it changes in the right picture: highlights and shadows are small, and
  /// evenly spread pixels may miss them.
  void choose_telling_pixels() {
    const std::vector<PixelPlace> places = spread(evidence_.width(), evidence_.height(), 2 * even_);
    const std::vector<float> right = evidence_.colours({}, places);
    std::vector<std::vector<std::size_t>> changed(has_effect_.size());
    for (std::size_t fault = 0; fault < has_effect_.size(); ++fault) {
      const std::vector<float> wrong = evidence_.colours({fault}, places);
      for (std::size_t i = 0; i < places.size(); ++i) {
        if (!std::equal(&right[3 * i], &right[3 * i] + 3, &wrong[3 * i])) changed[fault].push_back(i);
      }
      has_effect_[fault] = !changed[fault].empty();
    }
    std::set<std::size_t> taken;
    for (std::size_t round = 0; round < telling_of_fault; ++round) {
      for (const std::vector<std::size_t>& of_fault : changed) {
        if (of_fault.empty()) continue;
        const std::size_t i = of_fault[of_fault.size() * (2 * round + 1) / (2 * telling_of_fault)];
        if (taken.insert(i).second) telling_.push_back(places[i]);
      }
    }
  }

  /// Telling pixels, even pixels, and as many of those that the best does not explain.
  void look_again(std::vector<Fit>& beam) {
    std::vector<PixelPlace> places = spread(evidence_.width(), evidence_.height(), even_);
    evidence_.look_at(places);
    Fit best = evidence_.fit(beam.front().set, places.size());
    const std::vector<float> differences = evidence_.survey_differences(best);
    std::vector<PixelPlace> open;
    for (std::size_t i = 0; i < differences.size(); ++i) {
      if (differences[i] > 1) open.push_back(evidence_.survey()[i]);
    }
    const std::size_t wanted = std::min(open.size(), even_ / 2);
    // Turn about, so that the first part of the places has all kinds.
    std::vector<PixelPlace> mixed;
    for (std::size_t i = 0; i < std::max(places.size(), telling_.size()); ++i) {
      if (i < telling_.size()) mixed.push_back(telling_[i]);
      if (i < places.size()) mixed.push_back(places[i]);
      if (i % 2 == 0 && i / 2 < wanted) mixed.push_back(open[i / 2 * open.size() / wanted]);
    }
    evidence_.look_at(mixed);
    for (Fit& fit : beam) fit = evidence_.fit(fit.set, evidence_.pixels());
    sort(beam);
  }

  double gain_of(const Fit& with, const Fit& without) const {
    double gain = 0;
    for (const std::size_t fault : with.set) {
      if (!std::binary_search(without.set.begin(), without.set.end(), fault))
        gain += least_gain(fault_catalogue()[fault], without.misfit);
    }
    return gain;
  }

  /// Misfit and what the faults cost, by which sets of different sizes are compared.
  static double cost(const Fit& fit) {
    double cost = fit.misfit;
    for (const std::size_t fault : fit.set) cost += least_gain(fault_catalogue()[fault], 0);
    return cost;
  }
  static void sort(std::vector<Fit>& fits) {
    std::stable_sort(fits.begin(), fits.end(), [](const Fit& a, const Fit& b) { return cost(a) < cost(b); });
  }

  static FaultSet with(FaultSet set, std::size_t fault) {
    set.insert(std::lower_bound(set.begin(), set.end(), fault), fault);
    return set;
  }

  /// All sets with one fault more, the best few of them. Only faults that change the right picture.
  std::vector<Fit> expanded(const std::vector<Fit>& beam) const {
    std::set<FaultSet> tried;
    std::vector<Fit> fits;
    for (const Fit& fit : beam) {
      if (evidence_.is_over()) break;
      for (std::size_t fault = 0; fault < fault_catalogue().size(); ++fault) {
        if (!has_effect_[fault] || std::binary_search(fit.set.begin(), fit.set.end(), fault)) continue;
        if (!tried.insert(with(fit.set, fault)).second) continue;
        fits.push_back(evidence_.fit(with(fit.set, fault), first_look()));
      }
    }
    return best_of(std::move(fits), beam.front().set.empty() ? first_beam_width : beam_width);
  }

  /// The most promising pairs of faults: of two that hide each other, as of brightness and of ambient light,
  /// each alone makes it worse.
  std::vector<Fit> pairs() const {
    std::vector<Fit> pairs;
    for (std::size_t a = 0; a < has_effect_.size(); ++a) {
      for (std::size_t b = a + 1; has_effect_[a] && b < has_effect_.size(); ++b) {
        if (has_effect_[b]) pairs.push_back(evidence_.fit({a, b}, glance));
      }
    }
    sort(pairs);
    pairs.resize(std::min(pairs.size(), 3 * screened));
    for (Fit& pair : pairs) pair = evidence_.fit(pair.set, first_look());
    return best_of(std::move(pairs), first_beam_width);
  }

  std::size_t first_look() const { return evidence_.pixels() / 5; }

  /// Of fits to the pixels of the first look.
  std::vector<Fit> best_of(std::vector<Fit> fits, std::size_t most) const {
    sort(fits);
    fits.resize(std::min(fits.size(), screened));
    for (Fit& fit : fits) fit = evidence_.fit(fit.set, evidence_.pixels());
    sort(fits);
    fits.resize(std::min(fits.size(), most));
    return fits;
  }

  /// Takes out what is not needed, and exchanges what another fault does better.
  Fit refined(Fit best) const {
    for (bool improves = true; improves && !evidence_.is_over();) {
      improves = false;
      std::vector<FaultSet> sets;
      for (std::size_t i = 0; i < best.set.size(); ++i) {
        FaultSet without = best.set;
        without.erase(without.begin() + static_cast<std::ptrdiff_t>(i));
        sets.push_back(without);
        for (std::size_t fault = 0; fault < fault_catalogue().size(); ++fault) {
          if (has_effect_[fault] && !std::binary_search(best.set.begin(), best.set.end(), fault))
            sets.push_back(with(without, fault));
        }
      }
      std::vector<Fit> fits;
      for (const FaultSet& set : sets) fits.push_back(evidence_.fit(set, first_look()));
      fits = best_of(std::move(fits), 1);
      if (!fits.empty() && cost(fits.front()) < cost(best)) {
        best = fits.front();
        improves = true;
      }
    }
    return best;
  }

  Evidence& evidence_;
  std::size_t even_;
  std::vector<bool> has_effect_;  // of the faults
  std::vector<PixelPlace> telling_;
};

}  // namespace

double least_gain(const Fault& fault, double before) {
  // because float and double disagree by one level in some pixels of a thousand, ln 2 each; a rare fault
  // needs more evidence than one that most tracers have
  return 0.001 + 0.002 / (1 + count_of(fault)) + 0.01 * before;
}

Fit explain(Evidence& evidence) { return Search(evidence).best(); }

}  // namespace plumb::references
