#include "references/verify.hpp"

#include <time.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>

#include "exporters/povray.hpp"
#include "references/cache.hpp"
#include "references/povray.hpp"
#include "references/stored.hpp"
#include "tracer/scene/reader.hpp"

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

struct Picture {
  Image image;
  Precision precision;
};

/// Where reference pictures come from: POV-Ray through the cache, or the stored images.
class Source {
 public:
  explicit Source(const VerifyOptions& options) {
    if (options.stored) {
      use_stored("--stored");
      return;
    }
    try {
      povray_ = std::make_unique<Povray>();
    } catch (const PovrayError& absent) {
      use_stored(absent.what());
      return;
    }
    version_ = cache_.version_of(*povray_);
  }

  const std::string& version() const { return version_; }
  const std::string& notice() const { return notice_; }

  /// Sets the times and whether it was cached; warnings of the renderer go to the message.
  Picture picture(const PovrayJob& job, SceneResult& result) const {
    if (stored_) return {stored_picture(job, result), Precision::float32};
    auto found = cache_.find(job, version_);
    result.cached = found.has_value();
    if (!found) {
      found = povray_->render(job);
      if (found->precision == "float32")
        cache_.store(job, version_, *found);  // else it may go better next time
      result.seconds_reference = found->cpu_seconds;
    }
    if (!found->warnings.empty()) result.message = "POV-Ray warns: " + found->warnings;
    return {std::move(found->image), found->precision == "float32" ? Precision::float32 : Precision::bits16};
  }

 private:
  void use_stored(const std::string& why) {
    stored_ = std::make_unique<StoredReferences>(StoredReferences::default_directory());
    version_ = stored_->all().empty() ? "" : stored_->all().front().version;
    notice_ = "NO POV-RAY IS RUN: stored reference images are used (" + why + ")";
  }

  Image stored_picture(const PovrayJob& job, SceneResult& result) const {
    const auto entry = stored_->find(job.text, job.width, job.height);
    if (!entry) {
      throw PovrayError("no stored reference image for this export at " + std::to_string(job.width) + " x " +
                        std::to_string(job.height) + "; run with POV-Ray");
    }
    Image image = stored_->load(*entry);
    result.cached = true;
    return image;
  }

  Cache cache_;
  std::unique_ptr<Povray> povray_;
  std::unique_ptr<StoredReferences> stored_;
  std::string version_;
  std::string notice_;
};

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
  said.back() = ';';
  said += " shapes that take part:";
  for (const std::string& name : budget.shapes) said += " '" + name + "'";
  return broken.empty() ? said : said + "; but " + broken;
}

void judge(const AttributionJob& job, SceneResult& result) {
  result.comparison = compare(job.reference, job.test, job.tolerance);
  if (result.comparison.pixels_over > 0) result.budget = attribute(job);
  const std::string broken = broken_bound(result.budget, result.width, result.height);
  const bool agrees = result.budget.count(Cause::unexplained) == 0 && broken.empty();
  result.status = agrees ? Status::agree : Status::differ;
  const std::string said = verdict(result, broken);
  if (!said.empty()) result.message = said + (result.message.empty() ? "" : "; " + result.message);
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

void add_message(SceneResult& result, const std::string& message) {
  if (!message.empty()) result.message += (result.message.empty() ? "" : "; ") + message;
}

void verify_scene(const VerifyOptions& options, const Source& source, int threads, SceneResult& result) {
  std::size_t warnings = 0;
  const Scene scene = load_scene(result.scene, options.dialect, [&](const std::string&) { ++warnings; });
  const RenderRequest& request = scene.renders.front();
  result.width = options.size ? options.size->width : request.width;
  result.height = options.size ? options.size->height : request.height;
  const Camera& camera = scene.camera(options.camera.empty() ? request.camera : options.camera);
  const auto exported = exporters::export_povray(scene, camera, result.width, result.height, options.render);
  const Picture reference = source.picture(
      {exported.text, result.width, result.height, exported.needs_flat_objects, options.time_limit_seconds},
      result);
  textbook::RenderJob job;
  job.width = result.width;
  job.height = result.height;
  job.options = options.render;
  job.real = options.real;
  job.threads = threads;
  const double before = cpu_seconds(threads > 1);
  const Image ours = textbook::render(scene, camera, job);
  result.seconds_ours = cpu_seconds(threads > 1) - before;
  judge({scene, camera, options.render, reference.image, ours, options.tolerance, reference.precision},
        result);
  add_message(result, reservations(ours, warnings));
}

/// Reports results in order, whatever order they come in.
class InOrder {
 public:
  InOrder(std::vector<SceneResult>& results, const std::function<void(const SceneResult&)>& done)
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
  const std::function<void(const SceneResult&)>& done_;
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

VerifyReport verify(const std::vector<std::string>& scenes, const VerifyOptions& options,
                    const std::function<void(const SceneResult&)>& done) {
  const Source source(options);
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
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr failure;  // of the caller's `done`; the first one ends all
  const auto report_ready = [&](std::size_t i) {
    try {
      in_order.ready(i);
    } catch (...) {
      next = report.scenes.size();
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
    }
  };
  const auto work = [&] {
    for (std::size_t i = next++; i < report.scenes.size(); i = next++) {
      SceneResult& result = report.scenes[i];
      try {
        verify_scene(options, source, threads, result);
      } catch (const std::exception& error) {
        result.status = Status::error;
        result.message = error.what();
      }
      report_ready(i);
    }
  };
  std::vector<std::jthread> helpers;
  for (int i = 1; i < jobs; ++i) helpers.emplace_back(work);
  work();
  helpers.clear();
  if (failure) std::rethrow_exception(failure);
  return report;
}

}  // namespace plumb::references
