// Tests a bundle of rays against the boxes of the hierarchy.

#if defined(PLUMB_ENGINE_NODES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUMB_ENGINE_NODES_INL
#undef PLUMB_ENGINE_NODES_INL
#else
#define PLUMB_ENGINE_NODES_INL
#endif

#include "tracer/engine/bundle.hpp"
#include "tracer/engine/math-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace plumb::engine::HWY_NAMESPACE {

template <class D>
HWY_INLINE hn::Vec<D> reached(D d, const Node& node, const Bundle::HalfLine& line, std::size_t at) {
  const auto plane = hn::LoadU(d, &node.planes[line.plane][at]);
  return hn::Mul(hn::Sub(plane, hn::Set(d, line.origin)), hn::Set(d, line.per_slope));
}

/// Returns the places of a node that the bundle may meet, as bits, and sets `entered` to the t from which on.
HWY_INLINE unsigned places_met(const Node& node, const Bundle& bundle, float* entered) {
  const hn::CappedTag<float, node_width> d;
  unsigned met = 0;
  for (std::size_t at = 0; at < node_width; at += hn::Lanes(d)) {
    auto near = hn::Max(hn::Max(hn::Zero(d), reached(d, node, bundle.line[0], at)),
                        hn::Max(reached(d, node, bundle.line[1], at), reached(d, node, bundle.line[2], at)));
    auto far = hn::Set(d, bundle.t_max);
    if (HWY_LIKELY(bundle.enters == 3)) {
      far = hn::Min(hn::Min(far, reached(d, node, bundle.line[3], at)),
                    hn::Min(reached(d, node, bundle.line[4], at), reached(d, node, bundle.line[5], at)));
    } else {
      near = hn::Zero(d);
      for (unsigned i = 0; i < bundle.enters; ++i) near = hn::Max(near, reached(d, node, bundle.line[i], at));
      for (unsigned i = bundle.enters; i < 6; ++i) far = hn::Min(far, reached(d, node, bundle.line[i], at));
    }
    // Each t is off by at most three roundings (Ize, "Robust BVH Ray Traversal", 2013).
    const auto mask = hn::Le(near, hn::Mul(far, hn::Set(d, 1 + 8 * std::numeric_limits<float>::epsilon())));
    hn::StoreU(near, d, entered + at);
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, mask, bytes);
    met |= static_cast<unsigned>(bytes[0]) << at;
  }
  return met;
}

/// True if the bundle may meet anything below a node.
inline bool may_meet(const std::vector<Node>& nodes, std::uint32_t index, const Bundle& bundle) {
  alignas(64) float entered[node_width];
  for (unsigned met = places_met(nodes[index], bundle, entered); met != 0; met &= met - 1) {
    const Ref child = nodes[index].child[static_cast<unsigned>(__builtin_ctz(met))];
    if (child.kind() == Kind::none)
      continue;  // an empty place, which a bundle that widens to all sides meets at infinity
    if (child.kind() != Kind::node || may_meet(nodes, child.index(), bundle)) return true;
  }
  return false;
}

}  // namespace plumb::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
