#include "references/studies/needs/needs.hpp"

#include <algorithm>

#include "tracer/engine/render.hpp"

namespace plumb::studies {
namespace {

/// Every depth up to here is rendered; of deeper ones only those that the search tries.
constexpr int most_steps = 8;

double change(PictureJudge& judge, int depth) {
  Candidate candidate;
  const Image image = judge.rendered(RealType::float64, depth, candidate);
  return *judge.error_of(image).against_double;
}

/// Returns the least depth, found by bisection, whose picture in double is off by at most the bound.
int least_depth_for(PictureJudge& judge, double bound, DepthNeed& need) {
  int enough = need.asked, too_small = 0;
  while (enough - too_small > 1) {
    const int middle = too_small + (enough - too_small) / 2;
    const auto known = std::find_if(need.steps.begin(), need.steps.end(),
                                    [&](const DepthStep& step) { return step.depth == middle; });
    const double error = known != need.steps.end() ? known->error : change(judge, middle);
    if (known == need.steps.end()) need.steps.push_back({middle, error});
    (error <= bound ? enough : too_small) = middle;
  }
  return enough;
}

DepthNeed depth_need(PictureJudge& judge, const Observed& observed, double bound) {
  DepthNeed need;
  need.asked = judge.job().options.depth;
  need.steps.push_back({need.asked, 0});
  for (int depth = 1; depth < std::min(need.asked, most_steps + 1); ++depth)
    need.steps.push_back({depth, change(judge, depth)});
  need.same_from = least_depth_for(judge, 0, need);
  need.within_bound_from = least_depth_for(judge, bound, need);
  std::sort(need.steps.begin(), need.steps.end(),
            [](const DepthStep& a, const DepthStep& b) { return a.depth < b.depth; });
  if (observed.black_at_limit > 0 && need.asked < max_depth)
    need.change_beyond = change(judge, need.asked + 1);
  return need;
}

bool is_same_without(const Scene& scene, const Camera& camera, const PictureJudge& judge,
                     const Untouched& untouched) {
  if (untouched.shapes.empty() && untouched.lights.empty()) return true;
  RenderJob job = judge.job();
  job.real = RealType::float64;
  return engine::render(without(scene, untouched), camera, job).rgb == judge.picture(RealType::float64).rgb;
}

}  // namespace

Needs needs_of(const Scene& scene, const Camera& camera, const RenderJob& job, double bound) {
  RenderJob silent = job;
  silent.progress = {};
  const auto share = [&](double from, double to) {
    return job.progress ? [&job, from, to](double f) { job.progress(from + f * (to - from)); }
                        : std::function<void(double)>();
  };
  Needs needs;
  RenderJob observing = job;
  observing.progress = share(0, 0.3);
  needs.observed = observe(scene, camera, observing);
  needs.features = features_of(scene, camera, job.options, needs.observed);
  needs.untouched = untouched_by(scene, needs.observed, job.options);
  PictureJudge judge(scene, camera, silent);
  if (job.progress) job.progress(0.6);
  needs.in_float = judge.candidate(RealType::float32);
  needs.in_double = judge.candidate(RealType::float64);
  needs.oracle_pixels = judge.oracle().pixels.size();
  needs.is_same_without_untouched = is_same_without(scene, camera, judge, needs.untouched);
  needs.depth = depth_need(judge, needs.observed, bound);
  RenderJob measuring = job;
  measuring.progress = share(0.7, 1);
  needs.costs = measure_costs(scene, camera, measuring,
                              needs.is_same_without_untouched ? needs.untouched : Untouched{});
  return needs;
}

std::string sufficient_real(const Needs& needs, double bound) {
  if (needs.oracle_pixels == 0) return "not measured";
  if (needs.in_float.error.largest() <= bound) return "float";
  return needs.in_double.error.largest() <= bound ? "double" : "neither";
}

}  // namespace plumb::studies
