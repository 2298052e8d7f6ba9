#include "references/gates/verify.hpp"

#include <time.h>

#include <algorithm>
#include <charconv>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>

#include "exporters/povray.hpp"
#include "references/renderers/reference_source.hpp"
#include "references/system/in_parallel.hpp"
#include "tracer/format/reader.hpp"

namespace plumb::references {
namespace {

/// POV-Ray mostly waits (0.65 s a run), so more runs than cores at once.
constexpr int runs_per_core = 4;

/// Of the calling thread, or of the process where one scene has all threads.
double cpu_seconds(bool of_process) {
  timespec now{};
  clock_gettime(of_process ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void add_message(SceneResult& result, const std::string& message) {
  if (!message.empty()) result.message += (result.message.empty() ? "" : "; ") + message;
}

/// The budget in words: what the pixels over are, and what is wrong.
std::string verdict(const SceneResult& result, const std::string& broken) {
  const Comparison& c = result.comparison;
  if (c.non_finite > 0) return std::to_string(c.non_finite) + " pixels are not finite";
  const Budget& budget = result.budget;
  if (budget.explained() == 0) return {};
  std::string said = std::to_string(budget.explained()) + " of " + std::to_string(c.pixels_over) +
                     " pixels over are explained, each by a proof:";
  for (std::size_t i = 0; i + 1 < cause_count; ++i) {
    const auto cause = static_cast<Cause>(i);
    if (budget.count(cause) > 0)
      said += std::string(" ") + to_string(cause) + " " + std::to_string(budget.count(cause)) + ",";
  }
  said.pop_back();
  if (!budget.shapes.empty()) said += "; shapes that take part:";
  for (const std::string& name : budget.shapes) said += " '" + name + "'";
  return broken.empty() ? said : said + "; but " + broken;
}

std::string three_digits(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value, std::chars_format::general, 3).ptr};
}

/// What agreement means little without: a picture of nothing, a file that was read with reservations.
std::string reservations(const Image& ours, std::size_t warnings) {
  std::string said;
  const auto add = [&](const std::string& what) { said += (said.empty() ? "" : "; ") + what; };
  if (is_of_one_colour(ours)) {
    add("nothing is seen: every pixel has the same colour; is the camera turned away, or do the transforms "
        "act in "
        "another order (--dialect post or trs)?");
  }
  if (warnings > 0)
    add(std::to_string(warnings) + (warnings == 1 ? " warning" : " warnings") + ", see plumb lint");
  return said;
}

/// One scene on both sides: as it is, and term by term.
class SceneVerifier {
 public:
  SceneVerifier(const VerifyOptions& options, const ReferenceSource& source, int threads, const Scene& scene,
                const Camera& camera, SceneResult& result)
      : options_(options),
        source_(source),
        threads_(threads),
        scene_(scene),
        camera_(camera),
        result_(result) {}

  void whole(std::size_t warnings) {
    const ReferencePicture reference = picture_of(scene_, options_.render);
    result_.cached = reference.cached;
    result_.stored = reference.stored;
    result_.seconds_reference = reference.cpu_seconds;
    const double before = cpu_seconds(threads_ > 1);
    const Image ours = ours_of(scene_, options_.render, options_.real);
    result_.seconds_ours = cpu_seconds(threads_ > 1) - before;
    const AttributionJob whole = job(scene_, options_.render, reference, ours);
    if (options_.judge) result_.judgement = judge_pixels(whole);
    judge(whole, result_);
    if (options_.judge) add_message(result_, result_.judgement->note());
    if (!reference.warnings.empty()) add_message(result_, "POV-Ray warns: " + reference.warnings);
    add_message(result_, reservations(ours, warnings));
    if (options_.keeps_pictures) result_.pictures = pictures_of(whole, result_.comparison, result_.budget);
    if (result_.status == Status::differ && options_.real == RealType::float32) blame_float(ours);
  }

  void by_terms() {
    for (const Term term : all_terms) {
      TermResult& result = result_.terms.emplace_back(TermResult{term, has(term, scene_), {}});
      try {
        if (result.in_scene) compare_term(result);
      } catch (const std::runtime_error& error) {
        add_message(result_,
                    std::string("the term ") + to_string(term) + " could not be compared: " + error.what());
      }
    }
    const auto first = std::find_if(result_.terms.begin(), result_.terms.end(),
                                    [](const TermResult& t) { return t.unexplained > 0; });
    if (first == result_.terms.end()) return;
    const bool differs = result_.status == Status::differ;
    add_message(result_, std::string(differs ? "the difference lives in the term "
                                             : "alone, there differs the term ") +
                             to_string(first->term));
  }

 private:
  /// The figure is measured, against our own picture in double: whether float is all that is wrong shows in
  /// it.
  void blame_float(const Image& ours) {
    std::string by;
    try {
      const Image in_double = ours_of(scene_, options_.render, RealType::float64);
      const double error = compare(in_double, ours, options_.tolerance).judged_error;
      by = ": float32 alone differs from double by up to " + three_digits(error) + " here";
    } catch (const std::runtime_error&) {
      // The verdict stands without the figure.
    }
    add_message(result_, "rendered with --real float" + by + "; try --real double");
  }

  void compare_term(TermResult& result) const {
    const TermScene reduced = only(result.term, scene_, options_.render);
    const ReferencePicture reference = picture_of(reduced.scene, reduced.options);
    const Image ours = ours_of(reduced.scene, reduced.options, options_.real);
    result.comparison = compare(reference.image, ours, options_.tolerance);
    if (result.comparison->pixels_over > 0) {
      result.unexplained =
          attribute(job(reduced.scene, reduced.options, reference, ours)).count(Cause::unexplained);
    }
  }

  AttributionJob job(const Scene& scene, const RenderOptions& render, const ReferencePicture& reference,
                     const Image& ours) const {
    return {scene, camera_, render, reference.image, ours, options_.tolerance, reference.precision};
  }

  ReferencePicture picture_of(const Scene& scene, const RenderOptions& render) const {
    const auto exported = exporters::export_povray(scene, camera_, result_.width, result_.height, render);
    return source_.picture({exported.text, result_.width, result_.height, exported.needs_flat_objects,
                            options_.time_limit_seconds});
  }

  Image ours_of(const Scene& scene, const RenderOptions& render, RealType real) const {
    RenderJob job;
    job.width = result_.width;
    job.height = result_.height;
    job.options = render;
    job.real = real;
    job.threads = threads_;
    if (options_.render_ours) return options_.render_ours(scene, camera_, job);
    return references::render(options_.renderer, scene, camera_, job);
  }

  const VerifyOptions& options_;
  const ReferenceSource& source_;
  int threads_;
  const Scene& scene_;
  const Camera& camera_;
  SceneResult& result_;
};

void verify_scene(const VerifyOptions& options, const ReferenceSource& source, int threads,
                  SceneResult& result) {
  std::size_t warnings = 0;
  const Scene scene = load_scene(result.scene, options.dialect, [&](const std::string&) { ++warnings; });
  const RenderRequest& request = scene.renders.front();
  result.width = options.size ? options.size->width : request.width;
  result.height = options.size ? options.size->height : request.height;
  const Camera& camera = scene.camera(options.camera.empty() ? request.camera : options.camera);
  SceneVerifier verifier(options, source, threads, scene, camera, result);
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

void judge(const AttributionJob& job, SceneResult& result) {
  result.comparison = compare(job.reference, job.test, job.tolerance);
  const auto view = [](const Image& i) { return PictureView{i.width, i.height, 3, i.rgb.data()}; };
  result.metrics = cheap_metrics(view(job.reference), view(job.test));
  if (result.comparison.pixels_over > 0) {
    result.budget = attribute(job);
    settle_undecided(job, result.budget);
  }
  if (result.judgement) reconcile(*result.judgement, result.budget);
  const std::string broken = broken_bound(result.budget, result.width, result.height);
  const bool agrees = result.budget.count(Cause::unexplained) == 0 && broken.empty();
  result.status = agrees ? Status::agree : Status::differ;
  add_message(result, verdict(result, broken));
  add_message(result, result.budget.note());
  result.not_compared.clear();
}

VerifyReport verify(const std::vector<std::string>& scenes, const VerifyOptions& options,
                    const std::function<void(SceneResult&)>& done) {
  const ReferenceSource source(options.stored);
  VerifyReport report;
  report.reference_version = source.version();
  report.notice = source.notice();
  if (!report.notice.empty() && options.on_notice) options.on_notice(report.notice);
  for (const std::string& scene : scenes) report.scenes.emplace_back().scene = scene;

  const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const int wanted = options.jobs > 0 ? options.jobs : cores * runs_per_core;
  const int jobs = std::clamp(wanted, 1, static_cast<int>(std::max<std::size_t>(1, scenes.size())));
  const int threads = jobs >= cores ? 1 : cores;
  InOrder in_order(report.scenes, done);
  in_parallel(report.scenes.size(), jobs, [&](std::size_t i) {
    SceneResult& result = report.scenes[i];
    try {
      verify_scene(options, source, threads, result);
    } catch (const std::exception& error) {
      result.status = Status::error;
      result.message = error.what();
    }
    in_order.ready(i);  // throws what the caller's `done` throws
  });
  report.complaint = source.complaint();
  return report;
}

}  // namespace plumb::references
