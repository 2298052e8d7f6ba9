#include "references/submissions/grade.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <mutex>
#include <new>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

#include "references/diagnosis/handed_in.hpp"
#include "references/renderers/ours.hpp"
#include "references/submissions/interrupts.hpp"
#include "references/submissions/journal.hpp"
#include "references/submissions/result_keys.hpp"
#include "references/submissions/run_tracer.hpp"
#include "references/submissions/shown_text.hpp"
#include "references/system/process.hpp"
#include "references/teaching/picture.hpp"
#include "tracer/image/io.hpp"
#include "tracer/system/in_parallel.hpp"

namespace plumb::submissions {
namespace {

std::string size_text(std::int64_t width, std::int64_t height) {
  return std::to_string(width) + " x " + std::to_string(height) + " pixels";
}

std::string one_line(std::string text) {
  text = text.substr(0, text.find('\n'));
  return text.substr(0, 300);
}

/// Returns nothing when the file holds no picture of the scene's size. The verdict then says why.
std::optional<ImageFile> read_picture(const std::string& file, const JudgedScene& scene,
                                      JudgedPicture& result) {
  const RenderRequest& asked = scene.scene.renders.front();
  const auto has_wrong_size = [&](std::int64_t width, std::int64_t height) {
    result.verdict = Judged::wrong_size;
    result.message =
        "found " + size_text(width, height) + ", expected " + size_text(asked.width, asked.height);
  };
  ReadRequest request;
  request.most_pixels = std::int64_t{asked.width} * asked.height;  // a larger one isn't decoded
  try {
    const PixelRows rows = open_image(file, request);
    if (const auto complaint = diagnosis::complaint_about_contents(rows))
      throw std::runtime_error(*complaint);
    result.message = diagnosis::not_looked_at(rows);
    if (rows.width == asked.width && rows.height == asked.height) return image_of(rows);
    has_wrong_size(rows.width, rows.height);
  } catch (const PictureTooLarge& error) {
    has_wrong_size(error.width, error.height);
  } catch (const std::system_error&) {
    throw;  // our trouble, not that of the picture
  } catch (const std::exception& error) {
    result.verdict = Judged::unreadable;
    result.message = one_line(error.what());
    const std::size_t name = result.message.find(file);
    if (name != std::string::npos) result.message.replace(name, file.size(), scene.name);
  }
  return std::nullopt;
}

report::html::ThreePictures pictures_of(const Image& ours, const ImageFile& theirs,
                                        const diagnosis::OutputEncoding& encoding) {
  return teaching::three_pictures(teaching::picture_of(ours, encoding), teaching::picture_of(theirs));
}

Judged verdict_of(diagnosis::PictureVerdict verdict) {
  switch (verdict) {
    case diagnosis::PictureVerdict::right:
      return Judged::right;
    case diagnosis::PictureVerdict::right_apart:
      return Judged::right_apart;
    case diagnosis::PictureVerdict::faults:
      return Judged::faults;
    case diagnosis::PictureVerdict::unexplained:
      break;
  }
  return Judged::unexplained;
}

using Pictures = std::optional<report::html::ThreePictures>;

/// The picture as far as it is judged by its file; what was seen, when it is kept.
Pictures judge_picture(const std::string& file, const JudgedScene& scene, const JudgeOptions& options,
                       JudgedPicture& result) {
  const std::optional<ImageFile> seen = read_picture(file, scene, result);
  if (!seen) return {};
  const RenderRequest& asked = scene.scene.renders.front();
  RenderJob job;
  job.width = asked.width;
  job.height = asked.height;
  job.options = options.render;
  job.threads = 1;
  const Camera& camera = scene.scene.camera(asked.camera);
  result.diagnosis = diagnosis::diagnose(scene.scene, camera, job, *seen, options.tolerance);
  result.verdict = verdict_of(result.diagnosis->verdict);
  const std::string left = result.message.empty() ? "" : "not looked at: " + result.message;
  const std::string summary = diagnosis::summary_of(*result.diagnosis);
  result.message = summary + (summary.empty() || left.empty() ? "" : "; ") + left;
  if (!options.keeps_pictures) return {};
  return pictures_of(renderers::render(renderers::OwnTracer::engine, scene.scene, camera, job), *seen,
                     result.diagnosis->encoding);
}

/// What was seen, when it is kept.
Pictures judge_one(const Submission& submission, const JudgedScene& scene, const JudgeOptions& options,
                   JudgedPicture& result) {
  if (std::filesystem::is_symlink(submission.path))
    throw std::runtime_error(submission.path +
                             ": found a link, which may lead to what is not the submission's, expected a "
                             "file or a directory; put a copy in its place (cp -rL)");
  const system::TemporaryDirectory own;
  const std::string file = options.command.empty()
                               ? picture_handed_in(submission, scene, options, own.path(), result)
                               : picture_of_run(submission, scene, options, own.path(), result);
  return file.empty() ? Pictures() : judge_picture(file, scene, options, result);
}

void set_trouble(JudgedPicture& result, const std::string& what) {
  result.verdict = Judged::trouble;
  result.diagnosis.reset();
  result.message = one_line(what);
}

/// Judges all submissions of a class on all scenes; each pair is a task.
class Class {
 public:
  Class(const std::vector<Submission>& submissions, const std::vector<JudgedScene>& scenes,
        const JudgeOptions& options)
      : submissions_(submissions),
        scenes_(scenes),
        options_(options),
        keys_(options),
        results_(submissions.size() * scenes.size()) {
    for (std::size_t i = 0; i < results_.size(); ++i) results_[i] = unjudged(i);
  }

  std::vector<JudgedPicture> judged() {
    std::jthread ends_what_runs([&](const std::stop_token& is_done) {
      while (!is_done.stop_requested()) {
        if (options_.stops()) kill_children();
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
      }
    });
    in_parallel(results_.size(), options_.jobs, [&](std::size_t i) {
      if (!options_.stops()) judge(i);
    });
    return std::move(results_);
  }

 private:
  const Submission& submission(std::size_t i) const { return submissions_[i / scenes_.size()]; }
  const JudgedScene& scene(std::size_t i) const { return scenes_[i % scenes_.size()]; }

  JudgedPicture unjudged(std::size_t i) const {
    JudgedPicture result;
    result.submission = submission(i).name;
    result.scene = shown_name(scene(i).name);
    result.message = "the run was interrupted before";
    return result;
  }

  void judge(std::size_t i) {
    JudgedPicture result = unjudged(i);
    result.message.clear();
    Pictures pictures;
    std::string key;
    try {
      if (options_.journal != nullptr) key = keys_.of(submission(i), scene(i));
      if (take_kept(key, result)) return finish(i, std::move(result));
      pictures = judge_one(submission(i), scene(i), options_, result);
    } catch (const std::bad_alloc&) {
      set_trouble(result, "memory ran out");
    } catch (const std::exception& error) {
      set_trouble(result, error.what());
    } catch (...) {
      set_trouble(result, "an unknown exception");
    }
    if (was_interrupted(result)) return;
    result.message = shown_text(result.message);
    result.printed = shown_text(result.printed);
    keep(key, result, pictures);
    finish(i, std::move(result));
  }

  bool take_kept(const std::string& key, JudgedPicture& result) const {
    std::optional<JudgedPicture> kept;
    if (options_.journal != nullptr) kept = options_.journal->find(key);
    if (!kept) return false;
    kept->submission = result.submission;
    kept->scene = result.scene;
    result = std::move(*kept);
    return true;
  }

  /// True if no more is to be judged. Ctrl-C also reaches the program that runs, and may end it before we
  /// know, so this waits a moment.
  bool was_interrupted(const JudgedPicture& result) const {
    const bool may_be = result.verdict == Judged::crashed || result.verdict == Judged::trouble;
    if (may_be && !options_.command.empty()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return options_.stops();
  }

  /// Trouble is not kept: the next run tries again.
  void keep(const std::string& key, JudgedPicture& result, const Pictures& pictures) {
    if (options_.journal == nullptr || result.verdict == Judged::trouble) return;
    try {
      options_.journal->keep(key, result, pictures);
    } catch (const std::exception& error) {
      const std::scoped_lock lock(mutex_);
      if (!std::exchange(has_complained_, true) && options_.complain)
        options_.complain(std::string(error.what()) + "; results and pictures are no longer kept");
    }
  }

  void finish(std::size_t i, JudgedPicture result) {
    results_[i] = std::move(result);
    const std::scoped_lock lock(mutex_);
    ++done_;
    if (options_.progress)
      options_.progress(static_cast<double>(done_) / static_cast<double>(results_.size()));
  }

  const std::vector<Submission>& submissions_;
  const std::vector<JudgedScene>& scenes_;
  const JudgeOptions& options_;
  ResultKeys keys_;
  std::vector<JudgedPicture> results_;
  std::mutex mutex_;
  std::size_t done_ = 0;
  bool has_complained_ = false;
};

constexpr std::array names_of_verdicts{
    "right",           "right-apart",        "faults",          "unexplained", "wrong-size",
    "no-image",        "unreadable",         "crashed",         "timed-out",   "too-much-cpu",
    "too-much-memory", "too-many-processes", "too-much-output", "trouble",     "not-judged"};

}  // namespace

const char* to_string(Judged verdict) { return names_of_verdicts.at(static_cast<std::size_t>(verdict)); }

Judged verdict_named(const std::string& name) {
  const auto at = std::find(names_of_verdicts.begin(), names_of_verdicts.end(), name);
  if (at == names_of_verdicts.end()) throw std::invalid_argument("found the verdict " + name);
  return static_cast<Judged>(at - names_of_verdicts.begin());
}

std::vector<JudgedPicture> judge_all(const std::vector<Submission>& submissions,
                                     const std::vector<JudgedScene>& scenes, const JudgeOptions& options) {
  if (!options.command.empty() && !submissions.empty()) require_confined_runs(submissions.front(), options);
  return Class(submissions, scenes, options).judged();
}

}  // namespace plumb::submissions
