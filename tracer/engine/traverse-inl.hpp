// Takes rays through the hierarchy: the core loop.

#if defined(PLUMB_ENGINE_TRAVERSE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUMB_ENGINE_TRAVERSE_INL
#undef PLUMB_ENGINE_TRAVERSE_INL
#else
#define PLUMB_ENGINE_TRAVERSE_INL
#endif

#include <memory>

#include "tracer/engine/hierarchy_builder.hpp"
#include "tracer/engine/nodes-inl.hpp"
#include "tracer/engine/shapes-inl.hpp"
#include "tracer/engine/statistics.hpp"

HWY_BEFORE_NAMESPACE();
namespace plumb::engine::HWY_NAMESPACE {

/// Rays in the space of a group, from the first of a bundle on.
template <class Real>
struct RayView {
  const Lanes3<Real>* origin;
  const Lanes3<Real>* direction;
  Lanes3<Real>* per_direction;
  std::size_t begin;
  bool is_unit;
  bool has_inverses = false;  ///< true if per_direction is set for the rays of the bundle
  Grazing<Real> grazing{Vec3<Real>(1)};
  bool may_graze = true;  ///< as in RayVector; known once the inverses are
};

/// Rays in the space of a group that has a matrix.
template <class Real>
struct LocalRays {
  Lanes3<Real> origin, direction, per_direction;
};

template <class Real>
HWY_INLINE V3<Real> transformed_vector(const Affine<Real>& m, const V3<Real>& v) {
  return add<Real>(add<Real>(scaled<Real>(set3(m.x), v.x), scaled<Real>(set3(m.y), v.y)),
                   scaled<Real>(set3(m.z), v.z));
}
template <class Real>
HWY_INLINE V3<Real> transformed_point(const Affine<Real>& m, const V3<Real>& p) {
  return add<Real>(transformed_vector<Real>(m, p), set3(m.origin));
}

/// Is formulas::absolute_product for an Affine.
template <class Real>
HWY_INLINE Vec3<Real> absolute_product(const Affine<Real>& m, const Vec3<Real>& v) {
  return glm::abs(m.x) * v.x + glm::abs(m.y) * v.y + glm::abs(m.z) * v.z;
}

/// Bounds of vectors in the lanes that a mask keeps.
template <class Real>
class BoundsOfRays {
 public:
  HWY_INLINE BoundsOfRays()
      : low_{all_high(), all_high(), all_high()}, high_{all_low(), all_low(), all_low()} {}

  HWY_INLINE void add(M<Real> kept, const V3<Real>& v) {
    low_ = {lower(kept, low_.x, v.x), lower(kept, low_.y, v.y), lower(kept, low_.z, v.z)};
    high_ = {higher(kept, high_.x, v.x), higher(kept, high_.y, v.y), higher(kept, high_.z, v.z)};
  }
  HWY_INLINE Vec3<double> min() const { return {least(low_.x), least(low_.y), least(low_.z)}; }
  HWY_INLINE Vec3<double> max() const { return {greatest(high_.x), greatest(high_.y), greatest(high_.z)}; }

 private:
  static HWY_INLINE V<Real> all_high() { return set(std::numeric_limits<Real>::infinity()); }
  static HWY_INLINE V<Real> all_low() { return set(-std::numeric_limits<Real>::infinity()); }
  static HWY_INLINE V<Real> lower(M<Real> kept, V<Real> so_far, V<Real> v) {
    return hn::Min(so_far, hn::IfThenElse(kept, v, all_high()));
  }
  static HWY_INLINE V<Real> higher(M<Real> kept, V<Real> so_far, V<Real> v) {
    return hn::Max(so_far, hn::IfThenElse(kept, v, all_low()));
  }
  static HWY_INLINE double least(V<Real> v) {
    return static_cast<double>(hn::GetLane(hn::MinOfLanes(Tag<Real>(), v)));
  }
  static HWY_INLINE double greatest(V<Real> v) {
    return static_cast<double>(hn::GetLane(hn::MaxOfLanes(Tag<Real>(), v)));
  }

  V3<Real> low_, high_;
};

struct Waiting {
  std::uint32_t node;
  float t;
};

/// What a thread needs on its way down through all groups: a stack, and the rays of each nested group.
template <class Real>
struct Workspace {
  std::vector<Waiting> nodes;
  std::size_t size = 0;
  std::vector<std::unique_ptr<LocalRays<Real>>> local;
  std::size_t nested = 0;

  LocalRays<Real>& enter_group() {
    if (local.size() <= nested) local.push_back(std::make_unique_for_overwrite<LocalRays<Real>>());
    return *local[nested++];
  }
  void leave_group() { --nested; }
};

/// Finds what a bundle of rays meets: the nearest hit of each or, with any_hit, whether anything lies before
/// t.
template <class Real, bool any_hit>
class Traversal {
 public:
  Traversal(const CompiledScene<Real>& scene, Rays<Real>& rays, std::size_t begin, std::size_t size,
            bool knows_starts, double t_min, Workspace<Real>& workspace, Statistics& statistics)
      : scene_(scene),
        rays_(rays),
        begin_(begin),
        size_(size),
        knows_starts_(knows_starts),
        t_min_(t_min),
        workspace_(workspace),
        statistics_(statistics) {}

  HWY_NOINLINE void follow(const Group& group, Bundle& bundle, RayView<Real>& view, std::uint64_t first) {
    if (group.root.kind() == Kind::none) return;
    const std::size_t bottom = workspace_.size;
    workspace_.nodes.resize(std::max(workspace_.nodes.size(), bottom + greatest_depth * node_width));
    wait_for({group.root.index(), 0}, bottom);
    while (workspace_.size > bottom && !all_are_hidden_) {
      const Waiting next = workspace_.nodes[--workspace_.size];
      if (next.t > bundle.t_max) continue;
      ++statistics_.nodes;
      const Node& node = scene_.nodes[next.node];
      alignas(64) float entered[node_width];
      const std::size_t inner = workspace_.size;
      for (unsigned met = places_met(node, bundle, entered); met != 0; met &= met - 1) {
        const auto place = static_cast<unsigned>(__builtin_ctz(met));
        const Ref child = node.child[place];
        if (child.kind() == Kind::node) {
          wait_for({child.index(), entered[place]}, inner);
        } else if (entered[place] <= bundle.t_max) {
          meet_child(child, bundle, view, first);
        }
      }
    }
    workspace_.size = bottom;
  }

  /// Returns the largest t of the bundle: how far any of its rays still looks.
  Real farthest() const {
    V<Real> all = set(-std::numeric_limits<Real>::infinity());
    for (std::size_t i = 0; i < size_; i += lanes<Real>())
      all = hn::Max(all, hn::IfThenElse(first<Real>(size_ - i), load(&rays_.t[begin_ + i]),
                                        set(-std::numeric_limits<Real>::infinity())));
    return hn::GetLane(hn::MaxOfLanes(Tag<Real>(), all));
  }

 private:
  /// Puts a node on the stack. The nearest one is taken first.
  HWY_INLINE void wait_for(Waiting node, std::size_t inner) {
    Waiting* const nodes = workspace_.nodes.data();
    std::size_t to = workspace_.size++;
    if constexpr (!any_hit) {
      for (; to > inner && nodes[to - 1].t < node.t; --to) nodes[to] = nodes[to - 1];
    }
    nodes[to] = node;
  }

  HWY_INLINE void meet_child(Ref child, Bundle& bundle, RayView<Real>& view, std::uint64_t first) {
    bool changed = false;
    switch (child.kind()) {
      case Kind::sphere:
      case Kind::box:
        changed = meet_shape(child, child, nullptr, view, first);
        break;
      case Kind::placed: {
        const Placed<Real>& placed = scene_.placed[child.index()];
        changed = meet_shape(placed.shape, child, &placed.object_from_group, view, first);
        break;
      }
      case Kind::group:
        changed = meet_group(scene_.members[child.index()], view, first);
        break;
      default:
        return;  // an empty place, see may_meet()
    }
    if (changed) limit(bundle);
  }

  HWY_INLINE void limit(Bundle& bundle) {
    const Real t = farthest();
    if constexpr (any_hit) {
      all_are_hidden_ = t < 0;
    } else {
      bundle.limit(static_cast<double>(t) + t_min_);
    }
  }

  HWY_NOINLINE bool meet_group(const Member<Real>& member, RayView<Real>& view, std::uint64_t first) {
    LocalRays<Real>* const local = &workspace_.enter_group();
    BoundsOfRays<Real> origins, directions;
    for (std::size_t i = 0; i < size_; i += lanes<Real>()) {
      const V3<Real> origin =
          transformed_point<Real>(member.member_from_group, load3(*view.origin, view.begin + i));
      const V3<Real> direction =
          transformed_vector<Real>(member.member_from_group, load3(*view.direction, view.begin + i));
      store3<Real>(origin, local->origin, i);
      store3<Real>(direction, local->direction, i);
      origins.add(is_asked(i), origin);
      directions.add(is_asked(i), direction);
    }
    const Group& group = scene_.groups[member.group];
    RayBounds bounds{origins.min(), origins.max(), directions.min(), directions.max()};
    const Vec3<Real> world_length = absolute_product(member.member_from_group, view.grazing.world_length());
    bounds.reach = t_min_ * static_cast<double>(std::max({world_length.x, world_length.y, world_length.z}));
    Bundle bundle(bounds, group);
    bundle.limit(static_cast<double>(farthest()) + t_min_);
    const std::uint64_t hits = hits_;
    RayView<Real> inside{&local->origin, &local->direction,          &local->per_direction, 0, false,
                         false,          Grazing<Real>(world_length)};
    follow(group, bundle, inside, first + member.first);
    workspace_.leave_group();
    return hits_ != hits;
  }

  /// Tests all rays of the bundle against one shape. Returns whether it found anything nearer.
  HWY_INLINE bool meet_shape(Ref shape, Ref ref, const Affine<Real>* object_from_group, RayView<Real>& view,
                             std::uint64_t first) {
    const std::uint64_t instance = first + label_of(scene_, shape).instance;
    const std::uint64_t hits = hits_;
    if (shape.kind() == Kind::box && object_from_group == nullptr) {
      if (knows_starts_ && all_leave(ref, instance, view)) return false;
      if (!view.has_inverses) invert(view);
    }
    const Grazing<Real> grazing =
        object_from_group != nullptr
            ? Grazing<Real>(absolute_product(*object_from_group, view.grazing.world_length()))
            : view.grazing;
    for (std::size_t i = 0; i < size_; i += lanes<Real>()) {
      ++statistics_.shape_tests;
      RayVector<Real> ray = ray_vector(view, i);
      if (knows_starts_) set_own(ray, ref, instance, i);
      if (object_from_group != nullptr) {
        ray.origin = transformed_point<Real>(*object_from_group, ray.origin);
        ray.direction = transformed_vector<Real>(*object_from_group, ray.direction);
        ray.is_unit = false;
        ray.grazing = &grazing;
        ray.may_graze = true;
      }
      if (shape.kind() == Kind::sphere) {
        accept(meet<Real>(ray, scene_.spheres[shape.index()]), ref, instance, i, false);
      } else {
        const V3<Real> per_direction = object_from_group != nullptr
                                           ? inverses<Real>(ray.direction, grazing)
                                           : load3(*view.per_direction, view.begin + i);
        accept(meet<Real>(ray, per_direction, scene_.boxes[shape.index()]), ref, instance, i, true);
      }
    }
    return hits_ != hits;
  }

  HWY_INLINE RayVector<Real> ray_vector(const RayView<Real>& view, std::size_t i) const {
    return {load3(*view.origin, view.begin + i),
            load3(*view.direction, view.begin + i),
            load(&rays_.t_min[begin_ + i]),
            &rays_.t[begin_ + i],
            &view.grazing,
            view.may_graze,
            view.is_unit,
            false,
            hn::MaskFromVec(hn::Zero(Tag<Real>())),
            hn::Zero(WordTag<Real>())};
  }

  /// Returns the lanes that look for something: those within the bundle whose t is not negative.
  HWY_INLINE M<Real> is_asked(std::size_t i) const {
    return hn::And(HWY_NAMESPACE::first<Real>(size_ - i), hn::Ge(load(&rays_.t[begin_ + i]), set(Real(0))));
  }

  /// True if all rays start on a face of this box and go away from it, as from a floor to the lights.
  HWY_INLINE bool all_leave(Ref box, std::uint64_t instance, const RayView<Real>& view) const {
    for (std::size_t i = 0; i < size_; i += lanes<Real>()) {
      RayVector<Real> ray = ray_vector(view, i);
      set_own(ray, box, instance, i);
      if (!ray.any_own || !none<Real>(hn::AndNot(leaves_own_box(ray), is_asked(i)))) return false;
    }
    return true;
  }

  HWY_NOINLINE void invert(RayView<Real>& view) const {
    const V3<Real> few = set3(view.grazing.few_roundings);
    M<Real> grazes = hn::MaskFromVec(hn::Zero(Tag<Real>()));
    for (std::size_t i = view.begin; i < view.begin + size_; i += lanes<Real>()) {
      const V3<Real> d = load3(*view.direction, i);
      store3<Real>(inverses<Real>(d, view.grazing), *view.per_direction, i);
      grazes = hn::Or(grazes, hn::Or(hn::Or(hn::Le(hn::Abs(d.x), few.x), hn::Le(hn::Abs(d.y), few.y)),
                                     hn::Le(hn::Abs(d.z), few.z)));
    }
    view.has_inverses = true;
    view.may_graze = !none<Real>(grazes);
  }

  /// Finds the lanes that start on this very shape, of this very instance.
  HWY_INLINE void set_own(RayVector<Real>& ray, Ref ref, std::uint64_t instance, std::size_t i) const {
    const WordTag<Real> w;
    const auto starts = hn::LoadU(w, &rays_.start[begin_ + i]);
    M<Real> own = hn::RebindMask(Tag<Real>(), hn::Eq(starts, hn::Set(w, static_cast<Word<Real>>(ref.bits))));
    if (HWY_LIKELY(none<Real>(own))) return;
    if (!scene_.members.empty()) {  // other instances of the shape have the same ref
      alignas(64) Word<Real> same[widest_vector] = {};
      for (std::size_t lane = 0; lane < lanes<Real>(); ++lane)
        same[lane] = rays_.start_instance[begin_ + i + lane] == instance ? ~Word<Real>{0} : Word<Real>{0};
      own = hn::And(own, hn::MaskFromVec(hn::BitCast(Tag<Real>(), hn::Load(w, same))));
    }
    ray.own = own;
    ray.own_face = hn::LoadU(w, &rays_.start_face[begin_ + i]);
    ray.any_own = !none<Real>(own);
  }

  /// Keeps hits that are nearer than those so far. What rounding cannot tell apart is one place, where the
  /// first instance is taken, as the textbook tracer does it.
  HWY_INLINE void accept(const Met<Real>& met, Ref ref, std::uint64_t instance, std::size_t i, bool is_box) {
    const WordTag<Real> w;
    Real* const best = &rays_.t[begin_ + i];
    const V<Real> nearest = load(best);
    M<Real> mask = met.mask;
    if (size_ - i < lanes<Real>()) mask = hn::And(mask, HWY_NAMESPACE::first<Real>(size_ - i));
    if constexpr (any_hit) {
      mask = hn::And(mask, hn::Lt(met.t, nearest));
      if (none<Real>(mask)) return;
      ++hits_;
      store<Real>(hn::IfThenElse(mask, set(Real(-1)), nearest), best);
    } else {
      const V<Real> about_t =
          hn::Add(load(&rays_.t_min[begin_ + i]), hn::Mul(set(formulas::resolution<Real>()), met.t));
      mask = hn::And(mask, hn::Lt(met.t, hn::Add(nearest, about_t)));
      if (none<Real>(mask)) return;
      const M<Real> is_tie = hn::And(mask, hn::Ge(met.t, hn::Sub(nearest, about_t)));
      if (HWY_UNLIKELY(!none<Real>(is_tie))) mask = hn::AndNot(later(is_tie, instance, i), mask);
      ++hits_;
      store<Real>(hn::IfThenElse(mask, met.t, nearest), best);
      Word<Real>* const refs = &rays_.ref[begin_ + i];
      const auto words = hn::RebindMask(w, mask);
      hn::StoreU(hn::IfThenElse(words, hn::Set(w, static_cast<Word<Real>>(ref.bits)), hn::LoadU(w, refs)), w,
                 refs);
      if (is_box) {
        Word<Real>* const faces = &rays_.face[begin_ + i];
        hn::StoreU(hn::IfThenElse(words, met.face, hn::LoadU(w, faces)), w, faces);
      }
      if (!scene_.needs_instances) return;
      for (unsigned bits = bits_of<Real>(mask); bits != 0; bits &= bits - 1)
        rays_.instance[begin_ + i + static_cast<unsigned>(__builtin_ctz(bits))] = instance;
    }
  }

  /// Returns the lanes of a tie whose instance so far comes first.
  HWY_NOINLINE M<Real> later(M<Real> is_tie, std::uint64_t instance, std::size_t i) const {
    alignas(64) Word<Real> known_first[widest_vector] = {};
    for (std::size_t lane = 0; lane < lanes<Real>(); ++lane)
      known_first[lane] = instance_of(begin_ + i + lane) < instance ? ~Word<Real>{0} : Word<Real>{0};
    return hn::And(is_tie, hn::MaskFromVec(hn::BitCast(Tag<Real>(), hn::Load(WordTag<Real>(), known_first))));
  }

  /// Returns the instance that a ray has hit so far.
  std::uint64_t instance_of(std::size_t lane) const {
    if (scene_.needs_instances) return rays_.instance[lane];
    const Ref ref(static_cast<std::uint32_t>(rays_.ref[lane]));
    if (ref.kind() == Kind::none) return 0;
    return label_of(scene_, ref).instance;
  }

  const CompiledScene<Real>& scene_;
  Rays<Real>& rays_;
  std::size_t begin_, size_;
  bool knows_starts_;
  double t_min_;  ///< the largest of all rays
  Workspace<Real>& workspace_;
  Statistics& statistics_;
  std::uint64_t hits_ = 0;
  bool all_are_hidden_ = false;
};

}  // namespace plumb::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
