#include "tests/bench/engine/embree/shading.hpp"

#include <algorithm>
#include <cmath>

namespace plumb::bench {
namespace {

float length_squared(float x, float y, float z) { return x * x + y * y + z * z; }

}  // namespace

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
    s.offset[i] = size * 7e-7F;  // six units in the last place
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

void add_light(const ShadowBlock& shadow, Block& block) {
  for (int c = 0; c < 3; ++c) {
#pragma omp simd
    for (int i = 0; i < lanes; ++i) block.colour[c][i] += shadow.ray.tfar[i] > 0 ? shadow.colour[c][i] : 0.0F;
  }
}

}  // namespace plumb::bench
