#include "references/diagnosis/search.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>

#include "tracer/textbook/sampled_pixels.hpp"

namespace plumb::diagnosis {
namespace {

constexpr std::size_t beam_width = 4;
constexpr std::size_t first_beam_width = 10;  // because each of several faults alone explains little
constexpr std::size_t most_faults = 7;
constexpr std::size_t screened = 14;  // number of sets of the first look that are looked at with all pixels
constexpr std::size_t telling_of_fault = 3;
constexpr std::size_t polishing = 200;  // number of wrong pixels, and of right ones, that polishing looks at
/// Fewest wrong pixels to act on, because float and double disagree in 0 to 7 pixels of 39 of 40 random
/// pictures of 480 x 320, and in 18 of one.
constexpr std::size_t least_wrong = 12;
/// The share of the wrong pixels that a change must right, because several faults may be left, each with its
/// share; no fault rights what float rounded.
constexpr double least_righted = 0.1;
/// What a spoilt pixel costs, because a fault that is really there spoils nothing but what another fault
/// hides.
constexpr double price_of_spoilt = 10;
constexpr std::size_t glance = 60;            // pixels, at pairs of faults
constexpr double most_units_of_search = 3e7;  // of Work: some 1 s
constexpr double nothing_left =
    0.005;                     // because float and double disagree by a level in some of a thousand pixels
constexpr double looks = 450;  // at all even pixels, in a search for two or three faults

class Search {
 public:
  explicit Search(Evidence& evidence)
      : evidence_(evidence),
        even_(std::min(evidence.pixels_of_picture() / 4 + 1,
                       static_cast<std::size_t>(std::clamp(
                           most_units_of_search / (looks * evidence.units_of_pixel()), 100.0, 500.0)))),
        has_effect_(faults::fault_catalogue().size(), false) {}

  Fit best() {
    std::vector<Fit> beam{{}};
    look_again(beam);
    const std::size_t wrong = wrong_at(beam.front()).size();
    if (beam.front().misfit <= nothing_left || wrong < least_wrong) return beam.front();
    // A picture that is nearly right has few faults, and a right one has to be recognised in 2 s.
    if (wrong < evidence_.survey().size() / 200) budget_ = 0.25;
    learn_effects({});
    look_again(beam);
    Fit best = polished(climbed(beam));
    if (best.misfit <= nothing_left) return best;
    share_ = 0.6;
    if (const auto view = best_view(best)) {
      learn_effects(view->set);
      keep_better(polished(climbed({*view})), best);
    }
    // When two faults hide each other, neither is found alone. So pairs are tried, first without other
    // faults.
    share_ = 0.85;
    for (FaultSet beside{}; best.misfit > nothing_left && !is_over(); beside = best.set) {
      if (!beside.empty()) learn_effects(beside);
      std::vector<Fit> seeds = pairs(beside);
      if (seeds.empty()) break;
      const bool is_better = keep_better(polished(climbed(std::move(seeds))), best);
      if (!is_better && (!beside.empty() || best.set.empty())) break;
    }
    return best;
  }

 private:
  bool is_over(double share) const { return evidence_.is_over(share * budget_); }
  bool is_over() const { return is_over(share_); }

  bool keep_better(const Fit& other, Fit& best) const {
    best = evidence_.fit(best.set, evidence_.pixels());
    const bool is_better = cost(other) < cost(best);
    if (is_better) best = other;
    return is_better;
  }

  /// Returns the one fault with which most pixels show the right points, if it is clearly better in this than
  /// the best fit. With a wrong view the colours are then searched from there, because other faults show in
  /// other places.
  std::optional<Fit> best_view(const Fit& best) const {
    constexpr double clear = 0.1;  // because chance moves the coefficient by 1 / sqrt(pixels), 0.04
    std::optional<Fit> found;
    for (std::size_t fault = 0; fault < has_effect_.size(); ++fault) {
      if (!has_effect_[fault]) continue;
      const Fit fit = evidence_.fit({fault}, evidence_.pixels());
      if (fit.association > (found ? found->association : best.association + clear)) found = fit;
    }
    return found;
  }

  /// Returns the best set that is reached by adding one fault at a time, refined.
  Fit climbed(std::vector<Fit> beam) {
    Fit best = beam.front();
    // When two faults spoil the same pixels, neither alone need bring a gain. So one more level is tried.
    for (int patience = 2;
         patience > 0 && !is_over() && best.misfit > nothing_left && beam.front().set.size() < most_faults;) {
      std::vector<Fit> next = expanded(beam);
      if (next.empty()) break;
      beam = std::move(next);
      const bool gains = beam.front().misfit < best.misfit - gain_of(beam.front(), best);
      if (gains) learn_effects(beam.front().set);  // a fault may show only beside another
      look_again(beam);
      patience = gains ? 2 : patience - 1;
      best = gains ? beam.front() : evidence_.fit(best.set, evidence_.pixels());
    }
    return refined(best);
  }

  /// Learns a few telling pixels for each fault, where it changes the picture of this set. Highlights and
  /// shadows are small, and evenly spread pixels may miss them.
  void learn_effects(const FaultSet& beside) {
    const std::vector<PixelPlace> places =
        textbook::spread_pixels(evidence_.width(), evidence_.height(), 2 * even_);
    const std::vector<float> before = evidence_.colours(beside, places);
    std::vector<std::vector<std::size_t>> changed(has_effect_.size());
    for (std::size_t fault = 0; fault < has_effect_.size(); ++fault) {
      if (std::binary_search(beside.begin(), beside.end(), fault)) continue;
      const std::vector<float> after = evidence_.colours(with(beside, fault), places);
      for (std::size_t i = 0; i < places.size(); ++i) {
        if (!std::equal(&before[3 * i], &before[3 * i] + 3, &after[3 * i])) changed[fault].push_back(i);
      }
      has_effect_[fault] = has_effect_[fault] || !changed[fault].empty();
    }
    telling_.clear();
    std::set<std::size_t> taken;
    for (std::size_t round = 0; round < telling_of_fault; ++round) {
      for (const std::vector<std::size_t>& of_fault : changed) {
        if (of_fault.empty()) continue;
        const std::size_t i = of_fault[of_fault.size() * (2 * round + 1) / (2 * telling_of_fault)];
        if (taken.insert(i).second) telling_.push_back(places[i]);
      }
    }
  }

  /// Looks at telling pixels, even pixels, and as many of those that the best fit does not explain.
  void look_again(std::vector<Fit>& beam) {
    std::vector<PixelPlace> places = textbook::spread_pixels(evidence_.width(), evidence_.height(), even_);
    evidence_.look_at(places);
    Fit best = evidence_.fit(beam.front().set, places.size());
    const std::vector<float> differences = evidence_.differences_at(best, evidence_.survey());
    std::vector<PixelPlace> open;
    for (std::size_t i = 0; i < differences.size(); ++i) {
      if (differences[i] > 1) open.push_back(evidence_.survey()[i]);
    }
    const std::size_t wanted = std::min(open.size(), even_ / 2);
    // The kinds alternate, so that each first part of the places has all of them.
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
        gain += least_gain(faults::fault_catalogue()[fault], without.misfit);
    }
    return gain;
  }

  /// Returns the misfit plus what the faults cost. It compares sets of different sizes.
  static double cost(const Fit& fit) {
    double cost = fit.misfit;
    for (const std::size_t fault : fit.set) cost += least_gain(faults::fault_catalogue()[fault], 0);
    return cost;
  }
  static void sort(std::vector<Fit>& fits) {
    std::stable_sort(fits.begin(), fits.end(), [](const Fit& a, const Fit& b) { return cost(a) < cost(b); });
  }

  /// Returns the best few of all sets with one fault more. It adds only faults that change the right picture.
  std::vector<Fit> expanded(const std::vector<Fit>& beam) const {
    std::set<FaultSet> tried;
    std::vector<Fit> fits;
    for (const Fit& fit : beam) {
      if (is_over()) break;
      for (std::size_t fault = 0; fault < faults::fault_catalogue().size(); ++fault) {
        if (!has_effect_[fault] || std::binary_search(fit.set.begin(), fit.set.end(), fault)) continue;
        if (!tried.insert(with(fit.set, fault)).second) continue;
        fits.push_back(evidence_.fit(with(fit.set, fault), first_look()));
      }
    }
    return best_of(std::move(fits), beam.front().set.empty() ? first_beam_width : beam_width);
  }

  /// Returns the sets with the most promising pairs of faults added. When two faults hide each other, like
  /// those of brightness and of ambient light, each alone makes it worse.
  std::vector<Fit> pairs(const FaultSet& beside) const {
    const auto is_free = [&](std::size_t fault) {
      return has_effect_[fault] && !std::binary_search(beside.begin(), beside.end(), fault);
    };
    std::vector<Fit> pairs;
    for (std::size_t a = 0; a < has_effect_.size(); ++a) {
      if (!is_free(a) || is_over()) continue;
      for (std::size_t b = a + 1; b < has_effect_.size(); ++b) {
        if (is_free(b)) pairs.push_back(evidence_.fit(with(with(beside, a), b), glance));
      }
    }
    pairs = leading(std::move(pairs), 3 * screened);
    for (Fit& pair : pairs) pair = evidence_.fit(pair.set, first_look());
    return best_of(std::move(pairs), first_beam_width);
  }

  std::size_t first_look() const { return evidence_.pixels() / 5; }

  /// Returns the best of fits to the pixels of the first look.
  std::vector<Fit> best_of(std::vector<Fit> fits, std::size_t most) const {
    fits = leading(std::move(fits), screened);
    for (Fit& fit : fits) fit = evidence_.fit(fit.set, evidence_.pixels());
    return leading(std::move(fits), most);
  }

  /// Drops, from sorted fits, those that are as good as a cheaper one to the last digit: they have a fault
  /// that has no effect beside the others.
  static void drop_without_effect(std::vector<Fit>& fits) {
    std::set<std::pair<double, double>> known;
    const auto is_known = [&](const Fit& fit) { return !known.insert({fit.misfit, fit.association}).second; };
    fits.erase(std::remove_if(fits.begin(), fits.end(), is_known), fits.end());
  }

  /// Returns the fits that fit best, best first, and a third as many that seem to see the right points. With
  /// a wrong view and wrong colours, neither fits while the other is wrong.
  static std::vector<Fit> leading(std::vector<Fit> fits, std::size_t most) {
    sort(fits);
    drop_without_effect(fits);
    const auto best = static_cast<std::ptrdiff_t>(std::min(fits.size(), most));
    std::stable_sort(fits.begin() + best, fits.end(),
                     [](const Fit& a, const Fit& b) { return a.association > b.association; });
    fits.resize(std::min(fits.size(), most + most / 3));
    return fits;
  }

  /// Takes out what is not needed, and exchanges faults for those that do better.
  Fit refined(Fit best) const {
    for (bool improves = true; improves && !is_over();) {
      improves = false;
      std::vector<FaultSet> sets = exchanged(best.set);
      for (std::size_t i = 0; i < best.set.size(); ++i) sets.push_back(without(best.set, best.set[i]));
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

  std::vector<PixelPlace> wrong_at(const Fit& fit) const {
    const std::vector<float> differences = evidence_.differences_at(fit, evidence_.survey());
    std::vector<PixelPlace> wrong;
    for (std::size_t i = 0; i < differences.size(); ++i)
      if (differences[i] >= 1) wrong.push_back(evidence_.survey()[i]);
    return wrong;
  }

  /// Uses what a few pixels tell when nothing else is left: faults that show nowhere else.
  Fit polished(Fit best) const {
    for (int round = 0; round < 4 && !is_over(1); ++round) {
      const std::vector<float> differences = evidence_.differences_at(best, evidence_.survey());
      std::vector<PixelPlace> wrong, right;
      for (std::size_t i = 0; i < differences.size(); ++i)
        (differences[i] >= 1 ? wrong : right).push_back(evidence_.survey()[i]);
      if (wrong.size() < least_wrong) break;
      const double right_of_wrong = static_cast<double>(right.size()) / static_cast<double>(wrong.size());
      Fit better = changed(best, one_more_or_less(best.set), some_of(wrong), some_of(right), right_of_wrong);
      if (better.set == best.set)
        better = changed(best, exchanged(best.set), some_of(wrong), some_of(right), right_of_wrong);
      if (better.set == best.set) break;
      best = better;
    }
    return needed(best);
  }

  /// Returns the fit without the faults that right no more pixels than float rounds.
  Fit needed(Fit best) const {
    constexpr double rounded_pixels = least_wrong;
    const double rounded = rounded_pixels / static_cast<double>(evidence_.pixels_of_picture());
    double right = share_right(best, evidence_.survey());
    for (std::size_t i = 0; i < best.set.size();) {
      // Each in its own encoding: tone-mapped in the program or in the file, the picture is the same.
      const Fit less = evidence_.fit(without(best.set, best.set[i]), evidence_.pixels());
      const double still_right = share_right(less, evidence_.survey());
      if (still_right >= right - rounded) {
        best = less;
        right = still_right;
      } else {
        ++i;
      }
    }
    return evidence_.fit(best.set, evidence_.pixels());
  }

  /// Returns so many of these places that a few hundred sets can be tried there.
  std::vector<PixelPlace> some_of(const std::vector<PixelPlace>& places) const {
    constexpr double sets = 300;
    std::vector<PixelPlace> some;
    const auto affordable =
        static_cast<std::size_t>(most_units_of_search / (sets * evidence_.units_of_pixel()));
    const std::size_t count = std::min(places.size(), std::clamp(affordable, std::size_t{40}, polishing));
    for (std::size_t i = 0; i < count; ++i) some.push_back(places[i * places.size() / count]);
    return some;
  }

  /// Returns the set that rights most of the wrong pixels, less what it spoils; the best fit if none does.
  Fit changed(const Fit& best, const std::vector<FaultSet>& sets, const std::vector<PixelPlace>& wrong,
              const std::vector<PixelPlace>& right, double right_of_wrong) const {
    Fit found = best;
    double most = least_righted;
    for (const FaultSet& set : sets) {
      if (is_over(1)) break;
      const double righted = share_right({set, best.encoding, 0, 0}, wrong);
      if (righted <= most) continue;
      const double spoilt = 1 - share_right({set, best.encoding, 0, 0}, right);
      if (righted - price_of_spoilt * spoilt * right_of_wrong <= most) continue;
      most = righted - price_of_spoilt * spoilt * right_of_wrong;
      found.set = set;
    }
    return found;
  }

  double share_right(const Fit& fit, const std::vector<PixelPlace>& places) const {
    const std::vector<float> differences = evidence_.differences_at(fit, places);
    const auto right = std::count_if(differences.begin(), differences.end(), [](float d) { return d < 1; });
    return static_cast<double>(right) / static_cast<double>(std::max<std::size_t>(1, places.size()));
  }

  /// Returns sets with one fault more; if `is_any`, with faults that have no effect at the pixels looked at,
  /// too.
  std::vector<FaultSet> one_more(const FaultSet& set, bool is_any) const {
    std::vector<FaultSet> sets;
    for (std::size_t fault = 0; fault < faults::fault_catalogue().size(); ++fault) {
      if ((is_any || has_effect_[fault]) && !std::binary_search(set.begin(), set.end(), fault))
        sets.push_back(with(set, fault));
    }
    return sets;
  }

  std::vector<FaultSet> one_more_or_less(const FaultSet& set) const {
    std::vector<FaultSet> sets = one_more(set, true);
    for (std::size_t i = 0; i < set.size(); ++i) sets.push_back(without(set, set[i]));
    return sets;
  }

  std::vector<FaultSet> exchanged(const FaultSet& set) const {
    std::vector<FaultSet> sets;
    for (std::size_t i = 0; i < set.size(); ++i) {
      for (const FaultSet& other : one_more(without(set, set[i]), false)) {
        if (other != set) sets.push_back(other);
      }
    }
    return sets;
  }

  Evidence& evidence_;
  std::size_t even_;
  double share_ = 0.4;  // of the work, for the current step; some is left for pairs and for polishing
  double budget_ = 1;   // of all the work
  std::vector<bool> has_effect_;  // for each fault
  std::vector<PixelPlace> telling_;
};

}  // namespace

int count_of(const faults::Fault& fault) {
  int count = 0;
  std::from_chars(fault.how_common.data(), fault.how_common.data() + fault.how_common.size(), count);
  return std::max(0, count);
}

double least_gain(const faults::Fault& fault, double before) {
  // because float and double disagree by one level in some pixels of a thousand, which is ln 2 each. A rare
  // fault needs more evidence than one that most tracers have.
  return 0.001 + 0.002 / (1 + count_of(fault)) + 0.01 * before;
}

Fit explain(Evidence& evidence) { return Search(evidence).best(); }

}  // namespace plumb::diagnosis
