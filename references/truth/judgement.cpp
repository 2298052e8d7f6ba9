#include "references/truth/judgement.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "references/comparison/comparison.hpp"

namespace plumb::truth {
namespace {

/// Whether each side is wrong.
struct Wrong {
  bool ours = true;
  bool reference = true;

  bool any() const { return ours || reference; }
  void weigh(const Answers& answers, const float* our_value, const float* reference_value, double tolerance) {
    ours = ours && !answers.allow(our_value, tolerance);
    reference = reference && !answers.allow(reference_value, tolerance);
  }
  Verdict verdict() const {
    if (ours && reference) return Verdict::both_wrong;
    if (!any()) return Verdict::undecided;
    return ours ? Verdict::ours_wrong : Verdict::reference_wrong;
  }
};

class PixelJudge {
 public:
  PixelJudge(const attribution::AttributionJob& job, double most_work)
      : job_(job), work_(most_work), oracle_(job.shot, work_) {}

  bool is_out_of_work() const { return work_.is_over(); }

  /// Nothing when the pixel has too many rays, or the work is over before the verdict stands.
  std::optional<JudgedPixel> judged(const PixelPlace& p) const {
    const auto trial = tried(p, [](const Trial& t) { return !t.wrong.any(); });
    if (!trial) return std::nullopt;
    const float* const ours = job_.test.pixel(p.x, p.y);
    const float* const reference = job_.reference.pixel(p.x, p.y);
    return JudgedPixel{p.x,
                       p.y,
                       trial->wrong.verdict(),
                       {ours[0], ours[1], ours[2]},
                       {reference[0], reference[1], reference[2]},
                       trial->as_written};
  }

  /// Whether the scene's last digits leave both values open; else, or when that is not found out, no.
  bool leaves_open(const PixelPlace& p) const {
    const auto is_open = [this](const Trial& t) {
      return !t.wrong.any() && !t.answers.is_decided(job_.tolerance);
    };
    const auto trial = tried(p, is_open);
    return trial && is_open(*trial);
  }

 private:
  struct Trial {
    Rgbd as_written;
    Answers answers;
    Wrong wrong;
  };

  /// Widens the answers until the question is settled or all patterns are tried: more can only acquit.
  template <class IsSettled>
  std::optional<Trial> tried(const PixelPlace& p, IsSettled is_settled) const {
    const auto as_written = oracle_.colour(p.x, p.y);
    if (!as_written) return std::nullopt;
    Trial trial{Rgbd(*as_written), {to_colour(*as_written), to_colour(*as_written)}, {}};
    weigh(p, trial);
    for (int pattern = 0; pattern < oracle_.all_patterns(); ++pattern) {
      if (is_settled(trial)) break;
      const auto moved = oracle_.colour_when_moved(p.x, p.y, pattern);
      if (!moved || work_.is_over()) return std::nullopt;
      trial.answers.include(to_colour(*moved));
      weigh(p, trial);
    }
    return trial;
  }
  void weigh(const PixelPlace& p, Trial& trial) const {
    trial.wrong.weigh(trial.answers, job_.test.pixel(p.x, p.y), job_.reference.pixel(p.x, p.y),
                      job_.tolerance);
  }

  const attribution::AttributionJob& job_;
  mutable textbook::Work work_;
  Oracle oracle_;
};

}  // namespace

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::ours_wrong:
      return "ours_wrong";
    case Verdict::reference_wrong:
      return "reference_wrong";
    case Verdict::both_wrong:
      return "both_wrong";
    case Verdict::undecided:
      break;
  }
  return "undecided";
}

std::size_t Judgement::count(Verdict verdict) const {
  return static_cast<std::size_t>(std::count_if(pixels.begin(), pixels.end(),
                                                [&](const JudgedPixel& p) { return p.verdict == verdict; }));
}

void reconcile(const Judgement& judgement, attribution::Budget& budget) {
  std::map<std::pair<int, int>, Verdict> verdicts;
  for (const JudgedPixel& p : judgement.pixels) verdicts.emplace(std::pair(p.x, p.y), p.verdict);
  for (attribution::AttributedPixel& p : budget.pixels) {
    const auto verdict = verdicts.find({p.x, p.y});
    if (verdict == verdicts.end() || verdict->second == Verdict::reference_wrong) continue;
    if (verdict->second != Verdict::undecided)
      p.cause = attribution::Cause::unexplained;
    else if (p.cause == attribution::Cause::unexplained)
      p.cause = attribution::Cause::undecided;
  }
  budget.unexamined = std::min(budget.unexamined, budget.count(attribution::Cause::unexplained));
}

void settle_undecided(const attribution::AttributionJob& job, attribution::Budget& budget) {
  const std::size_t left = budget.count(attribution::Cause::unexplained);
  const std::size_t pixels = job.test.rgb.size() / 3;
  if (job.resolution.is_of_plumb || left == 0 || 100 * left > pixels) return;
  const PixelJudge judge(job, most_work_of_judgement);
  for (attribution::AttributedPixel& p : budget.pixels) {
    if (p.cause == attribution::Cause::unexplained && judge.leaves_open({p.x, p.y}))
      p.cause = attribution::Cause::undecided;
  }
  budget.unexamined = std::min(budget.unexamined, budget.count(attribution::Cause::unexplained));
}

Judgement judge_pixels(const attribution::AttributionJob& job, double most_work) {
  Judgement judgement;
  const std::vector<PixelPlace> over = comparison::pixels_over(job.reference, job.test, job.tolerance);
  if (over.empty()) return judgement;
  const PixelJudge judge(job, most_work);
  for (const PixelPlace& p : over) {
    if (judge.is_out_of_work()) break;
    if (const auto pixel = judge.judged(p)) judgement.pixels.push_back(*pixel);
  }
  judgement.ran_out = judge.is_out_of_work();
  judgement.not_judged = over.size() - judgement.pixels.size();
  return judgement;
}

}  // namespace plumb::truth
