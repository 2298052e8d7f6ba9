#include "references/diagnosis/case.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace plumb::diagnosis {
namespace {

using Faults = std::vector<const faults::Fault*>;

bool has(const Faults& faults, const faults::Fault& fault) {
  return std::ranges::any_of(faults, [&](const faults::Fault* each) { return each->id == fault.id; });
}

Faults with_its_like(const FoundFault& found) {
  Faults all{found.fault};
  all.insert(all.end(), found.alike.begin(), found.alike.end());
  return all;
}

class Joining {
 public:
  explicit Joining(const std::vector<const Diagnosis*>& pictures) : pictures_(pictures) {}

  CaseDiagnosis result() {
    for (std::size_t i = 0; i < pictures_.size(); ++i) {
      if (pictures_[i] == nullptr) continue;
      for (const FoundFault& found : pictures_[i]->faults) add(found, i);
      add(pictures_[i]->certain);
    }
    std::ranges::stable_sort(result_.faults, [](const CaseFault& a, const CaseFault& b) {
      return a.pictures.size() > b.pictures.size();
    });
    return std::move(result_);
  }

 private:
  void add(const FoundFault& found, std::size_t picture) {
    const Faults all = with_its_like(found);
    Faults left;
    std::optional<std::size_t> against;
    for (const faults::Fault* fault : all) {
      const auto by = contradicted_by(*fault, picture);
      if (!by) left.push_back(fault);
      if (!against) against = by;
    }
    if (left.empty()) {
      result_.withdrawn.push_back({found.fault, picture, *against});
      return;
    }
    const double explains = std::min(1.0, found.confidence * static_cast<double>(all.size()));
    for (CaseFault& known : result_.faults)
      if (joins(known, left, explains, picture)) return;
    result_.faults.push_back({left.front(),
                              {left.begin() + 1, left.end()},
                              explains / static_cast<double>(left.size()),
                              {picture}});
  }

  std::optional<std::size_t> contradicted_by(const faults::Fault& fault, std::size_t picture) const {
    for (std::size_t other = 0; other < pictures_.size(); ++other) {
      if (other == picture || pictures_[other] == nullptr) continue;
      const Faults& excluded = pictures_[other]->excluded;
      if (std::ranges::find(excluded, &fault) != excluded.end()) return other;
    }
    return {};
  }

  /// Keeps what both may be, if they may be one.
  static bool joins(CaseFault& known, const Faults& left, double explains, std::size_t picture) {
    Faults before{known.fault};
    before.insert(before.end(), known.alike.begin(), known.alike.end());
    Faults both;
    for (const faults::Fault* fault : before)
      if (has(left, *fault)) both.push_back(fault);
    if (both.empty()) return false;
    const double share = std::max(explains, known.confidence * static_cast<double>(before.size()));
    known.fault = both.front();
    known.alike = {both.begin() + 1, both.end()};
    known.confidence = share / static_cast<double>(both.size());
    if (known.pictures.back() != picture) known.pictures.push_back(picture);
    return true;
  }

  static void join(Certainty& all, Certainty one) {
    if (all != Certainty::wrong && one != Certainty::unknown) all = one;
  }
  void add(const Certain& certain) {
    join(result_.certain.camera, certain.camera);
    join(result_.certain.shadows, certain.shadows);
    join(result_.certain.shading, certain.shading);
  }

  const std::vector<const Diagnosis*>& pictures_;
  CaseDiagnosis result_;
};

}  // namespace

CaseDiagnosis diagnosis_of_case(const std::vector<const Diagnosis*>& pictures) {
  return Joining(pictures).result();
}

}  // namespace plumb::diagnosis
