#include "references/attribution/attribution.hpp"

#include <algorithm>
#include <optional>

#include "references/attribution/by_depth.hpp"
#include "references/attribution/by_format.hpp"
#include "references/attribution/by_moves.hpp"

namespace plumb::attribution {
namespace {

// A picture that differs as a whole is no matter of chance: one pixel of the sample that has no cause settles
// the verdict.
constexpr std::size_t most_without_sample = 2000;
constexpr std::size_t pixels_of_sample = 256;

/// Attributes the pixels of one picture, cause by cause.
class Attribution {
 public:
  explicit Attribution(const AttributionJob& job) : job_(job), inquiry_(job) {}

  Budget run() {
    for (const PixelPlace p : comparison::pixels_over(job_.reference, job_.test, job_.tolerance)) {
      budget_.pixels.push_back({p.x, p.y, Cause::unexplained});
    }
    if (job_.holds != renderers::Holds::float32) explain_by_format(inquiry_, still_unexplained());
    const SuspectPixels all = still_unexplained();
    if (all.size() > most_without_sample && !is_explained(sample_of(all))) {
      budget_.unexamined = all.size() - sample_of(all).size();
    } else {
      explain(still_unexplained());
      if (inquiry_.work().is_over()) budget_.unexamined = still_unexplained().size();
    }
    return std::move(budget_);
  }

 private:
  SuspectPixels still_unexplained() {
    SuspectPixels pixels;
    for (AttributedPixel& p : budget_.pixels) {
      if (p.cause == Cause::unexplained && inquiry_.is_finite(p)) pixels.push_back(&p);
    }
    return pixels;
  }

  static SuspectPixels sample_of(const SuspectPixels& all) {
    SuspectPixels sample;
    for (std::size_t i = 0; i < pixels_of_sample; ++i)
      sample.push_back(all[i * all.size() / pixels_of_sample]);
    return sample;
  }

  bool is_explained(const SuspectPixels& pixels) {
    explain(pixels);
    return std::all_of(pixels.begin(), pixels.end(),
                       [](const AttributedPixel* p) { return p->cause != Cause::unexplained; });
  }

  void explain(const SuspectPixels& pixels) {
    for (const ShapeId id : explain_by_moves(inquiry_, pixels)) add_name(inquiry_.scene().shapes[id].name);
    if (job_.resolution.is_of_plumb) return;
    for (const int more : {-1, 1}) explain_by_depth(inquiry_, job_.shot.options.depth + more, pixels);
  }

  void add_name(const std::string& name) {
    if (std::find(budget_.shapes.begin(), budget_.shapes.end(), name) == budget_.shapes.end())
      budget_.shapes.push_back(name);
  }

  const AttributionJob& job_;
  Inquiry inquiry_;
  Budget budget_;
};

/// What a cause may have alone.
std::optional<std::size_t> most_of(CauseBound bound, int width, int height) {
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  switch (bound) {
    case CauseBound::lines:
      return std::min(2 * static_cast<std::size_t>(width) + 2 * static_cast<std::size_t>(height),
                      16 + pixels / 20);
    case CauseBound::few:
      return 16 + pixels / 100;
    case CauseBound::none:
    case CauseBound::unverified:
      break;
  }
  return std::nullopt;
}

}  // namespace

std::size_t Budget::count(Cause cause) const {
  return static_cast<std::size_t>(std::count_if(pixels.begin(), pixels.end(),
                                                [&](const AttributedPixel& p) { return p.cause == cause; }));
}

std::size_t Budget::unverified() const {
  std::size_t all = 0;
  for (const CauseRow& row : cause_rows())
    if (row.bound == CauseBound::unverified) all += count(row.cause);
  return all;
}

Budget attribute(const AttributionJob& job) { return Attribution(job).run(); }

std::optional<BrokenBound> broken_bound(const Budget& budget, int width, int height) {
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  for (const CauseRow& row : cause_rows()) {
    const std::optional<std::size_t> most = most_of(row.bound, width, height);
    const std::size_t found = budget.count(row.cause);
    if (most && found > *most) return BrokenBound{row.cause, found, *most};
  }
  if (100 * budget.unverified() <= pixels) return std::nullopt;
  return BrokenBound{std::nullopt, budget.unverified(), pixels / 100};
}

}  // namespace plumb::attribution
