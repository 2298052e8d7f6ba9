#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <stdexcept>

#include "references/studies/stability/atlas.hpp"
#include "references/studies/stability/catalogue.hpp"
#include "references/studies/stability/kept.hpp"
#include "tracer/system/in_parallel.hpp"

namespace plumb::studies::stability {
namespace {

/// One row: the curve, then bisection where it breaks.
class Sweeper {
 public:
  Sweeper(const Probe& probe, const ConditionEntry& entry, bool makes_pictures, bool quick)
      : probe_(probe),
        entry_(entry),
        makes_pictures_(makes_pictures),
        size_(makes_pictures ? (quick ? 48 : 64) : std::max(10, quick ? entry.rays / 8 : entry.rays)),
        points_(quick ? 13 : 37),
        steps_(makes_pictures ? 4 : 6) {}

  void fill(Row& row) {
    const std::vector<double> all = values();
    if (makes_pictures_) fetch(all);
    for (const double value : all) {
      const Outcome& o = at(value);
      constexpr double nan = std::numeric_limits<double>::quiet_NaN();
      row.curve.emplace_back(value, !o.counts                   ? nan
                                    : o.missed || o.self_shadow ? 1
                                                                : std::min(1.0, o.relative));
      row.wrong.emplace_back(value, o.counts ? o.wrong : nan);
    }
    row.breaks.missed = first(row.curve, [](const Outcome& o) { return o.missed; });
    row.breaks.ulp16 = first(row.curve, [](const Outcome& o) { return o.ulps > 16; });
    row.breaks.e6 = first(row.curve, [](const Outcome& o) { return o.relative > 1e-6; });
    row.breaks.percent = first(row.curve, [](const Outcome& o) { return o.relative > 0.01; });
    row.breaks.self_shadow = first(row.curve, [](const Outcome& o) { return o.self_shadow; });
  }

 private:
  double rounded(double value) const { return entry_.is_whole ? std::round(value) : value; }

  std::vector<double> values() const {
    std::vector<double> all;
    for (int i = 0; i < points_; ++i) {
      const double value = rounded(std::pow(entry_.last, static_cast<double>(i) / (points_ - 1)));
      if (all.empty() || value != all.back()) all.push_back(value);
    }
    return all;
  }

  /// Probes all values at once, because another program is waited for.
  void fetch(const std::vector<double>& values) {
    std::mutex mutex;
    in_parallel(values.size(), 8, [&](std::size_t i) {
      const Outcome outcome = probe_(values[i], size_);
      const std::lock_guard lock(mutex);
      known_[values[i]] = outcome;
    });
  }

  const Outcome& at(double value) {
    const auto known = known_.find(value);
    return known != known_.end() ? known->second : known_[value] = probe_(value, size_);
  }

  template <class Fails>
  std::optional<double> first(const std::vector<std::pair<double, double>>& curve, Fails fails) {
    const auto found =
        std::find_if(curve.begin(), curve.end(), [&](const auto& p) { return fails(at(p.first)); });
    if (found == curve.end()) return std::nullopt;
    if (found == curve.begin()) return found->first;
    double good = std::prev(found)->first, bad = found->first;
    for (int step = 0; step < steps_; ++step) {
      const double middle = rounded(std::sqrt(good * bad));
      if (middle == good || middle == bad) break;
      (fails(at(middle)) ? bad : good) = middle;
    }
    return bad;
  }

  const Probe& probe_;
  const ConditionEntry& entry_;
  bool makes_pictures_;
  int size_;
  int points_;
  int steps_;  ///< 6: 2 % of a decade, finer than the spread between seeds; 4: 7 %, pictures take long
  std::map<double, Outcome> known_;
};

std::vector<ConditionEntry> chosen(const std::string& name) {
  std::vector<ConditionEntry> all = catalogue();
  if (name.empty()) return all;
  std::string names;
  for (ConditionEntry& entry : all) {
    if (entry.name == name) return {std::move(entry)};
    names += (names.empty() ? "" : ", ") + entry.name;
  }
  throw std::invalid_argument("--condition: found '" + name + "', expected one of " + names);
}

const char* name_of(Measure measure) {
  constexpr std::array<const char*, 4> names{"t", "direction", "point", "pixels"};
  return names.at(static_cast<std::size_t>(measure));
}

/// A row to be measured, and where it goes.
struct Task {
  const ConditionEntry* entry;
  const Method* method;
  const Variant* variant;
  Row* row;
};

void measure(const Task& task, const Kept& kept, bool quick) {
  Row& row = *task.row;
  if (kept.find(task.entry->name, task.variant->renderer, row)) return;
  try {
    const bool makes_pictures = task.method->measures == Measure::pixels;
    Sweeper(task.variant->probe, *task.entry, makes_pictures, quick).fill(row);
  } catch (const Unavailable& missing) {
    row.unavailable = missing.what();
    return;
  }
  kept.keep(task.entry->name, task.variant->renderer, row);
}

/// Most of the time POV-Ray waits: more threads than the machine runs at once.
int threads() { return 8 * processors(); }

}  // namespace

std::vector<Condition> stability(const Sweep& sweep) {
  const std::vector<ConditionEntry> entries = chosen(sweep.condition);
  std::vector<Condition> found;
  for (const ConditionEntry& entry : entries) {
    Condition condition{entry.name, entry.unit, entry.last, {}};
    for (const Method& method : entry.methods) {
      for (const Variant& variant : method.variants) {
        condition.rows.push_back({method.id,
                                  variant.real,
                                  method.source,
                                  {},
                                  method.cause,
                                  method.remedy,
                                  {},
                                  {},
                                  name_of(method.measures),
                                  {}});
      }
    }
    found.push_back(std::move(condition));
  }
  std::vector<Task> tasks;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    auto row = found[i].rows.begin();
    for (const Method& method : entries[i].methods) {
      for (const Variant& variant : method.variants)
        tasks.push_back({&entries[i], &method, &variant, &*row++});
    }
  }
  // Tasks that wait for another program begin first.
  std::stable_partition(tasks.begin(), tasks.end(),
                        [](const Task& t) { return t.method->measures == Measure::pixels; });
  const Kept kept(sweep.cache, sweep.quick);
  std::mutex mutex;
  std::size_t done = 0;
  in_parallel(tasks.size(), threads(), [&](std::size_t i) {
    measure(tasks[i], kept, sweep.quick);
    const std::lock_guard lock(mutex);
    if (sweep.progress) sweep.progress(static_cast<double>(++done) / static_cast<double>(tasks.size()));
  });
  return found;
}

}  // namespace plumb::studies::stability
