#include "references/judging/judging.hpp"

#include <algorithm>
#include <array>
#include <mutex>
#include <system_error>

#include "references/in_parallel.hpp"
#include "references/judging/run_tracer.hpp"
#include "references/process.hpp"
#include "references/renderer.hpp"
#include "references/teaching/pages.hpp"
#include "tracer/image/io.hpp"

namespace plumb::references {
namespace {

std::string size_text(std::int64_t width, std::int64_t height) {
  return std::to_string(width) + " x " + std::to_string(height) + " pixels";
}

std::string one_line(std::string text) {
  text = text.substr(0, text.find('\n'));
  return text.substr(0, 300);
}

/// Nothing when the file holds no picture of the scene's size; then the verdict says why.
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

std::string figures_of(const Image& ours, const ImageFile& theirs, const OutputEncoding& encoding) {
  const teaching::Picture right = teaching::picture_of(ours, encoding);
  const teaching::Picture seen = teaching::picture_of(theirs);
  return teaching::figure(right, "right") + teaching::figure(seen, "handed in") +
         teaching::figure(teaching::difference_of(right, seen), "where they differ, 4 times as bright");
}

Judged verdict_of(PictureVerdict verdict) {
  switch (verdict) {
    case PictureVerdict::right:
      return Judged::right;
    case PictureVerdict::right_apart:
      return Judged::right_apart;
    case PictureVerdict::faults:
      return Judged::faults;
    case PictureVerdict::unexplained:
      break;
  }
  return Judged::unexplained;
}

/// The picture as far as it is judged by its file.
void judge_picture(const std::string& file, const JudgedScene& scene, const JudgeOptions& options,
                   JudgedPicture& result) {
  const std::optional<ImageFile> seen = read_picture(file, scene, result);
  if (!seen) return;
  const RenderRequest& asked = scene.scene.renders.front();
  RenderJob job;
  job.width = asked.width;
  job.height = asked.height;
  job.options = options.render;
  job.threads = 1;
  const Camera& camera = scene.scene.camera(asked.camera);
  result.diagnosis = diagnose(scene.scene, camera, job, *seen, options.tolerance);
  result.verdict = verdict_of(result.diagnosis->verdict);
  result.message = summary_of(*result.diagnosis);
  if (options.keeps_pictures)
    result.figures =
        figures_of(render(Renderer::engine, scene.scene, camera, job), *seen, result.diagnosis->encoding);
}

JudgedPicture judge_one(const Submission& submission, const JudgedScene& scene, const JudgeOptions& options) {
  JudgedPicture result;
  result.submission = submission.name;
  result.scene = scene.name;
  const TemporaryDirectory own;
  const std::string file = options.command.empty()
                               ? picture_handed_in(submission, scene, options, own.path(), result)
                               : picture_of_run(submission, scene, options, own.path(), result);
  if (!file.empty()) judge_picture(file, scene, options, result);
  return result;
}

}  // namespace

const char* to_string(Judged verdict) {
  constexpr std::array names{"right",          "right-apart",  "faults",          "unexplained",
                             "wrong-size",     "no-image",     "unreadable",      "crashed",
                             "timed-out",      "too-much-cpu", "too-much-memory", "too-many-processes",
                             "too-much-output"};
  return names.at(static_cast<std::size_t>(verdict));
}

std::vector<JudgedPicture> judge_all(const std::vector<Submission>& submissions,
                                     const std::vector<JudgedScene>& scenes, const JudgeOptions& options) {
  if (!options.command.empty() && !submissions.empty()) require_confined_runs(submissions.front(), options);
  std::vector<JudgedPicture> results(submissions.size() * scenes.size());
  std::mutex mutex;
  std::size_t done = 0;
  in_parallel(results.size(), options.jobs, [&](std::size_t i) {
    results[i] = judge_one(submissions[i / scenes.size()], scenes[i % scenes.size()], options);
    const std::scoped_lock lock(mutex);
    ++done;
    if (options.progress) options.progress(static_cast<double>(done) / static_cast<double>(results.size()));
  });
  return results;
}

}  // namespace plumb::references
