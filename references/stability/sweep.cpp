#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <stdexcept>

#include "references/digest.hpp"
#include "references/stability/atlas.hpp"
#include "references/stability/catalogue.hpp"
#include "tracer/image/files.hpp"

namespace plumb::references::stability {
namespace {

/// The worst of all rays at one value.
struct Worst {
  bool missed = false, self_shadow = false, counts = false;
  double ulps = 0, relative = 0;
};

class Sweeper {
 public:
  Sweeper(const Experiment& experiment, const ConditionEntry& entry, bool quick)
      : experiment_(experiment),
        entry_(entry),
        rays_(std::max(10, quick ? entry.rays / 8 : entry.rays)),
        points_(quick ? 13 : 37) {}

  void fill(Row& row) {
    std::vector<std::pair<double, Worst>> all;
    for (int i = 0; i < points_; ++i) {
      const double value = rounded(std::pow(entry_.last, static_cast<double>(i) / (points_ - 1)));
      if (!all.empty() && value == all.back().first) continue;
      all.emplace_back(value, at(value));
      const Worst& w = all.back().second;
      row.curve.emplace_back(value, !w.counts                   ? std::numeric_limits<double>::quiet_NaN()
                                    : w.missed || w.self_shadow ? 1
                                                                : std::min(1.0, w.relative));
    }
    row.breaks.missed = first(all, [](const Worst& w) { return w.missed; });
    row.breaks.ulp16 = first(all, [](const Worst& w) { return w.ulps > 16; });
    row.breaks.e6 = first(all, [](const Worst& w) { return w.relative > 1e-6; });
    row.breaks.percent = first(all, [](const Worst& w) { return w.relative > 0.01; });
    row.breaks.self_shadow = first(all, [](const Worst& w) { return w.self_shadow; });
  }

 private:
  double rounded(double value) const { return entry_.is_whole ? std::round(value) : value; }

  /// The same rays at every value, so that bisection sees one condition change.
  Worst at(double value) const {
    Random random(1);
    Worst worst;
    for (int i = 0; i < rays_; ++i) {
      const Trial trial = experiment_(value, random);
      if (!trial.counts) continue;
      worst.counts = true;
      worst.missed |= trial.missed;
      worst.self_shadow |= trial.self_shadow;
      if (trial.missed) continue;
      worst.ulps = std::max(worst.ulps, trial.ulps);
      worst.relative = std::max(worst.relative, trial.relative);
    }
    return worst;
  }

  template <class Fails>
  std::optional<double> first(const std::vector<std::pair<double, Worst>>& all, Fails fails) const {
    const auto found = std::find_if(all.begin(), all.end(), [&](const auto& p) { return fails(p.second); });
    if (found == all.end()) return std::nullopt;
    if (found == all.begin()) return found->first;
    double good = std::prev(found)->first, bad = found->first;
    for (int step = 0; step < 6; ++step) {  // 2 % of a decade, finer than the spread between seeds
      const double middle = rounded(std::sqrt(good * bad));
      if (middle == good || middle == bad) break;
      (fails(at(middle)) ? bad : good) = middle;
    }
    return bad;
  }

  const Experiment& experiment_;
  const ConditionEntry& entry_;
  int rays_;
  int points_;
};

using Json = nlohmann::ordered_json;

std::optional<double> number(const Json& json) {
  return json.is_null() ? std::nullopt : std::optional<double>(json.get<double>());
}

/// Finished rows, each a file named by all that determines it.
class Kept {
 public:
  Kept(std::string directory, bool quick) : directory_(std::move(directory)), quick_(quick) {}

  bool find(const std::string& condition, Row& row) const {
    std::error_code error;
    if (directory_.empty() || !std::filesystem::is_regular_file(path(condition, row), error)) return false;
    const Json json = Json::parse(read_file(path(condition, row)), nullptr, false);
    if (!json.is_object() || !json.contains("breaks") || !json.contains("curve")) return false;
    const Json& b = json["breaks"];
    row.breaks = {number(b["missed"]), number(b["ulp16"]), number(b["e6"]), number(b["percent"]),
                  number(b["self_shadow"])};
    for (const Json& point : json["curve"])
      row.curve.emplace_back(point[0], number(point[1]).value_or(std::numeric_limits<double>::quiet_NaN()));
    return true;
  }
  void keep(const std::string& condition, const Row& row, const Json& json) const {
    if (directory_.empty()) return;
    std::error_code error;
    std::filesystem::create_directories(directory_, error);
    if (!error) write_file(path(condition, row), json.dump());
  }

 private:
  std::string path(const std::string& condition, const Row& row) const {
    constexpr const char* settings = "rows 4";  // another number when a method or a sweep changes
    return directory_ + "/stability-" +
           sha256(std::string(PLUMB_VERSION) + " " + settings + " " + condition + " " + row.method + " " +
                  row.real + (quick_ ? " quick" : " full")) +
           ".json";
  }
  std::string directory_;
  bool quick_;
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

}  // namespace

std::vector<Condition> stability(const Sweep& sweep) {
  const std::vector<ConditionEntry> entries = chosen(sweep.condition);
  std::size_t rows = 0, done = 0;
  for (const ConditionEntry& entry : entries) rows += entry.methods.size() * real_names.size();
  const Kept kept(sweep.cache, sweep.quick);
  std::vector<Condition> found;
  for (const ConditionEntry& entry : entries) {
    Condition condition{entry.name, entry.unit, entry.last, {}};
    for (const Method& method : entry.methods) {
      for (std::size_t real = 0; real < real_names.size(); ++real) {
        Row row{method.id, real_names[real], method.source, {}, method.cause, method.remedy, {}};
        if (!kept.find(entry.name, row)) {
          Sweeper(method.in_real[real], entry, sweep.quick).fill(row);
          kept.keep(entry.name, row,
                    to_json({{entry.name, entry.unit, entry.last, {row}}})["conditions"][0]["rows"][0]);
        }
        condition.rows.push_back(std::move(row));
        if (sweep.progress) sweep.progress(static_cast<double>(++done) / static_cast<double>(rows));
      }
    }
    found.push_back(std::move(condition));
  }
  return found;
}

}  // namespace plumb::references::stability
