#include "references/diagnosis/diagnosis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "references/diagnosis/search.hpp"

namespace plumb::references {
namespace {

/// because float and double fall on either side of a level
constexpr float rounding = 1;
/// because an error of another kind may add to it
constexpr float close = 2;
/// The share of what is seen that has to be right, so that faults are an explanation: because of 500 other
/// scenes' pictures the likest had 75 % in place with five faults, and 72 % with one.
constexpr double enough = 0.76;
/// because a right float picture has up to so many pixels across an edge
constexpr double edges = 0.005;

bool is_close(float difference) { return difference <= close; }

/// The commonest colour of the picture, as the levels of its first pixel that has it.
std::size_t a_pixel_of_the_background(const Evidence& evidence, std::size_t pixels) {
  std::map<std::array<float, 3>, std::pair<std::size_t, std::size_t>> counts;  // how many, the first
  for (std::size_t i = 0; i < pixels; ++i) {
    const float* level = evidence.seen(i);
    auto& [count, first] = counts.try_emplace({level[0], level[1], level[2]}, 0, i).first->second;
    ++count;
  }
  return std::max_element(counts.begin(), counts.end(),
                          [](const auto& a, const auto& b) { return a.second.first < b.second.first; })
      ->second.second;
}

/// Of the pixels that are not background, or should not be, those that are right.
double share_explained(const Evidence& evidence, const std::vector<float>& differences) {
  const float* background = evidence.seen(a_pixel_of_the_background(evidence, differences.size()));
  std::size_t shown = 0;
  std::size_t right = 0;
  for (std::size_t i = 0; i < differences.size(); ++i) {
    if (std::equal(background, background + 3, evidence.seen(i)) && is_close(differences[i])) continue;
    ++shown;
    right += is_close(differences[i]) ? 1 : 0;
  }
  return shown == 0 ? 1 : static_cast<double>(right) / static_cast<double>(shown);
}

std::size_t over(const std::vector<float>& differences) {
  return static_cast<std::size_t>(
      std::count_if(differences.begin(), differences.end(), [](float d) { return !is_close(d); }));
}

void set_remaining(const std::vector<float>& differences, Diagnosis& diagnosis) {
  double squares = 0;
  for (const float d : differences) squares += double{d} * d;
  diagnosis.pixels = differences.size();
  diagnosis.pixels_over = over(differences);
  diagnosis.rms = std::sqrt(squares / static_cast<double>(differences.size())) / 255;
}

/// The faults that give the same picture in the place of one of a set.
std::vector<const Fault*> alike(const Evidence& evidence, const Fit& fit, std::size_t fault) {
  const FaultSet rest = without(fit.set, fault);
  std::vector<FaultSet> exchanged;
  for (std::size_t other = 0; other < fault_catalogue().size(); ++other) {
    if (std::binary_search(fit.set.begin(), fit.set.end(), other)) continue;
    exchanged.push_back(with(rest, other));
  }
  std::vector<const Fault*> found;
  for (const FaultSet& set : evidence.alike(fit, exchanged)) {
    const auto other = std::find_if(set.begin(), set.end(), [&](std::size_t f) {
      return !std::binary_search(rest.begin(), rest.end(), f);
    });
    found.push_back(&fault_catalogue()[*other]);
  }
  return found;
}

/// Pixels of the survey that are right with a fault and not without it: within two levels, and exactly.
struct Righted {
  std::size_t close = 0;
  std::size_t exact = 0;
};

/// Of each fault of the fit, in its order.
std::vector<Righted> righted_by_each(const Evidence& evidence, const Fit& fit) {
  const std::vector<float> together = evidence.differences_at(fit, evidence.survey());
  std::vector<Righted> all;
  for (const std::size_t fault : fit.set) {
    const std::vector<float> otherwise =
        evidence.differences_at({without(fit.set, fault), fit.encoding, 0, 0}, evidence.survey());
    Righted righted;
    for (std::size_t i = 0; i < together.size(); ++i) {
      righted.close += is_close(together[i]) && !is_close(otherwise[i]) ? 1 : 0;
      righted.exact += together[i] < rounding && otherwise[i] >= rounding ? 1 : 0;
    }
    all.push_back(righted);
  }
  return all;
}

/// Takes out what only brings wrong pixels nearer, or a few of them to their level: that may be anything.
std::vector<Righted> without_idle(const Evidence& evidence, Fit& fit) {
  constexpr double few = 0.0005;  // because float and double disagree in up to 18 pixels of 153,600
  const auto wanted = static_cast<std::size_t>(few * static_cast<double>(evidence.survey().size()));
  for (;;) {
    std::vector<Righted> righted = righted_by_each(evidence, fit);
    const auto idle = std::find_if(righted.begin(), righted.end(),
                                   [&](const Righted& r) { return r.close == 0 && r.exact <= wanted; });
    if (idle == righted.end()) return righted;
    fit.set.erase(fit.set.begin() + (idle - righted.begin()));
  }
}

FoundFault found_fault(const Evidence& evidence, const Fit& fit, std::size_t fault, double explained,
                       const Righted& righted) {
  FoundFault found{&fault_catalogue()[fault], 0, 0, alike(evidence, fit, fault)};
  found.pixels = righted.close * evidence.pixels_of_picture() / evidence.survey().size();
  found.confidence = explained / static_cast<double>(1 + found.alike.size());
  return found;
}

/// A picture of one colour, which tells too little to name more than one fault.
bool is_blank(const ImageFile& seen) {
  const auto channels = static_cast<std::size_t>(seen.channels);
  for (std::size_t i = channels; i < seen.values.size(); ++i) {
    if (seen.values[i] != seen.values[i - channels]) return false;
  }
  return true;
}

}  // namespace

const char* to_string(PictureVerdict verdict) {
  if (verdict == PictureVerdict::right) return "right";
  return verdict == PictureVerdict::faults ? "faults" : "unexplained";
}

Diagnosis diagnose(const Scene& scene, const Camera& camera, const textbook::RenderJob& job,
                   const ImageFile& seen) {
  Evidence evidence(scene, camera, job, seen);
  Fit fit = explain(evidence);
  const std::vector<Righted> righted = without_idle(evidence, fit);
  const std::vector<float> differences = evidence.differences(fit);
  Diagnosis diagnosis;
  diagnosis.encoding = fit.encoding;
  diagnosis.explained = share_explained(evidence, differences);
  set_remaining(differences, diagnosis);
  for (std::size_t i = 0; i < fit.set.size(); ++i) {
    diagnosis.faults.push_back(found_fault(evidence, fit, fit.set[i], diagnosis.explained, righted[i]));
    diagnosis.is_flipped |= fault_catalogue()[fit.set[i]].id == "upside-down";
  }
  std::stable_sort(diagnosis.faults.begin(), diagnosis.faults.end(),
                   [](const FoundFault& a, const FoundFault& b) { return a.pixels > b.pixels; });
  const auto wrong =
      std::count_if(differences.begin(), differences.end(), [](float d) { return d > rounding; });
  const bool is_right = static_cast<double>(wrong) <= edges * static_cast<double>(differences.size());
  const bool is_explained =
      fit.set.empty() ? is_right : diagnosis.explained >= enough && !(fit.set.size() > 1 && is_blank(seen));
  if (is_explained)
    diagnosis.verdict = fit.set.empty() ? PictureVerdict::right : PictureVerdict::faults;
  else
    diagnosis.faults.clear();  // who does not believe them does not name them
  return diagnosis;
}

}  // namespace plumb::references
