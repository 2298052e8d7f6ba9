#include "references/gates/regress.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "references/gates/against_baseline.hpp"
#include "references/gates/approved_images.hpp"
#include "references/system/digest.hpp"
#include "tracer/format/reader.hpp"

namespace plumb::references {
namespace {

namespace fs = std::filesystem;

std::string six_digits(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value, std::chars_format::general, 6).ptr};
}

/// The shortest text that reads back as the same float32.
std::string components(const float* values) {
  std::string text;
  for (int c = 0; c < 3; ++c) {
    char component[32];
    text.append(c == 0 ? "" : " ");
    text.append(component, std::to_chars(component, component + sizeof component, values[c]).ptr);
  }
  return text;
}

std::string at(int x, int y) { return "(" + std::to_string(x) + ", " + std::to_string(y) + ")"; }

std::string dimensions(int width, int height) { return std::to_string(width) + "x" + std::to_string(height); }

const Camera& camera_of(const Scene& scene, const RegressOptions& options) {
  return scene.camera(options.camera.empty() ? scene.renders.front().camera : options.camera);
}

Image rendered_by_plumb(const Scene& scene, const RegressOptions& options) {
  const RenderRequest& request = scene.renders.front();
  RenderJob job;
  job.width = options.size ? options.size->width : request.width;
  job.height = options.size ? options.size->height : request.height;
  job.options = options.render;
  job.real = options.real;
  job.threads = options.threads;
  job.progress = options.progress;
  return render(options.renderer, scene, camera_of(scene, options), job);
}

/// The figures of a difference, and who to ask about the baseline.
std::string difference(const Comparison& c) {
  std::string text = std::to_string(c.pixels_over) + " of " + std::to_string(c.pixels) + " pixels are over";
  if (c.non_finite > 0) text += ", " + std::to_string(c.non_finite) + " of them are not finite";
  double error = 0;
  for (std::size_t i = 0; i < c.worst.test.size(); ++i) {
    error = std::max(
        error, std::abs(static_cast<double>(c.worst.test[i]) - static_cast<double>(c.worst.reference[i])));
  }
  text += "; worst pixel " + at(c.worst.x, c.worst.y) + ": ours " + components(c.worst.test.data()) +
          ", baseline " + components(c.worst.reference.data());
  return c.non_finite > 0 ? text : text + ", off by " + six_digits(error);
}

std::string history(const Baseline& baseline, const std::string& scene_sha256) {
  std::string text = "\nbaseline approved by " + baseline.who + ", " + baseline.when + ": " + baseline.why;
  if (baseline.scene_sha256 != scene_sha256) text += "\nthe scene file has changed since";
  return text;
}

/// A scene without a baseline differs from what was approved: nothing.
void judge_new(const ApprovedImages& approved, RegressedScene& scene) {
  const std::string image = approved.image_path(scene.name);
  if (fs::exists(image)) {
    throw std::runtime_error(image +
                             ": has no record in baselines.json; bring it back, or approve the scene anew");
  }
  scene.result.status = Status::differ;
  scene.result.message = "new: there is no baseline yet";
  scene.result.not_compared = "there is nothing to compare with: no image was approved yet";
  scene.result.comparison.pixels = scene.image->rgb.size() / 3;
}

/// What two renderers make of a scene says nothing about either.
void expect_same_renderer(const Baseline& baseline, const RegressOptions& options) {
  if (baseline.renderer.empty() == !options.other) return;
  throw std::runtime_error(baseline.renderer.empty()
                               ? "the baseline is plumb's own picture, not the renderer's: compare without "
                                 "--renderer, or approve the renderer's pictures as a --variant"
                               : "the baseline is a picture by `" + baseline.renderer +
                                     "`, not plumb's own: compare with --renderer");
}

void judge_size(const Baseline& baseline, const std::string& asked, RegressedScene& scene) {
  SceneResult& result = scene.result;
  result.status = Status::differ;
  result.comparison.pixels = result.comparison.pixels_over = scene.image->rgb.size() / 3;
  result.message = "the size is " + dimensions(result.width, result.height) + ", of the baseline " +
                   dimensions(baseline.width, baseline.height) + asked;
  result.not_compared = "images of two sizes are not compared";
}

/// Several lines; an empty one adds nothing.
void add_line(std::string& text, const std::string& line) {
  if (!line.empty()) text += (text.empty() ? "" : "\n") + line;
}

BoundedComparison compared(const RegressOptions& options, const Bounds& bounds, const Scene* read,
                           RegressedScene& scene) {
  const BaselineJob job{*scene.baseline, *scene.image, bounds, options.keeps_pictures};
  if (read == nullptr) return judge_others(job, scene.result);
  return judge_own(*read, camera_of(*read, options), options.render, job, scene.result);
}

/// `read` is null when somebody else's renderer made the image.
void judge_image(const ApprovedImages& approved, const RegressOptions& options, const Scene* read,
                 RegressedScene& scene) {
  const auto found = approved.find(scene.name);
  SceneResult& result = scene.result;
  if (!found) return judge_new(approved, scene);
  expect_same_renderer(*found->record, options);
  scene.baseline = found->baselines->load(*found->record);
  const std::string asked = history(*found->record, sha256(read_text_file(result.scene)));
  if (found->record->width != result.width || found->record->height != result.height)
    return judge_size(*found->record, asked, scene);
  const Bounds bounds = approved.bounds_of(scene.name, options.bounds);
  const BoundedComparison bounded = compared(options, bounds, read, scene);
  if (!bounds.are_plain()) scene.bounds = {bounds, bounded};
  if (result.status == Status::differ) {
    const std::string explained = std::exchange(result.message, difference(result.comparison) + asked);
    add_line(result.message, explained);
  }
}

void judge_scene(const ApprovedImages& approved, const RegressOptions& options, RegressedScene& scene) {
  SceneResult& result = scene.result;
  std::optional<Scene> read;
  if (!options.other) read = load_scene(result.scene, options.dialect);
  const std::clock_t before = std::clock();
  OtherRenderer::Picture picture = read ? OtherRenderer::Picture{rendered_by_plumb(*read, options), ""}
                                        : options.other->picture_of(result.scene);
  result.seconds_ours = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
  scene.image = std::move(picture.image);
  result.width = scene.image->width;
  result.height = scene.image->height;
  judge_image(approved, options, read ? &*read : nullptr, scene);
  add_line(result.message, picture.not_stored);
  if (result.status != Status::differ) return;
  const std::string complaint = non_finite_pixels(*scene.image);
  scene.can_be_approved = complaint.empty();
  if (!complaint.empty()) result.message += "\ncannot be approved: " + complaint;
}

RegressedScene judged(const ApprovedImages& approved, const RegressOptions& options,
                      const std::string& directory, const std::string& name) {
  using Clock = std::chrono::steady_clock;
  RegressedScene scene;
  scene.name = name;
  scene.result.scene = scene_path(directory, name);
  const auto begin = Clock::now();
  try {
    judge_scene(approved, options, scene);
  } catch (const std::exception& error) {
    scene.result.status = Status::error;
    scene.result.message = error.what();
  }
  scene.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  return scene;
}

/// A gate that checks less than was approved is trouble: nobody would notice.
RegressedScene orphan(const ApprovedImages& approved, const std::string& directory, const std::string& name) {
  RegressedScene scene{name, {}, 0, true, {}, {}, {}};
  scene.result.scene = scene_path(directory, name);
  scene.result.message = "THE SCENE IS GONE, its baseline " + approved.image_path(name) +
                         " is there: bring the scene back, or approve that it is gone";
  return scene;
}

}  // namespace

OtherRenderer::Picture rendered(const std::string& scene_path, const RegressOptions& options,
                                const std::function<void(const std::string&)>& warn) {
  if (options.other) return options.other->picture_of(scene_path);
  return {rendered_by_plumb(load_scene(scene_path, options.dialect, warn), options), ""};
}

std::string non_finite_pixels(const Image& image) {
  std::size_t count = 0;
  std::string first;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const float* const p = image.pixel(x, y);
      if (std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2])) continue;
      if (count++ == 0) first = at(x, y) + ": " + components(p);
    }
  }
  return count == 0 ? "" : std::to_string(count) + " pixels are not finite, the first " + first;
}

std::vector<RegressedScene> regress(const std::string& directory, const RegressOptions& options,
                                    const std::function<void(const RegressedScene&)>& done) {
  const std::vector<std::string> names = scene_names(directory);
  if (names.empty()) throw std::runtime_error(directory + ": found no scene, expected *.sdf");
  expect_clear_variant(directory, options.variant, names);
  const ApprovedImages approved(directory, options.variant);
  const std::string complaint = approved.complaint_about_bounds(names);
  if (!complaint.empty()) throw std::runtime_error(complaint);
  std::vector<RegressedScene> scenes;
  const auto finish = [&](RegressedScene scene) {
    if (done) done(scene);
    scene.image.reset();
    scene.baseline.reset();
    scene.result.pictures.reset();
    scenes.push_back(std::move(scene));
  };
  for (const std::string& name : names) finish(judged(approved, options, directory, name));
  for (const std::string& name : approved.names()) {
    if (!std::ranges::binary_search(names, name)) finish(orphan(approved, directory, name));
  }
  return scenes;
}

}  // namespace plumb::references
