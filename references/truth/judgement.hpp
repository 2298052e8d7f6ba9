// Tells who is wrong where two pictures differ, as the oracle sees it.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "references/attribution/attribution.hpp"
#include "references/truth/oracle.hpp"

namespace plumb::truth {

/// The verdict on a pixel that is over the tolerance. A side is wrong when its value is not finite, or not
/// within the tolerance of any answer that the scene leaves open (see Oracle).
enum class Verdict {
  ours_wrong,
  reference_wrong,
  both_wrong,
  undecided,  ///< neither is wrong: both are answers, or the true one lies between them
};

inline constexpr std::array all_verdicts{Verdict::ours_wrong, Verdict::reference_wrong, Verdict::both_wrong,
                                         Verdict::undecided};

/// As it stands in JSON, e.g. "ours_wrong".
const char* to_string(Verdict verdict);

struct JudgedPixel {
  int x;
  int y;
  Verdict verdict;
  attribution::Colour ours;
  attribution::Colour reference;
  Rgbd oracle;  ///< for the scene as it is written
};

struct Judgement {
  std::vector<JudgedPixel> pixels;  ///< row by row
  std::size_t not_judged = 0;       ///< number over that were not judged: no work left, or too many rays
  bool ran_out = false;             ///< true if the work was used up

  std::size_t count(Verdict verdict) const;
};

/// The most that is spent on one scene, in units of Work; 5 to 10 s on a machine of 2023.
inline constexpr double most_work_of_judgement = 1e9;

/// Changes the budget so that no two outputs contradict each other. A pixel at which our side is wrong is no
/// matter of chance, whatever proof the budget has, and becomes unexplained. An unexplained one that is
/// undecided becomes undecided there, too.
void reconcile(const Judgement& judgement, attribution::Budget& budget);

/// Looks at the pixels without a cause if they are few, at most as many as may be unverified. Those become
/// undecided at which the scene has answers (see Oracle) that are farther apart than the tolerance, and that
/// allow both values. Against a baseline that is no excuse.
void settle_undecided(const attribution::AttributionJob& job, attribution::Budget& budget);

/// Judges every pixel over the tolerance, row by row, until the work is done. `job.work` and `job.holds`
/// are not used: a value that was rounded or clamped is wrong like any other.
Judgement judge_pixels(const attribution::AttributionJob& job, double most_work = most_work_of_judgement);

}  // namespace plumb::truth
