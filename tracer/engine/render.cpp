#include "tracer/engine/render.hpp"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <mutex>
#include <utility>

#include "tracer/engine/compile.hpp"
#include "tracer/engine/kernels.hpp"
#include "tracer/formulas/camera.hpp"
#include "tracer/system/in_parallel.hpp"

namespace plumb::engine {
namespace {

/// Slides "Kameramodell" and "Kameratransformation".
template <class Real>
View<Real> view_of(const Scene& scene, const Camera& camera, const RenderJob& job) {
  const CameraPose<Real> pose = pose_of<Real>(camera);
  const Mat4<Real> matrix = formulas::camera_matrix(pose.eye, pose.direction, pose.up);
  const Real distance = formulas::image_plane_distance(static_cast<Real>(camera.fov_x_degrees));
  return View<Real>{pose.eye,
                    Vec3<Real>(matrix[0]),
                    Vec3<Real>(matrix[1]),
                    -distance * Vec3<Real>(matrix[2]),
                    job.width,
                    job.height,
                    sample_points(job.samples, job.pattern),
                    {scene, pose.eye, pose.direction},
                    job.options};
}

std::vector<Tile> tiles_of(int width, int first_row, int end_row, const Settings& settings) {
  std::vector<Tile> tiles;
  for (int y = first_row; y < end_row; y += settings.tile_height) {
    for (int x = 0; x < width; x += settings.tile_width) {
      tiles.push_back(
          {x, y, std::min(settings.tile_width, width - x), std::min(settings.tile_height, end_row - y)});
    }
  }
  return tiles;
}

std::size_t tiles_in(const RenderJob& job, const Settings& settings) {
  const auto parts = [](int of, int size) { return static_cast<std::size_t>((of + size - 1) / size); };
  return parts(job.width, settings.tile_width) * parts(job.height, settings.tile_height);
}

/// Reports the share that is done, by one thread at a time.
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

/// Says in words what the scene made of the engine.
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

/// Renders the bands of a picture.
template <class Real>
class BandRenderer {
 public:
  BandRenderer(const CompiledScene<Real>& scene, const View<Real>& view, const RenderJob& job,
               const Settings& settings)
      : view_(view),
        settings_(settings),
        renderers_([&scene, &view, &settings] { return make_tile_renderer(scene, view, settings.vectors); }),
        progress_(job.progress, tiles_in(job, settings)) {}

  Image rendered(int first_row, int rows) {
    Image band(view_.width, rows);
    const std::vector<Tile> tiles = tiles_of(view_.width, first_row, first_row + rows, settings_);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tiles.size()), [&](const auto& range) {
      std::array<float, 3 * pixels_of_tile> rgb;
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        const Tile& tile = tiles[i];
        renderers_.local()->render(tile, rgb.data());
        for (int y = 0; y < tile.height; ++y) {
          std::copy_n(&rgb[3 * static_cast<std::size_t>(y * tile.width)], 3 * tile.width,
                      band.pixel(tile.x, tile.y - first_row + y));
        }
        progress_.add_one();
      }
    });
    return band;
  }
  void add_counts_to(Statistics& counts) const {
    for (const auto& renderer : renderers_) counts.add_counts(renderer->statistics());
  }

 private:
  const View<Real>& view_;
  const Settings& settings_;
  tbb::enumerable_thread_specific<std::unique_ptr<TileRenderer<Real>>> renderers_;
  Progress progress_;
};

/// Two bands are in memory: one is taken while the other is rendered.
template <class Real>
void hand_on(BandRenderer<Real>& renderer, int height, int rows, const BandSink& sink) {
  Image done = renderer.rendered(0, std::min(rows, height));
  for (int y = rows; y < height; y += rows) {
    Image next;
    tbb::parallel_invoke([&] { sink.take(std::move(done)); },
                         [&] { next = renderer.rendered(y, std::min(rows, height - y)); });
    done = std::move(next);
  }
  sink.take(std::move(done));
}

template <class Real>
void render_in(const Scene& scene, const Camera& camera, const RenderJob& job, const BandSink& sink,
               Statistics* statistics, const Settings& settings) {
  Statistics counts;
  const int available = processors();
  const int threads = job.threads > 0 ? job.threads : available;
  const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(std::max(threads, available)));
  tbb::task_arena arena(std::max(threads, 1));
  const Stopwatch building;
  const CompiledScene<Real> compiled = arena.execute([&] { return compile<Real>(scene, settings); });
  counts.build = building.elapsed();

  const Stopwatch rendering;
  const View<Real> view = view_of<Real>(scene, camera, job);
  BandRenderer<Real> renderer(compiled, view, job, settings);
  const int rows = std::max(sink.rows / settings.tile_height, 1) * settings.tile_height;
  arena.execute([&] { hand_on(renderer, job.height, sink.rows < job.height ? rows : job.height, sink); });
  counts.render = rendering.elapsed();
  renderer.add_counts_to(counts);
  counts.bytes = bytes_of(compiled);
  counts.kernel = kernel_of(compiled, settings.vectors);
  counts.objects = compiled.spheres.size() + compiled.boxes.size();
  if (statistics != nullptr) *statistics = counts;
}

}  // namespace

void render(const Scene& scene, const Camera& camera, const RenderJob& job, const BandSink& sink,
            Statistics* statistics, const Settings& settings) {
  if (job.real == RealType::float32) {
    render_in<float>(scene, camera, job, sink, statistics, settings);
  } else {
    render_in<double>(scene, camera, job, sink, statistics, settings);
  }
}

Image render(const Scene& scene, const Camera& camera, const RenderJob& job, Statistics* statistics,
             const Settings& settings) {
  return in_one_band(job.height,
                     [&](const BandSink& sink) { render(scene, camera, job, sink, statistics, settings); });
}

}  // namespace plumb::engine
