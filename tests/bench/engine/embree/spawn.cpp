#include <cmath>

#include "tests/bench/engine/embree/shading.hpp"

namespace plumb::bench {

void Shader::spawn(const Batch& batch, int block, const Surfaces& s, Batch& next) const {
  for (int i = 0; i < lanes; ++i) {
    if (s.is_hit[i] != 0 && looks_.spawns[static_cast<std::size_t>(s.material[i])] != 0)
      spawn_one(batch, block, i, s, next);
  }
}

namespace {

/// A new ray at a hit: `side` is 1 to stay on the viewer's side of the surface, -1 to cross it.
void append(const Block& from, int lane, const Surfaces& s, const float* direction, float side,
            const float* weight, const Media* media, Batch& next) {
  Block& block = next.blocks[static_cast<std::size_t>(next.count / lanes)];
  const int i = next.count % lanes;
  RTCRay16& ray = block.ray.ray;
  const float off = side * s.offset[lane];
  ray.org_x[i] = s.point[0][lane] + off * s.normal[0][lane];
  ray.org_y[i] = s.point[1][lane] + off * s.normal[1][lane];
  ray.org_z[i] = s.point[2][lane] + off * s.normal[2][lane];
  ray.dir_x[i] = direction[0], ray.dir_y[i] = direction[1], ray.dir_z[i] = direction[2];
  ray.tnear[i] = 0, ray.tfar[i] = no_limit;
  ray.time[i] = 0, ray.mask[i] = ~0U, ray.id[i] = 0, ray.flags[i] = 0;
  block.ray.hit.geomID[i] = block.ray.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  for (int c = 0; c < 3; ++c) block.weight[c][i] = weight[c];
  block.pixel[i] = from.pixel[lane];
  if (media != nullptr) next.media[static_cast<std::size_t>(next.count)] = *media;
  ++next.count;
}

/// A number for the object that was hit; the six quads of a box are one object.
std::uint64_t object_of(const RTCHit16& hit, int i) {
  const bool is_box = hit.geomID[i] == quad_geometry;
  const std::uint64_t primitive = is_box ? hit.primID[i] / 6 : hit.primID[i];
  return (std::uint64_t{hit.instID[0][i]} << 32 | primitive) << 1 | (is_box ? 1 : 0);
}

}  // namespace

void Shader::spawn_one(const Batch& batch, int number, int i, const Surfaces& s, Batch& next) const {
  const Block& block = batch.blocks[static_cast<std::size_t>(number)];
  const RTCRay16& ray = block.ray.ray;
  const auto material = static_cast<std::size_t>(s.material[i]);
  const float d[3] = {ray.dir_x[i], ray.dir_y[i], ray.dir_z[i]};
  const float n[3] = {s.normal[0][i], s.normal[1][i], s.normal[2][i]};
  const float cos_i = -(d[0] * n[0] + d[1] * n[1] + d[2] * n[2]);
  const Media* media = batch.media ? &batch.media[static_cast<std::size_t>(number * lanes + i)] : nullptr;
  float mirrored[3], weight[3], whole[3];
  for (int c = 0; c < 3; ++c) {
    mirrored[c] = d[c] + 2 * cos_i * n[c];
    weight[c] = block.weight[c][i] * looks_.mirror[c][material];
    whole[c] = block.weight[c][i];
  }
  const auto& transmit = looks_.transmit;
  if (transmit[0][material] + transmit[1][material] + transmit[2][material] > 0) {
    Media beyond = *media;
    const float ratio = beyond.cross(object_of(block.ray.hit, i), looks_.eta[material]);
    const float cos_t_squared = 1 - ratio * ratio * (1 - cos_i * cos_i);
    if (cos_t_squared < 0) return append(block, i, s, mirrored, 1, whole, media, next);
    float bent[3], through[3];
    for (int c = 0; c < 3; ++c) {
      bent[c] = ratio * d[c] + (ratio * cos_i - std::sqrt(cos_t_squared)) * n[c];
      through[c] = whole[c] * transmit[c][material];
    }
    append(block, i, s, bent, -1, through, &beyond, next);
  }
  if (weight[0] + weight[1] + weight[2] > 0) append(block, i, s, mirrored, 1, weight, media, next);
}

}  // namespace plumb::bench
