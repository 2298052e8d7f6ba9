#include "tests/bench/engine/embree/render.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "tests/bench/engine/embree/shading.hpp"
#include "tracer/scene/dielectrics.hpp"
#include "tracer/system/in_parallel.hpp"

namespace plumb::bench {
namespace {

/// Ray directions by pixel: corner + x right + y down, all float.
struct Eye {
  Eye(const Camera& camera, const EmbreeJob& job) {
    const CameraPose<double> pose = pose_of<double>(camera);
    const Mat4<double> m = formulas::camera_matrix(pose.eye, pose.direction, pose.up);
    const double distance = formulas::image_plane_distance(camera.fov_x_degrees);
    const auto toward = [&](int x, int y) {
      const Vec2<double> on_plane = formulas::image_plane_point<double>(x, y, job.width, job.height);
      return formulas::transform_vector(m, Vec3d(on_plane.x, on_plane.y, -distance));
    };
    origin = Vec3<float>(pose.eye);
    corner = Vec3<float>(toward(0, 0));
    right = Vec3<float>(toward(1, 0) - toward(0, 0));
    down = Vec3<float>(toward(0, 1) - toward(0, 0));
  }
  Vec3<float> origin, corner, right, down;
};

/// What one thread needs to render tile by tile.
class TileRenderer {
 public:
  TileRenderer(const EmbreeScene& embree, const Looks& looks, const Eye& eye, const EmbreeJob& job)
      : looks_(looks),
        eye_(eye),
        job_(job),
        caster_(embree.world(), job.mode),
        shader_(looks, embree.objects()),
        surfaces_(static_cast<std::size_t>(most_rays() / lanes + 1)),
        shadows_(std::make_unique<ShadowBlock[]>(surfaces_.size())),
        now_(most_rays()),
        next_(most_rays()) {
    if (looks.has_glass) {
      now_.media = std::make_unique<Media[]>(static_cast<std::size_t>(most_rays()));
      next_.media = std::make_unique<Media[]>(static_cast<std::size_t>(most_rays()));
    }
  }

  void render(int left, int top, Image& image) {
    camera_rays(left, top, image);
    for (int depth = 0; depth < job_.depth && now_.count > 0; ++depth) {
      now_.close();
      caster_.intersect(now_.blocks.get(), now_.block_count(), depth == 0);
      shade(depth + 1 < job_.depth && looks_.has_secondary, depth == 0);
      for (int i = 0; i < now_.count; ++i)
        add(now_.blocks[static_cast<std::size_t>(i / lanes)], i % lanes, image);
      std::swap(now_, next_);
    }
  }

 private:
  /// Glass makes two rays of one at every depth; beyond these the tile is too large for its batch.
  int most_rays() const {
    const int pixels = job_.tile * job_.tile;
    return looks_.has_glass ? pixels << std::min(job_.depth, 8) : pixels;
  }

  void camera_rays(int left, int top, const Image& image) {
    now_.count = 0;
    if (now_.media) std::fill_n(now_.media.get(), job_.tile * job_.tile, Media{});
    for (int y = top; y < top + job_.tile; y += 4) {
      for (int x = left; x < left + job_.tile; x += 4) {
        if (x >= image.width || y >= image.height) continue;
        fill_block(x, y, image, now_.blocks[static_cast<std::size_t>(now_.count / lanes)]);
        now_.count += lanes;
      }
    }
  }

  void fill_block(int left, int top, const Image& image, Block& block) const {
    RTCRay16& ray = block.ray.ray;
#pragma omp simd
    for (int i = 0; i < lanes; ++i) {
      const auto x = static_cast<float>(left + i % 4), y = static_cast<float>(top + i / 4);
      const float dx = eye_.corner.x + x * eye_.right.x + y * eye_.down.x;
      const float dy = eye_.corner.y + x * eye_.right.y + y * eye_.down.y;
      const float dz = eye_.corner.z + x * eye_.right.z + y * eye_.down.z;
      const float inverse = 1 / std::sqrt(dx * dx + dy * dy + dz * dz);
      ray.org_x[i] = eye_.origin.x, ray.org_y[i] = eye_.origin.y, ray.org_z[i] = eye_.origin.z;
      ray.dir_x[i] = dx * inverse, ray.dir_y[i] = dy * inverse, ray.dir_z[i] = dz * inverse;
      const bool is_inside = left + i % 4 < image.width && top + i / 4 < image.height;
      ray.tnear[i] = 0, ray.tfar[i] = is_inside ? no_limit : no_ray;
      ray.time[i] = 0, ray.mask[i] = ~0U, ray.id[i] = 0, ray.flags[i] = 0;
      block.ray.hit.geomID[i] = block.ray.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
      block.weight[0][i] = block.weight[1][i] = block.weight[2][i] = 1;
      block.pixel[i] = is_inside ? (top + i / 4) * image.width + left + i % 4 : -1;
    }
  }

  void shade(bool goes_on, bool are_coherent) {
    const int blocks = now_.block_count();
    next_.count = 0;
    for (int b = 0; b < blocks; ++b) {
      const auto at = static_cast<std::size_t>(b);
      surfaces_[at] = shader_.surfaces(now_.blocks[at]);
      shader_.begin(now_.blocks[at], surfaces_[at]);
    }
    for (std::size_t light = 0; light < looks_.lights.size(); ++light) {
      for (int b = 0; b < blocks; ++b) {
        const auto at = static_cast<std::size_t>(b);
        shader_.light(light, now_.blocks[at], surfaces_[at], shadows_[at]);
      }
      caster_.occlude(shadows_.get(), blocks, are_coherent);
      for (int b = 0; b < blocks; ++b)
        add_light(shadows_[static_cast<std::size_t>(b)], now_.blocks[static_cast<std::size_t>(b)]);
    }
    if (!goes_on) return;
    for (int b = 0; b < blocks; ++b) shader_.spawn(now_, b, surfaces_[static_cast<std::size_t>(b)], next_);
  }

  static void add(const Block& block, int lane, Image& image) {
    if (block.pixel[lane] < 0) return;
    float* pixel = image.rgb.data() + 3 * static_cast<std::size_t>(block.pixel[lane]);
    for (int c = 0; c < 3; ++c) pixel[c] += block.colour[c][lane];
  }

  const Looks& looks_;
  const Eye& eye_;
  const EmbreeJob& job_;
  Caster caster_;
  Shader shader_;
  std::vector<Surfaces> surfaces_;
  std::unique_ptr<ShadowBlock[]> shadows_;
  Batch now_, next_;
};

}  // namespace

Image render(const EmbreeScene& embree, const Scene& scene, const EmbreeJob& job) {
  const Camera& camera = scene.camera(scene.renders.front().camera);
  const CameraPose<double> pose = pose_of<double>(camera);
  const DielectricsAroundEye<double> around(scene, pose.eye, pose.direction);
  if (!around.ahead().empty() || around.is_on_surface())
    throw std::runtime_error("the eye is inside glass or on it, which this program does not know");
  const Looks looks(scene);
  const Eye eye(camera, job);
  Image image(job.width, job.height);
  const int across = (job.width + job.tile - 1) / job.tile, down = (job.height + job.tile - 1) / job.tile;
  std::atomic<int> next{0};
  const auto threads = static_cast<std::size_t>(std::max(job.threads, 1));
  in_parallel(threads, job.threads, [&](std::size_t) {
    TileRenderer renderer(embree, looks, eye, job);
    for (int tile = next++; tile < across * down; tile = next++)
      renderer.render(tile % across * job.tile, tile / across * job.tile, image);
  });
  return image;
}

}  // namespace plumb::bench
