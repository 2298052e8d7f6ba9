// Sends the rays of a stream through the hierarchy in bundles.

#if defined(PLUMB_ENGINE_FIND_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUMB_ENGINE_FIND_INL
#undef PLUMB_ENGINE_FIND_INL
#else
#define PLUMB_ENGINE_FIND_INL
#endif

#include "tracer/engine/traverse-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace plumb::engine::HWY_NAMESPACE {

template <class Real>
HWY_INLINE Vec3<Real> vector_at(const Lanes3<Real>& from, std::size_t lane) {
  return {from.x[lane], from.y[lane], from.z[lane]};
}

/// Finds, for one thread, what rays meet first, or whether they meet anything.
template <class Real>
class Finder {
 public:
  Finder(const CompiledScene<Real>& scene, Statistics& statistics)
      : scene_(scene),
        statistics_(statistics),
        size_limit_(scene.has_few_objects ? stream_size : most_of_many),
        width_limit_(widest_bundle(scene)) {}

  /// Sends rays through the hierarchy in bundles that are narrow in comparison with what they are to find.
  /// All rays end at `light`, unless it is null.
  template <bool any_hit>
  void find(Rays<Real>& rays, std::size_t begin, std::size_t size, bool knows_starts,
            const Vec3<Real>* light) {
    if (size == 1) return find_one<any_hit>(rays, begin, knows_starts, light);
    if (size > size_limit_) return find_halves<any_hit>(rays, begin, size, knows_starts, light);
    BoundsOfRays<Real> origins, directions;
    bool any = false;
    V<Real> t_min = set(Real(0));
    for (std::size_t i = begin; i < begin + size; i += lanes<Real>()) {
      const M<Real> is_asked = hn::And(first<Real>(begin + size - i), hn::Ge(load(&rays.t[i]), set(Real(0))));
      any = any || !none<Real>(is_asked);
      t_min = hn::Max(t_min, hn::IfThenElseZero(is_asked, load(&rays.t_min[i])));
      origins.add(is_asked, load3(rays.origin, i));
      if (light == nullptr) directions.add(is_asked, load3(rays.direction, i));
    }
    if (!any) return;
    const Group& world = scene_.groups[0];
    RayBounds bounds{origins.min(), origins.max(), {}, {}};
    if (light == nullptr) {
      bounds.slope_min = directions.min();
      bounds.slope_max = directions.max();
    } else {  // all end at the light
      bounds.slope_min = Vec3<double>(*light) - bounds.origin_min;
      bounds.slope_max = Vec3<double>(*light) - bounds.origin_max;
    }
    bounds.reach = static_cast<double>(hn::GetLane(hn::MaxOfLanes(Tag<Real>(), t_min)));
    const double width = width_of(bounds, world);
    if (width > width_limit_) {
      // If the rays are evenly apart, no two of them are near enough.
      const bool are_apart = size <= lanes<Real>() && width > width_limit_ * static_cast<double>(size) / 2;
      if (are_apart) return find_each<any_hit>(rays, begin, size, knows_starts, light);
      return find_halves<any_hit>(rays, begin, size, knows_starts, light);
    }
    Bundle bundle(bounds, world);
    if (light != nullptr) bundle.limit(1);
    send<any_hit>(rays, begin, size, knows_starts, bundle, bounds.reach);
  }

  /// True if all rays within these bounds certainly pass everything.
  bool meets_nothing(RayBounds rays) {
    const Group& world = scene_.groups[0];
    const Vec3<double> size = glm::max(glm::abs(rays.origin_min), glm::abs(rays.origin_max));
    rays.reach = static_cast<double>(formulas::resolution<Real>()) * std::max({size.x, size.y, size.z});
    ++statistics_.bundles;
    return world.root.kind() == Kind::none ||
           !may_meet(scene_.nodes, world.root.index(), Bundle(rays, world));
  }

 private:
  template <bool any_hit>
  void find_halves(Rays<Real>& rays, std::size_t begin, std::size_t size, bool knows_starts,
                   const Vec3<Real>* light) {
    const std::size_t half =
        size > 2 * lanes<Real>() ? size / 2 / lanes<Real>() * lanes<Real>() : (size + 1) / 2;
    find<any_hit>(rays, begin, half, knows_starts, light);
    find<any_hit>(rays, begin + half, size - half, knows_starts, light);
  }

  template <bool any_hit>
  void find_each(Rays<Real>& rays, std::size_t begin, std::size_t size, bool knows_starts,
                 const Vec3<Real>* light) {
    for (std::size_t i = begin; i < begin + size; ++i) find_one<any_hit>(rays, i, knows_starts, light);
  }

  template <bool any_hit>
  void find_one(Rays<Real>& rays, std::size_t i, bool knows_starts, const Vec3<Real>* light) {
    if (rays.t[i] < 0) return;
    const Vec3<double> origin(vector_at(rays.origin, i));
    const Vec3<double> direction(light == nullptr ? Vec3<double>(vector_at(rays.direction, i))
                                                  : Vec3<double>(*light) - origin);
    const RayBounds bounds{origin, origin, direction, direction, static_cast<double>(rays.t_min[i])};
    Bundle bundle(bounds, scene_.groups[0]);
    if (light != nullptr) bundle.limit(1);
    send<any_hit>(rays, i, 1, knows_starts, bundle, bounds.reach);
  }

  template <bool any_hit>
  void send(Rays<Real>& rays, std::size_t begin, std::size_t size, bool knows_starts, Bundle& bundle,
            double t_min) {
    ++statistics_.bundles;
    Traversal<Real, any_hit> traversal(scene_, rays, begin, size, knows_starts, t_min, workspace_,
                                       statistics_);
    RayView<Real> view{&rays.origin, &rays.direction, &rays.per_direction, begin, true};
    traversal.follow(scene_.groups[0], bundle, view, 0);
  }

  /// Returns the greatest width of a bundle. A few objects are fastest tested with all rays of a stream;
  /// otherwise a bundle is at most as wide as five typical objects.
  static double widest_bundle(const CompiledScene<Real>& scene) {
    if (scene.has_few_objects) return std::numeric_limits<double>::infinity();
    return 5 * scene.groups[0].typical_size;
  }

  /// Returns the width of a bundle, at its start and where it passes the middle of the scene, in the units of
  /// the world.
  static double width_of(const RayBounds& b, const Group& world) {
    const Vec3<double> center = (b.origin_min + b.origin_max) * 0.5 - world.center;
    const double way = std::max(1 / world.scale, glm::length(center));
    double widest = 0;
    for (int k = 0; k < 3; ++k) {
      const double start = b.origin_max[k] - b.origin_min[k];
      widest = std::max({widest, start, start + way * (b.slope_max[k] - b.slope_min[k])});
    }
    return widest * world.scale;
  }

  static constexpr std::size_t most_of_many = 64;  ///< most rays of a bundle where there are many objects

  const CompiledScene<Real>& scene_;
  Statistics& statistics_;
  const std::size_t size_limit_;
  const double width_limit_;
  Workspace<Real> workspace_;
};

}  // namespace plumb::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
