// A vector of rays against one shape: slides "Kugel" and "Quader" as in tracer/formulas, several rays at
// once.

#if defined(PLUMB_ENGINE_SHAPES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUMB_ENGINE_SHAPES_INL
#undef PLUMB_ENGINE_SHAPES_INL
#else
#define PLUMB_ENGINE_SHAPES_INL
#endif

#include "tracer/engine/math-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace plumb::engine::HWY_NAMESPACE {

/// The lanes that meet the shape at some t > t_min, and the smallest such t.
template <class Real>
struct Met {
  M<Real> mask;
  V<Real> t;
  W<Real> face;  ///< of a box
};

/// What a grazed surface cannot tell apart, in the space of the shape, as in formulas::plane_crossed_at.
template <class Real>
struct Grazing {
  Vec3<Real> few_roundings;  ///< of a world direction, along each axis
  Real most;                 ///< their sum, enough for any direction

  explicit Grazing(const Vec3<Real>& world_length)
      : few_roundings(world_length * formulas::grazing_slope<Real>()),
        most(few_roundings.x + few_roundings.y + few_roundings.z) {}
  Vec3<Real> world_length() const { return few_roundings / formulas::grazing_slope<Real>(); }
};

/// One vector of rays in the space of the shape.
template <class Real>
struct RayVector {
  V3<Real> origin, direction;
  V<Real> t_min;      ///< by rounding, a hit up to this t cannot be told from the origin
  const Real* known;  ///< t of a light ahead, or of the nearest hit so far
  const Grazing<Real>* grazing;
  bool may_graze;  ///< true if a lane may graze a plane of a box
  bool is_unit;    ///< true if directions have unit length
  bool any_own;    ///< true if a lane starts on the shape
  M<Real> own;     ///< the lanes that do
  W<Real> own_face;
};

/// Is formulas::one_place for vectors.
template <class Real>
HWY_INLINE V<Real> one_place(const RayVector<Real>& ray, V<Real> t) {
  return hn::Add(ray.t_min, hn::Mul(set(formulas::resolution<Real>()), t));
}

/// A quarter of the lecture's discriminant, as in formulas::intersect_sphere: a (r^2 - d^2), where d is the
/// distance of the centre from the line. half_b^2 - a c cancels where a sphere is small and far.
template <class Real>
HWY_INLINE V<Real> discriminant_of(const RayVector<Real>& ray, const Sphere<Real>& sphere,
                                   const V3<Real>& offset, V<Real> half_b, V<Real> a) {
  const V<Real> nearest = ray.is_unit ? half_b : hn::Div(half_b, a);
  const V3<Real> across = sub<Real>(offset, scaled<Real>(ray.direction, nearest));
  const V<Real> room = hn::Sub(set(sphere.radius * sphere.radius), dot<Real>(across, across));
  return ray.is_unit ? room : hn::Mul(a, room);
}

/// Is formulas::sphere_crossed_at for vectors.
template <class Real>
HWY_NOINLINE V<Real> crossed_at(RayVector<Real> ray, V3<Real> offset, Real radius, V<Real> root, V<Real> t) {
  const auto from_center = [&](V<Real> at)
                               HWY_ATTR { return add<Real>(offset, scaled<Real>(ray.direction, at)); };
  const V3<Real> there = from_center(t);
  const V3<Real> across{hn::Abs(there.x), hn::Abs(there.y), hn::Abs(there.z)};
  const V<Real> few = hn::Div(dot<Real>(across, set3(ray.grazing->few_roundings)), set(radius));
  const V<Real> t_known = load(ray.known);
  const auto is_at = [&](V<Real> known, V<Real> rounding) HWY_ATTR {
    const auto is_on_it = [&](V<Real> at) HWY_ATTR {
      const V3<Real> p = from_center(at);
      return hn::Lt(hn::Abs(hn::Sub(hn::Sqrt(dot<Real>(p, p)), set(radius))), hn::Mul(rounding, few));
    };
    return hn::And(is_on_it(known), is_on_it(hn::Mul(hn::Add(known, t), set(Real(0.5)))));
  };
  const M<Real> grazes = hn::Le(root, hn::Mul(few, set(radius)));
  const V<Real> zero = hn::Zero(Tag<Real>());
  const M<Real> is_here = hn::And(grazes, is_at(zero, ray.t_min));
  const M<Real> is_there = hn::And(grazes, is_at(t_known, one_place<Real>(ray, t_known)));
  return hn::IfThenElse(is_here, zero, hn::IfThenElse(is_there, t_known, t));
}

/// Is formulas::intersect_sphere for vectors.
template <class Real>
HWY_INLINE Met<Real> meet(const RayVector<Real>& ray, const Sphere<Real>& sphere) {
  const V<Real> zero = set(Real(0));
  const V3<Real> offset = sub<Real>(ray.origin, set3(sphere.center));
  const V<Real> half_b = dot<Real>(offset, ray.direction);
  const V<Real> c = hn::Sub(dot<Real>(offset, offset), set(sphere.radius * sphere.radius));
  const V<Real> a = ray.is_unit ? set(Real(1)) : dot<Real>(ray.direction, ray.direction);
  const V<Real> discriminant = discriminant_of(ray, sphere, offset, half_b, a);
  const M<Real> is_inward = hn::Lt(half_b, zero);
  const M<Real> is_outside = hn::Gt(c, zero);
  M<Real> mask = hn::And(hn::Ge(discriminant, zero), hn::Or(is_inward, hn::Not(is_outside)));
  if (!ray.any_own && none<Real>(mask)) return {mask, zero, hn::Zero(WordTag<Real>())};
  const V<Real> root = hn::Sqrt(discriminant);
  const V<Real> q = hn::Add(root, hn::Abs(half_b));  // root -+ half_b, whichever does not cancel
  V<Real> t = hn::Div(hn::Abs(c), q);
  const bool may_graze = !none<Real>(hn::And(mask, hn::Le(root, set(ray.grazing->most * sphere.radius))));
  if (HWY_UNLIKELY(may_graze)) t = crossed_at<Real>(ray, offset, sphere.radius, root, t);
  const M<Real> leaves = hn::And(is_inward, hn::Or(hn::Not(is_outside), hn::Le(t, ray.t_min)));
  if (!none<Real>(hn::And(mask, leaves))) {
    V<Real> leave = hn::Div(q, a);
    if (HWY_UNLIKELY(may_graze)) leave = crossed_at<Real>(ray, offset, sphere.radius, root, leave);
    t = hn::IfThenElse(leaves, leave, t);
  }
  if (ray.any_own) {
    mask = hn::Or(hn::AndNot(ray.own, mask), hn::And(ray.own, is_inward));
    t = hn::IfThenElse(ray.own, hn::Div(hn::Mul(set(Real(-2)), half_b), a), t);
  }
  return {hn::And(mask, hn::Gt(t, ray.t_min)), t, hn::Zero(WordTag<Real>())};
}

/// Where rays enter and leave the space between two planes of one axis.
template <class Real>
struct Slab {
  V<Real> enter, leave;
  M<Real> is_missed;
};

/// Returns the greatest component that is 0 by formulas::is_parallel. `few_roundings` is as Grazing has it.
template <class Real>
constexpr Real parallel_slope(Real few_roundings) {
  return few_roundings * (16 * std::numeric_limits<Real>::epsilon() / formulas::grazing_slope<Real>());
}

/// Returns 1 / v, or infinity where a component is 0 by formulas::is_parallel.
template <class Real>
HWY_INLINE V3<Real> inverses(const V3<Real>& v, const Grazing<Real>& grazing) {
  const V<Real> one = set(Real(1)), infinite = set(std::numeric_limits<Real>::infinity());
  const Vec3<Real>& few = grazing.few_roundings;
  const V3<Real> least =
      set3(Vec3<Real>(parallel_slope(few.x), parallel_slope(few.y), parallel_slope(few.z)));
  return {hn::IfThenElse(hn::Le(hn::Abs(v.x), least.x), infinite, hn::Div(one, v.x)),
          hn::IfThenElse(hn::Le(hn::Abs(v.y), least.y), infinite, hn::Div(one, v.y)),
          hn::IfThenElse(hn::Le(hn::Abs(v.z), least.z), infinite, hn::Div(one, v.z))};
}

/// The components of a vector of rays along one axis.
template <class Real>
struct RayAlong {
  V<Real> origin, direction, per_direction;
  Real few_roundings;  ///< as Grazing has it
};

template <class Real>
HWY_INLINE Slab<Real> slab(const RayAlong<Real>& along, Real low, Real high) {
  const V<Real> a = hn::Mul(hn::Sub(set(low), along.origin), along.per_direction);
  const V<Real> b = hn::Mul(hn::Sub(set(high), along.origin), along.per_direction);
  return {hn::Min(a, b), hn::Max(a, b), hn::MaskFromVec(hn::Zero(Tag<Real>()))};
}

template <class Real>
HWY_INLINE M<Real> grazes(const RayAlong<Real>& along) {
  return hn::Le(hn::Abs(along.direction), set(along.few_roundings));
}

/// Is formulas::plane_crossed_at for vectors.
template <class Real>
HWY_INLINE V<Real> crossed_at(const RayVector<Real>& ray, const RayAlong<Real>& along, Real plane) {
  const V<Real> few = set(along.few_roundings), t_known = load(ray.known);
  const V<Real> from_origin = hn::Sub(set(plane), along.origin);
  const V<Real> from_known = hn::Sub(set(plane), hn::Add(along.origin, hn::Mul(t_known, along.direction)));
  const M<Real> is_here = hn::And(grazes(along), hn::Le(hn::Abs(from_origin), hn::Mul(ray.t_min, few)));
  const M<Real> is_there =
      hn::And(grazes(along), hn::Lt(hn::Abs(from_known), hn::Mul(one_place<Real>(ray, t_known), few)));
  const V<Real> t = hn::Mul(from_origin, along.per_direction);
  return hn::IfThenElse(is_here, hn::Zero(Tag<Real>()), hn::IfThenElse(is_there, t_known, t));
}

/// Computes the same slab where some lanes graze its planes or are parallel to them.
template <class Real>
HWY_NOINLINE Slab<Real> seen_closely(RayVector<Real> ray, RayAlong<Real> along, Real low, Real high) {
  Slab<Real> found;
  const V<Real> infinite = set(std::numeric_limits<Real>::infinity());
  const M<Real> ascends = hn::Gt(along.direction, hn::Zero(Tag<Real>()));
  const V<Real> at_low = crossed_at<Real>(ray, along, low), at_high = crossed_at<Real>(ray, along, high);
  const M<Real> is_parallel = hn::Eq(along.per_direction, infinite);
  found.enter = hn::IfThenElse(is_parallel, hn::Neg(infinite), hn::IfThenElse(ascends, at_low, at_high));
  found.leave = hn::IfThenElse(is_parallel, infinite, hn::IfThenElse(ascends, at_high, at_low));
  const V<Real> beside = hn::Mul(ray.t_min, set(along.few_roundings / formulas::grazing_slope<Real>()));
  found.is_missed = hn::And(is_parallel, hn::Or(hn::Lt(along.origin, hn::Sub(set(low), beside)),
                                                hn::Gt(along.origin, hn::Add(set(high), beside))));
  return found;
}

/// Returns the face of an axis by which a ray enters (or leaves).
template <class Real>
HWY_INLINE W<Real> face_of(V<Real> direction, unsigned axis, bool entered) {
  const WordTag<Real> w;
  const auto ascends = hn::RebindMask(w, hn::Gt(direction, set(Real(0))));
  const auto low = hn::Set(w, static_cast<Word<Real>>(axis) * 2),
             high = hn::Set(w, static_cast<Word<Real>>(axis) * 2 + 1);
  return entered ? hn::IfThenElse(ascends, low, high) : hn::IfThenElse(ascends, high, low);
}

template <class Real>
HWY_INLINE M<Real> starts_on_face(const RayVector<Real>& ray, W<Real> face) {
  return hn::And(ray.own, hn::RebindMask(Tag<Real>(), hn::Eq(ray.own_face, face)));
}
/// Returns the lanes that start on a face of the box and move away from it, or along it.
template <class Real>
HWY_INLINE M<Real> leaves_own_box(const RayVector<Real>& ray) {
  const auto leaves = [&](V<Real> direction, Real few_roundings, unsigned axis) HWY_ATTR {
    const M<Real> is_along = hn::Le(hn::Abs(direction), set(parallel_slope(few_roundings)));
    return hn::Or(starts_on_face(ray, face_of<Real>(direction, axis, false)),
                  hn::And(is_along, starts_on_face(ray, face_of<Real>(direction, axis, true))));
  };
  const Vec3<Real>& few = ray.grazing->few_roundings;
  return hn::Or(hn::Or(leaves(ray.direction.x, few.x, 0), leaves(ray.direction.y, few.y, 1)),
                leaves(ray.direction.z, few.z, 2));
}

/// Is formulas::intersect_box for vectors.
template <class Real>
HWY_INLINE Met<Real> meet(const RayVector<Real>& ray, const V3<Real>& per_direction, const Box<Real>& box) {
  const WordTag<Real> w;
  const V<Real> zero = set(Real(0));
  const V3<Real>& d = ray.direction;
  const Vec3<Real>& few = ray.grazing->few_roundings;
  const RayAlong<Real> along_x{ray.origin.x, d.x, per_direction.x, few.x};
  const RayAlong<Real> along_y{ray.origin.y, d.y, per_direction.y, few.y};
  const RayAlong<Real> along_z{ray.origin.z, d.z, per_direction.z, few.z};
  Slab<Real> x = slab<Real>(along_x, box.min.x, box.max.x);
  Slab<Real> y = slab<Real>(along_y, box.min.y, box.max.y);
  Slab<Real> z = slab<Real>(along_z, box.min.z, box.max.z);
  if (HWY_UNLIKELY(ray.may_graze) &&
      !none<Real>(hn::Or(hn::Or(grazes(along_x), grazes(along_y)), grazes(along_z)))) {
    x = seen_closely<Real>(ray, along_x, box.min.x, box.max.x);
    y = seen_closely<Real>(ray, along_y, box.min.y, box.max.y);
    z = seen_closely<Real>(ray, along_z, box.min.z, box.max.z);
  }
  M<Real> is_missed = hn::Or(hn::Or(x.is_missed, y.is_missed), z.is_missed);
  if (ray.any_own) {
    const auto starts_on = [&](W<Real> face) HWY_ATTR { return starts_on_face(ray, face); };
    // A ray moves away if it starts on the face where it would leave. On the face where it would enter, t is
    // 0.
    is_missed = hn::Or(is_missed, leaves_own_box(ray));
    x.enter = hn::IfThenElse(starts_on(face_of<Real>(d.x, 0, true)), zero, x.enter);
    y.enter = hn::IfThenElse(starts_on(face_of<Real>(d.y, 1, true)), zero, y.enter);
    z.enter = hn::IfThenElse(starts_on(face_of<Real>(d.z, 2, true)), zero, z.enter);
  }
  const V<Real> enter = hn::Max(hn::Max(x.enter, y.enter), z.enter);
  const V<Real> leave = hn::Min(hn::Min(x.leave, y.leave), z.leave);
  M<Real> enters = hn::Gt(enter, ray.t_min);
  if (ray.any_own) enters = hn::AndNot(ray.own, enters);
  const V<Real> t = hn::IfThenElse(enters, enter, leave);
  const M<Real> is_through = hn::Le(enter, hn::Add(leave, one_place(ray, leave)));
  const M<Real> mask = hn::AndNot(is_missed, hn::And(is_through, hn::Gt(t, ray.t_min)));
  if (none<Real>(mask)) return {mask, t, hn::Zero(w)};
  const V<Real> about_t = one_place(ray, t);
  const auto face = [&](V<Real> of_x, V<Real> of_y, V<Real> all, bool entered) HWY_ATTR {
    const auto is_there = [&](V<Real> one) HWY_ATTR {
      return hn::RebindMask(w, hn::Le(hn::Abs(hn::Sub(one, all)), about_t));
    };
    const auto by_x = is_there(of_x), by_y = is_there(of_y);
    return hn::IfThenElse(
        by_x, face_of<Real>(d.x, 0, entered),
        hn::IfThenElse(by_y, face_of<Real>(d.y, 1, entered), face_of<Real>(d.z, 2, entered)));
  };
  const W<Real> at_entry = face(x.enter, y.enter, enter, true);
  if (none<Real>(hn::AndNot(enters, mask))) return {mask, t, at_entry};
  const W<Real> at_exit = face(x.leave, y.leave, leave, false);
  return {mask, t, hn::IfThenElse(hn::RebindMask(w, enters), at_entry, at_exit)};
}

}  // namespace plumb::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
