#include "references/gates/verify.hpp"

#include <time.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <mutex>

#include "tracer/format/reader.hpp"
#include "tracer/system/in_parallel.hpp"

namespace plumb::gates {
namespace {

/// A reference like POV-Ray mostly waits (0.65 s a run), so more runs than cores at once.
constexpr int runs_per_core = 4;

/// Of the calling thread, or of the process where one scene has all threads.
double cpu_seconds(bool of_process) {
  timespec now{};
  clock_gettime(of_process ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// One scene on both sides: as it is, and term by term.
class SceneVerifier {
 public:
  SceneVerifier(const VerifyOptions& options, const renderers::Renderer& reference, int threads,
                const Shot& shot, SceneResult& result)
      : options_(options), reference_(reference), threads_(threads), shot_(shot), result_(result) {}

  void whole(std::size_t warnings) {
    const renderers::Rendered reference = reference_.render(shot_);
    result_.cached = reference.cached;
    result_.stored = reference.stored;
    result_.seconds_reference = reference.cpu_seconds;
    const double before = cpu_seconds(threads_ > 1);
    const Image ours = ours_of(shot_, options_.real);
    result_.seconds_ours = cpu_seconds(threads_ > 1) - before;
    const attribution::AttributionJob whole = job(shot_, reference, ours);
    if (options_.judge) result_.judgement = truth::judge_pixels(whole);
    judge(whole, result_);
    result_.reference_title = reference_.facts().title;
    result_.reference_warnings = reference.warnings;
    result_.is_of_one_colour = is_of_one_colour(ours);
    result_.scene_warnings = warnings;
    if (options_.keeps_pictures) result_.pictures = pictures_of(whole);
    if (result_.status == Status::differ && options_.real == RealType::float32)
      result_.suspect = suspect_float(ours);
  }

  void by_terms() {
    for (const attribution::Term term : attribution::all_terms) {
      TermResult& result =
          result_.terms.emplace_back(TermResult{term, attribution::has(term, shot_.scene), {}});
      try {
        if (result.in_scene) compare_term(result);
      } catch (const std::runtime_error& error) {
        result.trouble = error.what();
      }
    }
  }

 private:
  FloatSuspect suspect_float(const Image& ours) const {
    try {
      const Image in_double = ours_of(shot_, RealType::float64);
      return {comparison::compare(in_double, ours, options_.tolerance).judged_error};
    } catch (const std::runtime_error&) {
      return {};  // the verdict stands without the figure
    }
  }

  void compare_term(TermResult& result) const {
    const attribution::TermScene reduced = attribution::only(result.term, shot_.scene, shot_.options);
    const Shot shot{reduced.scene, shot_.camera, shot_.width, shot_.height, reduced.options, shot_.file};
    const renderers::Rendered reference = reference_.render(shot);
    const Image ours = ours_of(shot, options_.real);
    result.comparison = comparison::compare(reference.image, ours, options_.tolerance);
    if (result.comparison->pixels_over > 0) {
      result.unexplained =
          attribution::attribute(job(shot, reference, ours)).count(attribution::Cause::unexplained);
    }
  }

  attribution::AttributionJob job(const Shot& shot, const renderers::Rendered& reference,
                                  const Image& ours) const {
    return {shot,           reference.image, ours, options_.tolerance, reference_.facts().resolution.value(),
            reference.holds};
  }

  Image ours_of(const Shot& shot, RealType real) const {
    if (options_.ours != nullptr) return options_.ours->render(shot).image;
    RenderJob how;
    how.real = real;
    how.threads = threads_;
    return renderers::OurRenderer(options_.tracer, how).render(shot).image;
  }

  const VerifyOptions& options_;
  const renderers::Renderer& reference_;
  int threads_;
  const Shot& shot_;
  SceneResult& result_;
};

void verify_scene(const VerifyOptions& options, const renderers::Renderer& reference, int threads,
                  SceneResult& result) {
  std::size_t warnings = 0;
  const Scene scene = load_scene(result.scene, options.dialect, [&](const std::string&) { ++warnings; });
  const RenderRequest& asked = scene.renders.front();
  const Size size = options.size.value_or(Size{asked.width, asked.height});
  result.width = size.width;  // known, even where the camera is not
  result.height = size.height;
  const Shot shot = shot_of(scene, options, result.scene);
  SceneVerifier verifier(options, reference, threads, shot, result);
  verifier.whole(warnings);
  if (options.terms) verifier.by_terms();
}

/// Reports results in order, whatever order they come in.
class InOrder {
 public:
  InOrder(std::vector<SceneResult>& results, const std::function<void(SceneResult&)>& done)
      : results_(results), done_(done), is_ready_(results.size(), false) {}

  void ready(std::size_t index) {
    const std::lock_guard lock(mutex_);
    is_ready_[index] = true;
    for (; next_ < results_.size() && is_ready_[next_]; ++next_) {
      if (done_) done_(results_[next_]);
    }
  }

 private:
  std::vector<SceneResult>& results_;
  const std::function<void(SceneResult&)>& done_;
  std::vector<bool> is_ready_;
  std::size_t next_ = 0;
  std::mutex mutex_;
};

}  // namespace

const char* to_string(Status status) {
  switch (status) {
    case Status::agree:
      return "agree";
    case Status::differ:
      return "differ";
    case Status::error:
      break;
  }
  return "error";
}

int VerifyReport::exit_code() const {
  const auto has = [&](Status status) {
    return std::any_of(scenes.begin(), scenes.end(),
                       [&](const SceneResult& s) { return s.status == status; });
  };
  if (has(Status::error)) return 2;
  return has(Status::differ) ? 1 : 0;
}

void judge(const attribution::AttributionJob& job, SceneResult& result) {
  result.comparison = comparison::compare(job.reference, job.test, job.tolerance);
  const auto view = [](const Image& i) {
    return comparison::PictureView{i.width, i.height, 3, i.rgb.data()};
  };
  result.metrics = comparison::cheap_metrics(view(job.reference), view(job.test));
  if (result.comparison.pixels_over > 0) {
    result.budget = attribution::attribute(job);
    truth::settle_undecided(job, result.budget);
  }
  if (result.judgement) truth::reconcile(*result.judgement, result.budget);
  result.broken_bound = attribution::broken_bound(result.budget, result.width, result.height);
  const bool agrees = result.budget.count(attribution::Cause::unexplained) == 0 && !result.broken_bound;
  result.status = agrees ? Status::agree : Status::differ;
  result.has_causes = true;
  result.no_figures.reset();
}

VerifyReport verify(const std::vector<std::string>& scenes, const VerifyOptions& options,
                    const std::function<void(SceneResult&)>& done) {
  const renderers::Reference reference = renderers::reference_renderer(options.reference);
  VerifyReport report;
  report.reference = reference.renderer->facts();
  report.reference_version = reference.renderer->version();
  report.notice = reference.notice;
  if (!report.notice.empty() && options.on_notice) options.on_notice(report.notice);
  for (const std::string& scene : scenes) report.scenes.emplace_back().scene = scene;

  const int cores = processors();
  const int wanted = options.jobs > 0 ? options.jobs : cores * runs_per_core;
  const int jobs = std::clamp(wanted, 1, static_cast<int>(std::max<std::size_t>(1, scenes.size())));
  const int threads = jobs >= cores ? 1 : cores;
  InOrder in_order(report.scenes, done);
  in_parallel(report.scenes.size(), jobs, [&](std::size_t i) {
    SceneResult& result = report.scenes[i];
    try {
      verify_scene(options, *reference.renderer, threads, result);
    } catch (const std::exception& error) {
      result.status = Status::error;
      result.trouble = error.what();
    }
    in_order.ready(i);  // throws what the caller's `done` throws
  });
  report.complaint = reference.renderer->complaint();
  return report;
}

}  // namespace plumb::gates
