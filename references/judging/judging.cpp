#include "references/judging/judging.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <exception>
#include <mutex>
#include <thread>

#include "references/judging/run_tracer.hpp"
#include "references/process.hpp"
#include "references/renderer.hpp"
#include "references/report/packing.hpp"
#include "tracer/image/io.hpp"

namespace plumb::references {
namespace {

/// because a header of 20 bytes can promise any number of pixels
constexpr std::int64_t most_pixels = std::int64_t{1} << 24;

std::string size_text(int width, int height) {
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
  try {
    const PixelRows rows = open_image(file);
    const bool is_small = std::int64_t{rows.width} * rows.height <= most_pixels;
    if (is_small && rows.width == asked.width && rows.height == asked.height) return image_of(rows);
    result.verdict = Judged::wrong_size;
    result.message =
        "found " + size_text(rows.width, rows.height) + ", expected " + size_text(asked.width, asked.height);
  } catch (const std::exception& error) {
    result.verdict = Judged::unreadable;
    result.message = one_line(error.what());
    const std::size_t name = result.message.find(file);
    if (name != std::string::npos) result.message.replace(name, file.size(), scene.name);
  }
  return std::nullopt;
}

std::vector<unsigned char> levels_of(const Image& image, const OutputEncoding& encoding) {
  OutputEncoding shown = encoding;
  shown.is_float = false;
  std::vector<unsigned char> levels;
  levels.reserve(image.rgb.size());
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    const std::size_t from = encoding.is_bgr ? i - i % 3 + 2 - i % 3 : i;
    levels.push_back(static_cast<unsigned char>(shown.level(image.rgb[from])));
  }
  return levels;
}

std::vector<unsigned char> levels_of(const ImageFile& image) {
  std::vector<unsigned char> levels;
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < image.values.size(); i += channels) {
    for (std::size_t c = 0; c < 3; ++c) {
      const float value = image.values[i + (channels < 3 ? 0 : c)];
      levels.push_back(static_cast<unsigned char>(std::lround(255 * std::clamp(value, 0.0F, 1.0F))));
    }
  }
  return levels;
}

/// Differences are shown eight times as large.
void keep_pictures(const Image& ours, const ImageFile& theirs, JudgedPicture& result) {
  const std::vector<unsigned char> a = levels_of(ours, result.diagnosis->encoding);
  const std::vector<unsigned char> b = levels_of(theirs);
  std::vector<unsigned char> difference(a.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    difference[i] = static_cast<unsigned char>(std::min(255, 8 * std::abs(a[i] - b[i])));
  result.ours = png(ours.width, ours.height, 3, a);
  result.theirs = png(ours.width, ours.height, 3, b);
  result.difference = png(ours.width, ours.height, 3, difference);
}

Judged verdict_of(PictureVerdict verdict) {
  if (verdict == PictureVerdict::right) return Judged::right;
  return verdict == PictureVerdict::faults ? Judged::faults : Judged::unexplained;
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
  result.diagnosis = diagnose(scene.scene, camera, job, *seen);
  result.verdict = verdict_of(result.diagnosis->verdict);
  if (options.keeps_pictures)
    keep_pictures(render(Renderer::engine, scene.scene, camera, job), *seen, result);
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

/// Calls `work` with 0 to count - 1 on so many threads; the first exception ends all and is thrown.
void in_parallel(std::size_t count, int jobs, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::exception_ptr trouble;
  const auto work_on = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        work(i);
      } catch (...) {
        const std::scoped_lock lock(mutex);
        if (!trouble) trouble = std::current_exception();
        next = count;
      }
    }
  };
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < jobs; ++i) threads.emplace_back(work_on);
  }
  if (trouble) std::rethrow_exception(trouble);
}

}  // namespace

const char* to_string(Judged verdict) {
  constexpr std::array names{
      "right",   "faults",    "unexplained",  "wrong-size",      "no-image",           "unreadable",
      "crashed", "timed-out", "too-much-cpu", "too-much-memory", "too-many-processes", "too-much-output"};
  return names.at(static_cast<std::size_t>(verdict));
}

std::vector<JudgedPicture> judge_all(const std::vector<Submission>& submissions,
                                     const std::vector<JudgedScene>& scenes, const JudgeOptions& options) {
  if (!options.command.empty()) require_sandbox();
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
