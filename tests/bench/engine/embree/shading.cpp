#include "tests/bench/engine/embree/shading.hpp"

#include <algorithm>
#include <cmath>

namespace plumb::bench {
namespace {

float length_squared(float x, float y, float z) { return x * x + y * y + z * z; }

void append_colour(const Rgbd& colour, std::vector<float> (&to)[3]) {
  for (int c = 0; c < 3; ++c) to[c].push_back(static_cast<float>(colour[c]));
}

}  // namespace

Looks::Looks(const Scene& scene) : has_highlights(false), has_glass(false), has_secondary(false) {
  for (const Material& material : scene.materials) {
    append_colour(scene.ambient * material.ka, ambient);
    append_colour(material.kd, kd);
    append_colour(material.ks, ks);
    append_colour(material.mirror, mirror);
    append_colour(material.transmit, transmit);
    m.push_back(static_cast<float>(material.m));
    eta.push_back(static_cast<float>(material.eta));
    spawns.push_back(material.mirrors() || material.transmits() ? 1 : 0);
    has_highlights = has_highlights || material.ks != Rgbd(0);
    has_glass = has_glass || material.transmits();
    has_secondary = has_secondary || spawns.back() != 0;
  }
  for (const plumb::Light& from : scene.lights) {
    Light& to = lights.emplace_back();
    for (int c = 0; c < 3; ++c) {
      to.position[c] = static_cast<float>(from.position[c]);
      to.intensity[c] = static_cast<float>(from.intensity()[c]);
    }
  }
  for (int c = 0; c < 3; ++c) background[c] = static_cast<float>(scene.background[c]);
}

Surfaces Shader::surfaces(const Block& block) const {
  const auto& [ray, hit] = block.ray;
  Surfaces s;
  alignas(64) std::int32_t slot[lanes];
#pragma omp simd
  for (int i = 0; i < lanes; ++i) {
    s.is_hit[i] = ray.tfar[i] >= 0 && hit.geomID[i] != RTC_INVALID_GEOMETRY_ID ? 1 : 0;
    const auto instance = static_cast<std::int32_t>(hit.instID[0][i]);
    slot[i] =
        s.is_hit[i] != 0 && instance >= 0 ? instance - static_cast<std::int32_t>(first_instance) + 1 : 0;
    const std::int32_t first = hit.geomID[i] == quad_geometry ? objects_.first_primitive[1][slot[i]]
                                                              : objects_.first_primitive[0][slot[i]];
    s.material[i] =
        objects_.material[s.is_hit[i] != 0 ? first + static_cast<std::int32_t>(hit.primID[i]) : 0];
  }
  const auto& n = objects_.normal_matrix;
  const bool has_instances = objects_.has_instances;
#pragma omp simd
  for (int i = 0; i < lanes; ++i) {
    float x = hit.Ng_x[i], y = hit.Ng_y[i], z = hit.Ng_z[i];
    if (has_instances) {
      const int at = slot[i];
      const float world_x = n[0][at] * x + n[1][at] * y + n[2][at] * z;
      const float world_y = n[3][at] * x + n[4][at] * y + n[5][at] * z;
      z = n[6][at] * x + n[7][at] * y + n[8][at] * z;
      x = world_x, y = world_y;
    }
    const float facing = x * ray.dir_x[i] + y * ray.dir_y[i] + z * ray.dir_z[i] > 0 ? -1.0F : 1.0F;
    const float factor = facing / std::sqrt(length_squared(x, y, z) + 1e-37F);
    s.normal[0][i] = factor * x, s.normal[1][i] = factor * y, s.normal[2][i] = factor * z;
    const float t = s.is_hit[i] != 0 ? ray.tfar[i] : 0.0F;
    const float px = ray.org_x[i] + t * ray.dir_x[i];
    const float py = ray.org_y[i] + t * ray.dir_y[i];
    const float pz = ray.org_z[i] + t * ray.dir_z[i];
    s.point[0][i] = px, s.point[1][i] = py, s.point[2][i] = pz;
    const float size = std::max(std::max(std::abs(px), std::abs(py)), std::max(std::abs(pz), t));
    s.offset[i] = size * 3.8e-6F;
  }
  return s;
}

void Shader::begin(Block& block, const Surfaces& s) const {
  for (int c = 0; c < 3; ++c) {
#pragma omp simd
    for (int i = 0; i < lanes; ++i) {
      const float seen = s.is_hit[i] != 0 ? looks_.ambient[c][s.material[i]] : looks_.background[c];
      block.colour[c][i] = block.weight[c][i] * seen;
    }
  }
}

void Shader::light(std::size_t index, const Block& block, const Surfaces& s, ShadowBlock& shadow) const {
  const auto& light = looks_.lights[index];
  const RTCRay16& ray = block.ray.ray;
  RTCRay16& to = shadow.ray;
  alignas(64) float cos_theta[lanes];
  alignas(64) float highlight[lanes] = {};
#pragma omp simd
  for (int i = 0; i < lanes; ++i) {
    const float off = s.offset[i];
    const float px = s.point[0][i] + off * s.normal[0][i];
    const float py = s.point[1][i] + off * s.normal[1][i];
    const float pz = s.point[2][i] + off * s.normal[2][i];
    const float x = light.position[0] - px, y = light.position[1] - py, z = light.position[2] - pz;
    const float inverse = 1 / std::sqrt(length_squared(x, y, z));
    to.org_x[i] = px, to.org_y[i] = py, to.org_z[i] = pz;
    to.dir_x[i] = x * inverse, to.dir_y[i] = y * inverse, to.dir_z[i] = z * inverse;
    cos_theta[i] = s.normal[0][i] * to.dir_x[i] + s.normal[1][i] * to.dir_y[i] + s.normal[2][i] * to.dir_z[i];
    const bool counts = s.is_hit[i] != 0 && cos_theta[i] > 0;
    to.tnear[i] = 0;
    to.tfar[i] = counts ? 1 / inverse : no_ray;
    to.time[i] = 0, to.mask[i] = ~0U, to.id[i] = 0, to.flags[i] = 0;
  }
  if (looks_.has_highlights) {
#pragma omp simd
    for (int i = 0; i < lanes; ++i) {
      const float twice = 2 * cos_theta[i];
      const float x = twice * s.normal[0][i] - to.dir_x[i];
      const float y = twice * s.normal[1][i] - to.dir_y[i];
      const float z = twice * s.normal[2][i] - to.dir_z[i];
      const float cos_alpha = -(x * ray.dir_x[i] + y * ray.dir_y[i] + z * ray.dir_z[i]);
      const float power = std::pow(std::max(cos_alpha, 1e-30F), looks_.m[s.material[i]]);
      highlight[i] = cos_alpha > 0 ? power : 0.0F;
    }
  }
  for (int c = 0; c < 3; ++c) {
    const float intensity = light.intensity[c];
#pragma omp simd
    for (int i = 0; i < lanes; ++i) {
      const int material = s.material[i];
      shadow.colour[c][i] = block.weight[c][i] * intensity *
                            (looks_.kd[c][material] * cos_theta[i] + looks_.ks[c][material] * highlight[i]);
    }
  }
}

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

void add_light(const ShadowBlock& shadow, Block& block) {
  for (int c = 0; c < 3; ++c) {
#pragma omp simd
    for (int i = 0; i < lanes; ++i) block.colour[c][i] += shadow.ray.tfar[i] > 0 ? shadow.colour[c][i] : 0.0F;
  }
}

}  // namespace plumb::bench
