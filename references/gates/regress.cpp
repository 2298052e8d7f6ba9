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
#include "references/renderers/baseline.hpp"
#include "references/system/digest.hpp"
#include "tracer/format/reader.hpp"

namespace plumb::gates {
namespace {

namespace fs = std::filesystem;

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

/// With another renderer, what plumb is asked for counts for nothing.
Shot shot_for(const Scene& scene, const std::string& path, const RegressOptions& options) {
  return options.other ? shot_of(scene, {}, path) : shot_of(scene, options, path);
}

renderers::Rendered rendered(const Shot& shot, const RegressOptions& options) {
  if (options.other) return options.other->render(shot);
  RenderJob how;
  how.real = options.real;
  how.threads = options.threads;
  how.progress = options.progress;
  return renderers::OurRenderer(options.tracer, how).render(shot);
}

/// A scene without a baseline differs from what was approved: nothing.
void judge_new(const ApprovedImages& approved, RegressedScene& scene) {
  const std::string image = approved.image_path(scene.name);
  if (fs::exists(image)) {
    throw std::runtime_error(image +
                             ": has no record in baselines.json; bring it back, or approve the scene anew");
  }
  scene.result.status = Status::differ;
  scene.result.no_figures = NoFigures::nothing_approved;
  scene.result.comparison.pixels = scene.image->rgb.size() / 3;
}

/// What two renderers make of a scene says nothing about either.
void expect_same_renderer(const renderers::Baseline& baseline, const RegressOptions& options) {
  if (baseline.renderer.empty() == !options.other) return;
  throw std::runtime_error(baseline.renderer.empty()
                               ? "the baseline is plumb's own picture, not the renderer's: compare without "
                                 "--renderer, or approve the renderer's pictures as a --variant"
                               : "the baseline is a picture by `" + baseline.renderer +
                                     "`, not plumb's own: compare with --renderer");
}

void judge_size(RegressedScene& scene) {
  SceneResult& result = scene.result;
  result.status = Status::differ;
  result.no_figures = NoFigures::other_size;
  result.comparison.pixels = result.comparison.pixels_over = scene.image->rgb.size() / 3;
}

/// What somebody else's renderer made is not traced again.
BoundedComparison compared(const Shot& shot, const renderers::Renderer& baseline,
                           const RegressOptions& options, const Bounds& bounds, RegressedScene& scene) {
  const BaselineJob job{*scene.baseline, *scene.image, bounds, options.keeps_pictures};
  const auto& resolution = baseline.facts().resolution;
  return resolution ? judge_own(shot, *resolution, job, scene.result) : judge_others(job, scene.result);
}

void judge_image(const ApprovedImages& approved, const RegressOptions& options, const Shot& shot,
                 RegressedScene& scene) {
  const auto found = approved.find(scene.name);
  SceneResult& result = scene.result;
  if (!found) return judge_new(approved, scene);
  expect_same_renderer(*found->record, options);
  const renderers::BaselineRenderer baseline(*found->baselines, *found->record);
  scene.baseline = baseline.render(shot).image;
  scene.approved = *found->record;
  scene.has_changed = found->record->scene_sha256 != system::sha256(read_text_file(result.scene));
  if (found->record->width != result.width || found->record->height != result.height)
    return judge_size(scene);
  const Bounds bounds = approved.bounds_of(scene.name, options.bounds);
  const BoundedComparison bounded = compared(shot, baseline, options, bounds, scene);
  if (!bounds.are_plain()) scene.bounds = {bounds, bounded};
}

void judge_scene(const ApprovedImages& approved, const RegressOptions& options, RegressedScene& scene) {
  SceneResult& result = scene.result;
  const Scene read = load_scene(result.scene, options.dialect);
  const Shot shot = shot_for(read, result.scene, options);
  const std::clock_t before = std::clock();
  renderers::Rendered picture = rendered(shot, options);
  result.seconds_ours = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
  scene.image = std::move(picture.image);
  result.width = scene.image->width;
  result.height = scene.image->height;
  judge_image(approved, options, shot, scene);
  scene.not_stored = picture.not_read;
  if (result.status != Status::differ) return;
  scene.cannot_be_approved = non_finite_pixels(*scene.image);
  scene.can_be_approved = scene.cannot_be_approved.empty();
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
    scene.result.trouble = error.what();
  }
  scene.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  return scene;
}

/// A gate that checks less than was approved is trouble: nobody would notice.
RegressedScene orphan(const ApprovedImages& approved, const std::string& directory, const std::string& name) {
  RegressedScene scene;
  scene.name = name;
  scene.can_be_approved = true;
  scene.lost = approved.image_path(name);
  scene.result.scene = scene_path(directory, name);
  return scene;
}

}  // namespace

renderers::Rendered rendered(const std::string& scene_path, const RegressOptions& options,
                             const std::function<void(const std::string&)>& warn) {
  const Scene scene = load_scene(scene_path, options.dialect, options.other ? nullptr : warn);
  return rendered(shot_for(scene, scene_path, options), options);
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

}  // namespace plumb::gates
