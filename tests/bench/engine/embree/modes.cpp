#include "tests/bench/engine/embree/modes.hpp"

#include <algorithm>

namespace plumb::bench {
namespace {

/// Packets of sixteen never get the incoherent flag: with it Debian's Embree 3.13.5 does not return from
/// rtcIntersect16 of mirrored rays among instances, and elsewhere it is no faster.
RTCIntersectContext context_for(Mode mode, bool are_coherent) {
  const bool is_packet = mode == Mode::packet8 || mode == Mode::packet16;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags =
      is_packet || are_coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  return context;
}

RTCRay one_ray(const RTCRay16& r, int i) {
  return {r.org_x[i], r.org_y[i], r.org_z[i], r.tnear[i], r.dir_x[i], r.dir_y[i],
          r.dir_z[i], 0,          r.tfar[i],  ~0U,        0,          0};
}

RTCRayHit one_query(const RTCRay16& rays, int i) {
  RTCRayHit query{};
  query.ray = one_ray(rays, i);
  query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return query;
}

void store_hit(const RTCRayHit& found, RTCRayHit16& to, int i) {
  to.ray.tfar[i] = found.ray.tfar;
  to.hit.Ng_x[i] = found.hit.Ng_x;
  to.hit.Ng_y[i] = found.hit.Ng_y;
  to.hit.Ng_z[i] = found.hit.Ng_z;
  to.hit.primID[i] = found.hit.primID;
  to.hit.geomID[i] = found.hit.geomID;
  to.hit.instID[0][i] = found.hit.instID[0];
}

/// -1 for the lanes that hold a ray, as Embree's packets want it.
struct alignas(64) Valid {
  explicit Valid(const RTCRay16& rays) {
    for (int i = 0; i < lanes; ++i) mask[i] = rays.tfar[i] >= 0 ? -1 : 0;
  }
  int mask[lanes];
};

/// Half of a packet: eight lanes from `first` on, array by array. Both structures hold 4-byte members alone.
template <class Eight, class Sixteen>
void copy_half(const Sixteen& from, int first, Eight& to) {
  const auto* source = reinterpret_cast<const std::uint32_t*>(&from);
  auto* target = reinterpret_cast<std::uint32_t*>(&to);
  for (std::size_t member = 0; member < sizeof(Eight) / 32; ++member)
    std::copy_n(source + 16 * member + first, 8, target + 8 * member);
}
template <class Eight, class Sixteen>
void copy_back(const Eight& from, int first, Sixteen& to) {
  const auto* source = reinterpret_cast<const std::uint32_t*>(&from);
  auto* target = reinterpret_cast<std::uint32_t*>(&to);
  for (std::size_t member = 0; member < sizeof(Eight) / 32; ++member)
    std::copy_n(source + 8 * member, 8, target + 16 * member + first);
}

}  // namespace

void Caster::intersect(Block* blocks, int count, bool are_coherent) {
  RTCIntersectContext context = context_for(mode_, are_coherent);
  if (mode_ == Mode::stream_1m) return intersect_all(blocks, count, context);
  if (mode_ == Mode::stream_nm) {
    return rtcIntersectNM(scene_, &context, reinterpret_cast<RTCRayHitN*>(&blocks->ray), lanes,
                          static_cast<unsigned>(count), sizeof(Block));
  }
  for (int b = 0; b < count; ++b) intersect_each(blocks[b], context);
}

void Caster::intersect_each(Block& block, RTCIntersectContext& context) const {
  const Valid valid(block.ray.ray);
  if (mode_ == Mode::packet16) return rtcIntersect16(valid.mask, scene_, &context, &block.ray);
  if (mode_ == Mode::packet8) {
    for (int first = 0; first < lanes; first += 8) {
      RTCRayHit8 half;
      copy_half(block.ray, first, half);
      rtcIntersect8(valid.mask + first, scene_, &context, &half);
      copy_back(half, first, block.ray);
    }
    return;
  }
  for (int i = 0; i < lanes; ++i) {
    if (valid.mask[i] == 0) continue;
    RTCRayHit query = one_query(block.ray.ray, i);
    rtcIntersect1(scene_, &context, &query);
    store_hit(query, block.ray, i);
  }
}

void Caster::intersect_all(Block* blocks, int count, RTCIntersectContext& context) {
  hits_.clear();
  for (int i = 0; i < count * lanes; ++i) hits_.push_back(one_query(blocks[i / lanes].ray.ray, i % lanes));
  rtcIntersect1M(scene_, &context, hits_.data(), static_cast<unsigned>(hits_.size()), sizeof(RTCRayHit));
  for (int i = 0; i < count * lanes; ++i)
    store_hit(hits_[static_cast<std::size_t>(i)], blocks[i / lanes].ray, i % lanes);
}

void Caster::occlude(ShadowBlock* blocks, int count, bool are_coherent) {
  RTCIntersectContext context = context_for(mode_, are_coherent);
  if (mode_ == Mode::stream_1m) return occlude_all(blocks, count, context);
  if (mode_ == Mode::stream_nm) {
    return rtcOccludedNM(scene_, &context, reinterpret_cast<RTCRayN*>(&blocks->ray), lanes,
                         static_cast<unsigned>(count), sizeof(ShadowBlock));
  }
  for (int b = 0; b < count; ++b) occlude_each(blocks[b], context);
}

void Caster::occlude_each(ShadowBlock& block, RTCIntersectContext& context) const {
  const Valid valid(block.ray);
  if (mode_ == Mode::packet16) return rtcOccluded16(valid.mask, scene_, &context, &block.ray);
  if (mode_ == Mode::packet8) {
    for (int first = 0; first < lanes; first += 8) {
      RTCRay8 half;
      copy_half(block.ray, first, half);
      rtcOccluded8(valid.mask + first, scene_, &context, &half);
      copy_back(half, first, block.ray);
    }
    return;
  }
  for (int i = 0; i < lanes; ++i) {
    if (valid.mask[i] == 0) continue;
    RTCRay ray = one_ray(block.ray, i);
    rtcOccluded1(scene_, &context, &ray);
    block.ray.tfar[i] = ray.tfar;
  }
}

void Caster::occlude_all(ShadowBlock* blocks, int count, RTCIntersectContext& context) {
  rays_.clear();
  for (int i = 0; i < count * lanes; ++i) rays_.push_back(one_ray(blocks[i / lanes].ray, i % lanes));
  rtcOccluded1M(scene_, &context, rays_.data(), static_cast<unsigned>(rays_.size()), sizeof(RTCRay));
  for (int i = 0; i < count * lanes; ++i)
    blocks[i / lanes].ray.tfar[i % lanes] = rays_[static_cast<std::size_t>(i)].tfar;
}

}  // namespace plumb::bench
