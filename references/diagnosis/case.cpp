#include "references/diagnosis/case.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include "references/diagnosis/evidence.hpp"
#include "references/diagnosis/remains.hpp"

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

/// One picture, asked whether the tracer that made it can have a fault.
class Witness {
 public:
  Witness(const CasePicture& picture, std::optional<double> tolerance)
      : picture_(picture),
        evidence_(picture.shot.scene, picture.shot.camera, job_of(picture.shot), picture.seen, tolerance) {
    Faults named;
    for (const FoundFault& found : picture.diagnosis.faults) named.push_back(found.fault);
    set_ = set_of(named);
    as_named_ = within(evidence_, set_, picture.diagnosis.encoding, evidence_.survey());
  }

  /// True if the picture is right where it would not be with the fault, and hardly ever the other way round.
  bool contradicts(const faults::Fault& fault) {
    const auto [known, is_new] = answers_.try_emplace(&fault, false);
    if (is_new) known->second = !is_named(fault) && is_worse_with(fault);
    return known->second;
  }

 private:
  bool knows_the_camera() const {
    return picture_.diagnosis.verdict != PictureVerdict::unexplained ||
           picture_.diagnosis.certain.camera == Certainty::right;
  }

  bool is_named(const faults::Fault& fault) const {
    return std::ranges::any_of(picture_.diagnosis.faults,
                               [&](const FoundFault& found) { return has(with_its_like(found), fault); });
  }

  bool is_worse_with(const faults::Fault& fault) const {
    if (!knows_the_camera()) return false;
    const std::size_t index = set_of({&fault}).front();
    if (std::ranges::find(set_, index) != set_.end()) return false;
    const auto otherwise =
        within(evidence_, with(set_, index), picture_.diagnosis.encoding, evidence_.survey());
    std::size_t lost = 0, gained = 0;
    for (std::size_t i = 0; i < otherwise.size(); ++i) {
      lost += as_named_[i] && !otherwise[i] ? 1 : 0;
      gained += !as_named_[i] && otherwise[i] ? 1 : 0;
    }
    // because outlines and roundings are less than a hundredth, and what is lost by chance is gained as often
    constexpr std::size_t least = 20, one_in = 100, times = 8;
    return lost >= std::max(least, otherwise.size() / one_in) && lost >= times * gained;
  }

  const CasePicture& picture_;
  Evidence evidence_;
  FaultSet set_;
  std::vector<bool> as_named_;
  std::map<const faults::Fault*, bool> answers_;
};

class Joining {
 public:
  Joining(const std::vector<CasePicture>& pictures, std::optional<double> tolerance) : pictures_(pictures) {
    for (const CasePicture& picture : pictures)
      witnesses_.push_back(std::make_unique<Witness>(picture, tolerance));
  }

  CaseDiagnosis result() {
    for (std::size_t i = 0; i < pictures_.size(); ++i) {
      for (const FoundFault& found : pictures_[i].diagnosis.faults) add(found, i);
      add(pictures_[i].diagnosis.certain);
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

  std::optional<std::size_t> contradicted_by(const faults::Fault& fault, std::size_t picture) {
    for (std::size_t other = 0; other < witnesses_.size(); ++other)
      if (other != picture && witnesses_[other]->contradicts(fault)) return other;
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

  const std::vector<CasePicture>& pictures_;
  std::vector<std::unique_ptr<Witness>> witnesses_;
  CaseDiagnosis result_;
};

}  // namespace

CaseDiagnosis diagnosis_of_case(const std::vector<CasePicture>& pictures, std::optional<double> tolerance) {
  return Joining(pictures, tolerance).result();
}

}  // namespace plumb::diagnosis
