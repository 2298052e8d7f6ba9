#include "references/gates/against_baseline.hpp"

#include <algorithm>

namespace plumb::gates {
namespace {

comparison::PictureView view_of(const Image& image) {
  return {image.width, image.height, 3, image.rgb.data()};
}

/// The image, with the baseline's values where a pixel does not count or is within a relative limit: there
/// is nothing to explain.
Image with_what_is_allowed(const BaselineJob& job) {
  Image allowed = job.image;
  const comparison::PixelMask mask = mask_of(job.bounds, allowed.width, allowed.height);
  for (int y = 0; y < allowed.height; ++y) {
    for (int x = 0; x < allowed.width; ++x) {
      const float* const baseline = job.baseline.pixel(x, y);
      const bool is_allowed = job.bounds.limit.is_relative() &&
                              comparison::is_within(baseline, job.image.pixel(x, y), job.bounds.limit);
      if (!mask.has(x, y) || is_allowed) std::copy_n(baseline, 3, allowed.pixel(x, y));
    }
  }
  return allowed;
}

}  // namespace

BoundedComparison judge_own(const Shot& shot, const renderers::Resolution& resolution, const BaselineJob& job,
                            SceneResult& result) {
  const BoundedComparison bounded = compare_within(job.baseline, job.image, job.bounds);
  const bool is_whole = !job.bounds.has_regions() && !job.bounds.limit.is_relative();
  const Image allowed = is_whole ? Image() : with_what_is_allowed(job);
  const auto job_with = [&](const Image& test) {
    return attribution::AttributionJob{shot, job.baseline, test, job.bounds.limit.tolerance, resolution};
  };
  const attribution::AttributionJob traced = job_with(is_whole ? job.image : allowed);
  judge(traced, result);
  result.comparison = bounded.comparison;
  result.mask = mask_of(job.bounds, job.image.width, job.image.height);
  if (bounded.agrees()) result.status = Status::agree;
  if (job.keeps_pictures) result.pictures = pictures_of(job_with(job.image));
  return bounded;
}

BoundedComparison judge_others(const BaselineJob& job, SceneResult& result) {
  const BoundedComparison bounded = compare_within(job.baseline, job.image, job.bounds);
  result.mask = mask_of(job.bounds, job.image.width, job.image.height);
  for (const PixelPlace place :
       comparison::pixels_over(job.baseline, job.image, job.bounds.limit, result.mask))
    result.budget.pixels.push_back({place.x, place.y, attribution::Cause::unexplained});
  result.metrics = comparison::cheap_metrics(view_of(job.baseline), view_of(job.image));
  result.comparison = bounded.comparison;
  result.status = bounded.agrees() ? Status::agree : Status::differ;
  result.no_figures.reset();
  if (!job.keeps_pictures) return bounded;
  auto pictures = std::make_shared<Pictures>();
  pictures->reference = std::make_shared<const Image>(job.baseline);
  pictures->ours = std::make_shared<const Image>(job.image);
  result.pictures = std::move(pictures);
  return bounded;
}

}  // namespace plumb::gates
