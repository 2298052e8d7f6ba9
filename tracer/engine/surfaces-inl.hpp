// Finds normals and materials of what rays have hit.

#if defined(PLUMB_ENGINE_SURFACES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUMB_ENGINE_SURFACES_INL
#undef PLUMB_ENGINE_SURFACES_INL
#else
#define PLUMB_ENGINE_SURFACES_INL
#endif

#include "tracer/engine/find-inl.hpp"
#include "tracer/formulas/box.hpp"

HWY_BEFORE_NAMESPACE();
namespace plumb::engine::HWY_NAMESPACE {

/// Loads numbers of the material of each lane.
template <class Real>
class MaterialLanes {
 public:
  HWY_INLINE MaterialLanes(const std::vector<Material<Real>>& materials, const std::uint32_t* ids,
                           bool is_one)
      : base_(&materials[0].ambient.x), is_one_(is_one), id_(ids[0]), indices_(hn::Zero(Signed())) {
    if (HWY_LIKELY(is_one)) return;
    alignas(64) Word<Real> indices[widest_vector] = {};
    for (std::size_t lane = 0; lane < lanes<Real>(); ++lane)
      indices[lane] = static_cast<Word<Real>>(ids[lane] * stride);
    indices_ = hn::BitCast(Signed(), hn::Load(WordTag<Real>(), indices));
  }

  HWY_INLINE V<Real> number(std::size_t at) const {
    if (HWY_LIKELY(is_one_)) return set(base_[id_ * stride + at]);
    return hn::GatherIndex(Tag<Real>(), base_ + at, indices_);
  }
  HWY_INLINE V3<Real> colour(std::size_t at) const { return {number(at), number(at + 1), number(at + 2)}; }

  HWY_INLINE V3<Real> ambient() const { return colour(0); }
  HWY_INLINE V3<Real> kd() const { return colour(3); }
  HWY_INLINE V3<Real> ks() const { return colour(6); }
  HWY_INLINE V<Real> m() const { return number(9); }

 private:
  using Signed = hn::RebindToSigned<Tag<Real>>;
  static constexpr std::size_t stride = sizeof(Material<Real>) / sizeof(Real);
  const Real* base_;
  bool is_one_;
  std::size_t id_;
  hn::Vec<Signed> indices_;
};

/// Finds what shading needs to know of the hits in a scene.
template <class Real>
class Surfaces {
 public:
  explicit Surfaces(const CompiledScene<Real>& scene) : scene_(scene) {}

  /// Sets outward normals, of any length, and materials of what a vector of rays has hit.
  HWY_INLINE void set_normals(Level<Real>& level, std::size_t i, const V3<Real>& point) {
    const WordTag<Real> w;
    const std::size_t count = std::min(lanes<Real>(), level.size - i);
    const Ref one(static_cast<std::uint32_t>(level.rays.ref[i]));
    const auto is_one = hn::Eq(hn::LoadU(w, &level.rays.ref[i]), hn::Set(w, level.rays.ref[i]));
    const bool is_flat = scene_.members.empty() && (one.kind() == Kind::sphere || one.kind() == Kind::box);
    if (is_flat && hn::AllTrue(w, is_one)) {
      const std::uint32_t material = label_of(scene_, one).material;
      for (std::size_t lane = 0; lane < lanes<Real>(); ++lane) level.material[i + lane] = material;
      level.is_of_one[i] = true;
      if (one.kind() == Kind::sphere)
        store3<Real>(sub<Real>(point, set3(scene_.spheres[one.index()].center)), level.normal, i);
      else
        store3<Real>(face_normals(hn::LoadU(w, &level.rays.face[i])), level.normal, i);
      return;
    }
    level.is_of_one[i] = true;
    for (std::size_t lane = i; lane < i + lanes<Real>(); ++lane) {
      const Ref ref(lane < i + count ? static_cast<std::uint32_t>(level.rays.ref[lane]) : 0);
      const std::uint32_t of_none = lane == i ? 0 : level.material[i];
      level.material[lane] = ref.bits == 0 ? of_none : label_of(scene_, ref).material;
      level.is_of_one[i] &= level.material[lane] == level.material[i];
      set_normal(level, lane, ref.bits == 0 ? Vec3<Real>(0, 0, 1) : normal_at(level, lane, ref));
    }
  }

 private:
  HWY_INLINE static V3<Real> face_normals(W<Real> face) {
    return {face_normal(face, 0), face_normal(face, 1), face_normal(face, 2)};
  }
  HWY_INLINE static V<Real> face_normal(W<Real> face, unsigned axis) {
    const Tag<Real> d;
    const WordTag<Real> w;
    const auto low = hn::RebindMask(d, hn::Eq(face, hn::Set(w, static_cast<Word<Real>>(axis) * 2)));
    const auto high = hn::RebindMask(d, hn::Eq(face, hn::Set(w, static_cast<Word<Real>>(axis) * 2 + 1)));
    return hn::IfThenElseZero(hn::Or(low, high), hn::IfThenElse(low, set(Real(-1)), set(Real(1))));
  }
  Vec3<Real> normal_at(const Level<Real>& level, std::size_t lane, Ref ref) const {
    const Rays<Real>& rays = level.rays;
    const Face face = static_cast<Face>(rays.face[lane]);
    if (scene_.members.empty() && ref.kind() == Kind::sphere)
      return vector_at(level.point, lane) - scene_.spheres[ref.index()].center;
    if (scene_.members.empty() && ref.kind() == Kind::box) return formulas::box_normal<Real>(face);
    return normal_in(scene_.groups[0], rays.instance[lane], vector_at(rays.origin, lane),
                     vector_at(rays.direction, lane), rays.t[lane], ref, face);
  }
  static void set_normal(Level<Real>& level, std::size_t lane, const Vec3<Real>& n) {
    level.normal.x[lane] = n.x;
    level.normal.y[lane] = n.y;
    level.normal.z[lane] = n.z;
  }

  static Vec3<Real> vector_in(const Affine<Real>& m, const Vec3<Real>& v) {
    return m.x * v.x + m.y * v.y + m.z * v.z;
  }
  /// Slide "Anwendung": (M^-1)^T n.
  static Vec3<Real> normal_out(const Affine<Real>& inverse, const Vec3<Real>& n) {
    return {glm::dot(inverse.x, n), glm::dot(inverse.y, n), glm::dot(inverse.z, n)};
  }

  /// Slide "Composite, DAG": returns a hit's normal in the space of a group, through all matrices on its
  /// path.
  Vec3<Real> normal_in(const Group& group, std::uint64_t instance, const Vec3<Real>& origin,
                       const Vec3<Real>& direction, Real t, Ref ref, Face face) const {
    const auto begin = scene_.members.begin() + group.first_member, end = begin + group.members;
    auto member = std::upper_bound(
        begin, end, instance, [](std::uint64_t number, const Member<Real>& m) { return number < m.first; });
    if (member != begin && instance < (member - 1)->first + (member - 1)->count) {
      --member;
      const Affine<Real>& m = member->member_from_group;
      return normal_out(m, normal_in(scene_.groups[member->group], instance - member->first,
                                     vector_in(m, origin) + m.origin, vector_in(m, direction), t, ref, face));
    }
    if (ref.kind() == Kind::placed) {
      const Placed<Real>& placed = scene_.placed[ref.index()];
      const Affine<Real>& m = placed.object_from_group;
      return normal_out(
          m, normal_of(placed.shape, vector_in(m, origin) + m.origin, vector_in(m, direction), t, face));
    }
    return normal_of(ref, origin, direction, t, face);
  }
  Vec3<Real> normal_of(Ref shape, const Vec3<Real>& origin, const Vec3<Real>& direction, Real t,
                       Face face) const {
    if (shape.kind() == Kind::box) return formulas::box_normal<Real>(face);
    return origin + t * direction - scene_.spheres[shape.index()].center;
  }

  const CompiledScene<Real>& scene_;
};

}  // namespace plumb::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
