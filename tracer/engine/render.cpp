#include "tracer/engine/render.hpp"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <mutex>
#include <thread>

#include "tracer/engine/compile.hpp"
#include "tracer/engine/kernels.hpp"
#include "tracer/formulas/camera.hpp"

namespace plumb::engine {
namespace {

/// Slides "Kameramodell" and "Kameratransformation".
template <class Real>
View<Real> view_of(const Scene& scene, const Camera& camera, const RenderJob& job) {
  const CameraPose<Real> pose = pose_of<Real>(camera);
  const Mat4<Real> matrix = formulas::camera_matrix(pose.eye, pose.direction, pose.up);
  const Real distance = formulas::image_plane_distance(static_cast<Real>(camera.fov_x_degrees));
  View<Real> view{pose.eye,
                  Vec3<Real>(matrix[0]),
                  Vec3<Real>(matrix[1]),
                  -distance * Vec3<Real>(matrix[2]),
                  job.width,
                  job.height,
                  sample_points(job.samples, job.pattern),
                  {},
                  job.options};
  const CameraPose<double> exact = pose_of<double>(camera);
  view.around_the_eye = dielectrics_around(scene, exact.eye, exact.direction);
  return view;
}

std::vector<Tile> tiles_of(int width, int height) {
  std::vector<Tile> tiles;
  for (int y = 0; y < height; y += tile_edge) {
    for (int x = 0; x < width; x += tile_edge)
      tiles.push_back({x, y, std::min(tile_edge, width - x), std::min(tile_edge, height - y)});
  }
  return tiles;
}

/// Reports the share that is done, from one thread at a time.
class Progress {
 public:
  Progress(const std::function<void(double)>& show, std::size_t all) : show_(show), all_(all) {}
  void add_one() {
    if (!show_) return;
    const std::lock_guard lock(mutex_);
    show_(static_cast<double>(++done_) / static_cast<double>(all_));
  }

 private:
  const std::function<void(double)>& show_;
  std::size_t all_, done_ = 0;
  std::mutex mutex_;
};

template <class Real>
std::size_t bytes_of(const CompiledScene<Real>& s) {
  const auto bytes = [](const auto& v) { return v.size() * sizeof v[0]; };
  return bytes(s.nodes) + bytes(s.spheres) + bytes(s.boxes) + bytes(s.placed) + bytes(s.members) +
         bytes(s.sphere_labels) + bytes(s.box_labels) + bytes(s.groups) + bytes(s.materials) +
         bytes(s.lights);
}

/// What the scene made of the engine, in words.
template <class Real>
std::string kernel_of(const CompiledScene<Real>& scene, Vectors vectors) {
  const std::size_t bits = vectors == Vectors::avx512 ? 512 : vectors == Vectors::avx2 ? 256 : 128;
  std::string text = std::to_string(bits / (8 * sizeof(Real))) + " rays a vector (" + name_of(vectors) + ")";
  const std::size_t objects = scene.spheres.size() + scene.boxes.size();
  text += scene.has_few_objects ? "; all rays of a tile against all " + std::to_string(objects) +
                                      " objects that are not culled, because they are few"
                                : "; a hierarchy, because there are " + std::to_string(objects) + " objects";
  if (!scene.members.empty()) text += ", with shared parts kept once";
  if (!scene.mirrors && !scene.transmits) text += "; no secondary rays, because nothing mirrors or transmits";
  if (scene.mirrors && !scene.transmits) text += "; no refraction, because nothing transmits";
  return text;
}

template <class Real>
Image render_in(const Scene& scene, const Camera& camera, const RenderJob& job, Statistics* statistics,
                const Settings& settings) {
  Statistics counts;
  const int available = static_cast<int>(std::thread::hardware_concurrency());
  const int threads = job.threads > 0 ? job.threads : available;
  const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(std::max(threads, available)));
  tbb::task_arena arena(std::max(threads, 1));
  const Stopwatch building;
  const CompiledScene<Real> compiled = arena.execute([&] { return compile<Real>(scene, settings); });
  counts.build = building.elapsed();

  const Stopwatch rendering;
  const View<Real> view = view_of<Real>(scene, camera, job);
  Image image(job.width, job.height);
  const std::vector<Tile> tiles = tiles_of(job.width, job.height);
  tbb::enumerable_thread_specific<std::unique_ptr<TileRenderer<Real>>> renderers(
      [&] { return make_tile_renderer(compiled, view, settings.vectors); });
  Progress progress(job.progress, tiles.size());
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tiles.size()), [&](const auto& range) {
      std::array<float, 3 * pixels_of_tile> rgb;
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        const Tile& tile = tiles[i];
        renderers.local()->render(tile, rgb.data());
        for (int y = 0; y < tile.height; ++y)
          std::copy_n(&rgb[3 * static_cast<std::size_t>(y * tile.width)], 3 * tile.width,
                      image.pixel(tile.x, tile.y + y));
        progress.add_one();
      }
    });
  });
  counts.render = rendering.elapsed();
  for (const auto& renderer : renderers) counts.add_counts(renderer->statistics());
  counts.bytes = bytes_of(compiled);
  counts.kernel = kernel_of(compiled, settings.vectors);
  counts.objects = compiled.spheres.size() + compiled.boxes.size();
  if (statistics != nullptr) *statistics = counts;
  return image;
}

}  // namespace

Image render(const Scene& scene, const Camera& camera, const RenderJob& job, Statistics* statistics,
             const Settings& settings) {
  if (job.real == RealType::float32) return render_in<float>(scene, camera, job, statistics, settings);
  return render_in<double>(scene, camera, job, statistics, settings);
}

}  // namespace plumb::engine
