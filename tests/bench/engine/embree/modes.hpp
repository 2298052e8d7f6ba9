// The ways in which Embree takes rays.
#pragma once

#include <array>
#include <vector>

#include "tests/bench/engine/embree/batch.hpp"

namespace plumb::bench {

enum class Mode { single, packet8, packet16, stream_1m, stream_nm };

struct NamedMode {
  Mode mode;
  const char* name;
};
inline constexpr std::array<NamedMode, 5> modes{{{Mode::single, "single"},
                                                 {Mode::packet8, "packet8"},
                                                 {Mode::packet16, "packet16"},
                                                 {Mode::stream_1m, "stream1M"},
                                                 {Mode::stream_nm, "streamNM"}}};

/// Casts batches in one mode; one for each thread.
class Caster {
 public:
  Caster(RTCScene scene, Mode mode) : scene_(scene), mode_(mode) {}

  /// The nearest hits of all rays. Rays are coherent when they come from one eye or go to one light.
  void intersect(Block* blocks, int count, bool are_coherent);
  /// tfar < 0 where something is met.
  void occlude(ShadowBlock* blocks, int count, bool are_coherent);

 private:
  void intersect_each(Block& block, RTCIntersectContext& context) const;
  void intersect_all(Block* blocks, int count, RTCIntersectContext& context);
  void occlude_each(ShadowBlock& block, RTCIntersectContext& context) const;
  void occlude_all(ShadowBlock* blocks, int count, RTCIntersectContext& context);

  RTCScene scene_;
  Mode mode_;
  std::vector<RTCRayHit> hits_;
  std::vector<RTCRay> rays_;
};

}  // namespace plumb::bench
