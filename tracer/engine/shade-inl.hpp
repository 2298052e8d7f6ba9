// Slides "Verfolgen von Strahlen" to "Spiegelung, Brechung", for all rays of a tile at once, level by level.

#if defined(PLUMB_ENGINE_SHADE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUMB_ENGINE_SHADE_INL
#undef PLUMB_ENGINE_SHADE_INL
#else
#define PLUMB_ENGINE_SHADE_INL
#endif

#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <vector>

#include "tracer/engine/interiors.hpp"
#include "tracer/engine/surfaces-inl.hpp"
#include "tracer/engine/tile.hpp"
#include "tracer/formulas/phong.hpp"
#include "tracer/formulas/secondary.hpp"

HWY_BEFORE_NAMESPACE();
namespace plumb::engine::HWY_NAMESPACE {

/// Traces and shades all rays of a level before those of the next, and adds in the order of the textbook
/// tracer.
template <class Real>
class Shader final : public TileRenderer<Real> {
 public:
  Shader(const CompiledScene<Real>& scene, const View<Real>& view)
      : scene_(scene), view_(view), surfaces_(scene), finder_(scene, statistics_) {
    around_the_eye_ = inside_of(view.around_the_eye.ahead());
    media_around_the_eye_ = interiors_.size();
    set_what_camera_rays_share();
  }

  void render(const Tile& tile, float* rgb) override {
    if (finder_.meets_nothing(bounds_of(tile))) return show_background(tile, rgb);
    Level<Real>& level = level_at(0);
    for (const SamplePoint& sample : view_.samples) {
      level.size = start_tile(tile, sample);
      statistics_.camera_rays += level.size;
      trace(0);
      interiors_.shrink(media_around_the_eye_);
      if (view_.samples.size() > 1) add_sample(level, &sample == &view_.samples.front());
    }
    if (view_.samples.size() > 1)
      write(sum_, static_cast<Real>(view_.samples.size()), level, rgb);
    else
      write(level.colour, 1, level, rgb);
  }
  const Statistics& statistics() const override { return statistics_; }

 private:
  Level<Real>& level_at(std::size_t index) {
    while (levels_.size() <= index) levels_.push_back(std::make_unique<Level<Real>>());
    return *levels_[index];
  }

  /// Bounds all rays through a tile, to any place in its pixels. The rays are off by a few roundings.
  RayBounds bounds_of(const Tile& tile) const {
    const Vec3<double> right(view_.right), up(view_.up), forward(view_.forward), eye(view_.eye);
    RayBounds bounds{eye, eye};
    for (const int x : {tile.x, tile.x + tile.width}) {
      for (const int y : {tile.y, tile.y + tile.height}) {
        const Vec3<double> d =
            right * (double(x) / view_.width - 0.5) + up * ((0.5 * view_.height - y) / view_.width) + forward;
        bounds.slope_min = glm::min(bounds.slope_min, d);
        bounds.slope_max = glm::max(bounds.slope_max, d);
      }
    }
    const double tallness = std::max(1.0, double(view_.height) / view_.width);
    const Vec3<double> pad = (glm::abs(right) + glm::abs(up) * tallness + glm::abs(forward)) *
                             (16 * double(std::numeric_limits<Real>::epsilon()));
    bounds.slope_min -= pad;
    bounds.slope_max += pad;
    return bounds;
  }

  /// Fills a tile. The sum and the mean are rounded as those of rays are.
  void show_background(const Tile& tile, float* rgb) {
    const auto samples = view_.samples.size();
    Rgb<Real> sum = scene_.background;
    for (std::size_t i = 1; i < samples; ++i) sum += scene_.background;
    const Rgb<float> mean(samples == 1 ? sum : sum / static_cast<Real>(samples));
    const std::size_t pixels = static_cast<std::size_t>(tile.width) * static_cast<std::size_t>(tile.height);
    for (std::size_t i = 0; i < pixels; ++i) std::copy_n(&mean.x, 3, rgb + 3 * i);
    statistics_.camera_rays += pixels * samples;
  }

  void write(const Lanes3<Real>& colour, Real samples, const Level<Real>& level, float* rgb) const {
    for (std::size_t i = 0; i < level.size; i += lanes<Real>()) {
      const V<Real> count = set(samples);
      const V3<Real> c = load3(colour, i);
      const V3<Real> mean =
          samples == 1 ? c : V3<Real>{hn::Div(c.x, count), hn::Div(c.y, count), hn::Div(c.z, count)};
      alignas(64) Real channels[3][widest_vector];
      store<Real>(mean.x, channels[0]);
      store<Real>(mean.y, channels[1]);
      store<Real>(mean.z, channels[2]);
      const std::size_t count_here = std::min(lanes<Real>(), level.size - i);
      for (std::size_t lane = 0; lane < count_here; ++lane) {
        float* const pixel = rgb + 3 * level.parent[i + lane];
        for (int channel = 0; channel < 3; ++channel)
          pixel[channel] = static_cast<float>(channels[channel][lane]);
      }
    }
  }

  void add_sample(const Level<Real>& level, bool is_first) {
    for (std::size_t i = 0; i < level.size; i += lanes<Real>()) {
      const V3<Real> colour = load3(level.colour, i);
      store3<Real>(is_first ? colour : add<Real>(load3(sum_, i), colour), sum_, i);
    }
  }

  std::int32_t inside_of(const std::vector<EnclosingDielectric>& outermost_first) {
    std::int32_t stack = Interiors<Real>::nothing;
    for (const EnclosingDielectric& around : outermost_first)
      stack = interiors_.cross(stack, around.instance, static_cast<Real>(around.eta)).interior;
    return stack;
  }

  void set_what_camera_rays_share() {
    Level<Real>& level = level_at(0);
    level.interior.fill(around_the_eye_);
    for (std::size_t i = 0; i < stream_size; i += lanes<Real>()) {
      store3<Real>(set3(view_.eye), level.rays.origin, i);
      store_start(level.rays, i, set3(view_.eye), set(view_.around_the_eye.t_min()));
    }
  }

  /// Slide "Kameramodell", formulas::image_plane_point: makes one ray through each pixel, at the same place
  /// in all of them. Neighbours in the stream are neighbours in the picture: every 8, 16 or 64 rays are a
  /// block. The parent of a camera ray is its pixel in the tile.
  std::size_t start_tile(const Tile& tile, const SamplePoint& sample) {
    Level<Real>& level = level_at(0);
    const std::size_t size = number_pixels(tile, level);
    // In units of the plane's width: x - 1/2, and (1/2 - y) * height / width, each exactly 0 in the middle.
    // The whole numbers are added first and exactly, so that a ray does not depend on its pixel's tile.
    const V<Real> pixel = set(1 / static_cast<Real>(view_.width));
    const V<Real> left = set(static_cast<Real>(tile.x)), above = set(static_cast<Real>(tile.y));
    const V<Real> in_x = set(static_cast<Real>(sample.x)), in_y = set(static_cast<Real>(sample.y));
    const V<Real> middle_x = set(static_cast<Real>(view_.width) / 2);
    const V<Real> middle_y = set(static_cast<Real>(view_.height) / 2);
    const V3<Real> forward = set3(view_.forward);
    for (std::size_t i = 0; i < size; i += lanes<Real>()) {
      const V<Real> x = hn::Mul(hn::Add(hn::Sub(hn::Add(left, load(&pixel_x_[i])), middle_x), in_x), pixel);
      const V<Real> y = hn::Mul(hn::Sub(hn::Sub(middle_y, hn::Add(above, load(&pixel_y_[i]))), in_y), pixel);
      const V3<Real> across = scaled<Real>(set3(view_.right), x), along = scaled<Real>(set3(view_.up), y);
      store3<Real>(normalised<Real>(add<Real>(add<Real>(across, along), forward)), level.rays.direction, i);
    }
    if (view_.around_the_eye.is_on_surface()) {
      for (std::size_t i = 0; i < size; ++i)
        level.interior[i] = inside_of(view_.around_the_eye.of_ray(vector_at(level.rays.direction, i)));
    }
    return size;
  }
  /// Sets the place of each ray in the tile, unless it is known, and returns the number of rays.
  std::size_t number_pixels(const Tile& tile, Level<Real>& level) {
    const bool is_whole = tile.width == tile_edge && tile.height == tile_edge;
    if (is_whole && knows_whole_tile_) return tile_pixels.size();
    std::size_t size = 0;
    for (const TilePixel& pixel : tile_pixels) {
      if (pixel.x >= tile.width || pixel.y >= tile.height) continue;
      pixel_x_[size] = pixel.x;
      pixel_y_[size] = pixel.y;
      level.parent[size] = static_cast<std::uint32_t>(pixel.y * tile.width + pixel.x);
      ++size;
    }
    knows_whole_tile_ = is_whole;
    return size;
  }
  /// Sets t_min. A ray is no surer of its origin than the ray that found it.
  HWY_INLINE void store_start(Rays<Real>& rays, std::size_t i, const V3<Real>& origin, V<Real> found_by) {
    const V<Real> size = hn::Max(hn::Max(hn::Abs(origin.x), hn::Abs(origin.y)), hn::Abs(origin.z));
    store<Real>(hn::Max(hn::Mul(size, set(formulas::resolution<Real>())), found_by), &rays.t_min[i]);
  }

  void trace(std::size_t index) {
    Level<Real>& level = *levels_[index];
    const WordTag<Real> w;
    for (std::size_t i = 0; i < level.size; i += lanes<Real>()) {
      store<Real>(set(std::numeric_limits<Real>::infinity()), &level.rays.t[i]);
      hn::StoreU(hn::Zero(w), w, &level.rays.ref[i]);
    }
    finder_.template find<false>(level.rays, 0, level.size, index > 0, nullptr);
    shade(level);
    const bool is_last = view_.options.depth <= 1;  // any level after this one is black
    if ((scene_.mirrors || scene_.transmits) && !is_last) send_on(index);
  }

  void shade(Level<Real>& level) {
    const WordTag<Real> w;
    for (std::size_t i = 0; i < level.size; i += lanes<Real>()) {
      const auto refs = hn::LoadU(w, &level.rays.ref[i]);
      const M<Real> is_hit = hn::RebindMask(Tag<Real>(), hn::Ne(refs, hn::Zero(w)));
      const V3<Real> background = set3(scene_.background);
      if (none<Real>(is_hit)) {
        store3<Real>(background, level.colour, i);
        level.is_of_one[i] = true;
        level.material[i] = 0;
        continue;
      }
      const V3<Real> direction = load3(level.rays.direction, i);
      const V<Real> t = hn::IfThenElse(is_hit, load(&level.rays.t[i]), set(Real(0)));
      const V3<Real> point = add<Real>(load3(level.rays.origin, i), scaled<Real>(direction, t));
      store3<Real>(point, level.point, i);
      store3<Real>(point, shadow_.rays.origin, i);
      store_start(shadow_.rays, i, point, load(&level.rays.t_min[i]));
      hn::StoreU(refs, w, &shadow_.rays.start[i]);
      hn::StoreU(hn::LoadU(w, &level.rays.face[i]), w, &shadow_.rays.start_face[i]);
      surfaces_.set_normals(level, i, point);
      const V3<Real> normal = normalised<Real>(load3(level.normal, i));
      const M<Real> is_away = hn::Gt(dot<Real>(normal, direction), set(Real(0)));
      store3<Real>(where<Real>(is_away, {hn::Neg(normal.x), hn::Neg(normal.y), hn::Neg(normal.z)}, normal),
                   level.normal, i);
      const MaterialLanes<Real> material(scene_.materials, &level.material[i], level.is_of_one[i]);
      store3<Real>(where<Real>(is_hit, material.ambient(), background), level.colour, i);
    }
    if (!scene_.members.empty()) shadow_.rays.start_instance = level.rays.instance;
    for (const Light<Real>& light : scene_.lights) light_up(level, light);
  }

  /// Slides "Lambert", "Phong", "Schatten", "Vollstaendiges Modell": adds one light to all points.
  void light_up(Level<Real>& level, const Light<Real>& light) {
    const WordTag<Real> w;
    Rays<Real>& shadow = shadow_.rays;
    const V3<Real> position = set3(light.position);
    const bool through_glass = scene_.transmits && view_.options.glass_shadow != GlassShadow::full;
    for (std::size_t i = 0; i < level.size; i += lanes<Real>()) {
      const auto refs = hn::LoadU(w, &level.rays.ref[i]);
      const M<Real> is_hit = hn::RebindMask(Tag<Real>(), hn::Ne(refs, hn::Zero(w)));
      if (none<Real>(is_hit)) {
        store<Real>(set(Real(-1)), &shadow.t[i]);
        continue;
      }
      const V3<Real> point = load3(level.point, i), normal = load3(level.normal, i);
      const V3<Real> offset = sub<Real>(position, point);
      const V<Real> square = dot<Real>(offset, offset), per_distance = inverse_root(square);
      const V<Real> distance = hn::Mul(square, per_distance);
      const V3<Real> l = scaled<Real>(offset, per_distance);
      const V<Real> cos_theta = dot<Real>(normal, l);
      const M<Real> counts = hn::And(
          is_hit, hn::And(hn::Gt(cos_theta, set(formulas::resolution<Real>())), first<Real>(level.size - i)));
      store3<Real>(l, shadow.direction, i);
      store<Real>(cos_theta, &shadow_.cos_theta[i]);
      const V<Real> up_to = through_glass ? distance : before_light(distance, load(&shadow.t_min[i]));
      store<Real>(hn::IfThenElse(counts, up_to, set(Real(-1))), &shadow.t[i]);
      statistics_.shadow_rays += hn::CountTrue(Tag<Real>(), counts);
    }
    if (view_.options.shadows && through_glass)
      look_through_glass(level);
    else if (view_.options.shadows && scene_.has_few_objects)
      finder_.template find<true>(shadow, 0, level.size, true, &light.position);
    else if (view_.options.shadows)
      find_by_object(level, light.position);
    for (std::size_t i = 0; i < level.size; i += lanes<Real>()) {
      const M<Real> is_lit = hn::Gt(load(&shadow.t[i]), set(Real(0)));
      if (none<Real>(is_lit)) continue;
      V3<Real> added = mul<Real>(set3(light.intensity), reflected(level, i));
      if (through_glass && view_.options.shadows) added = mul<Real>(added, load3(delta_, i));
      const V3<Real> colour = load3(level.colour, i);
      store3<Real>(where<Real>(is_lit, add<Real>(colour, added), colour), level.colour, i);
    }
  }

  /// Returns the t up to which something hides a light at that distance. It is above 0 even for a light at
  /// the start.
  static HWY_INLINE V<Real> before_light(V<Real> distance, V<Real> t_min) {
    const V<Real> one_place = hn::Add(t_min, hn::Mul(set(formulas::resolution<Real>()), distance));
    return hn::Max(hn::Sub(distance, one_place), set(std::numeric_limits<Real>::min()));
  }

  /// Sends the rays object by object. Those that leave one object stay close to each other on their way to
  /// the light, wherever in the tile they are. The numbers of objects follow their places in space.
  HWY_NOINLINE void find_by_object(const Level<Real>& level, const Vec3<Real>& light) {
    const std::size_t runs = runs_of_one_object(level);
    std::sort(runs_.begin(), runs_.begin() + static_cast<std::ptrdiff_t>(runs));
    std::size_t size = 0;
    for (std::size_t r = 0; r < runs; ++r) {
      const std::size_t begin = runs_[r] >> 16 & 0xffff, end = runs_[r] & 0xffff;
      for (std::size_t i = begin; i < end; i += lanes<Real>()) size += take(i, end - i, size);
    }
    finder_.template find<true>(sorted_, 0, size, true, &light);
    for (std::size_t to = 0; to < size; ++to) shadow_.rays.t[from_[to]] = sorted_.t[to];
  }
  /// Packs each run into one word: its object, its first ray, and the ray after its last. Returns their
  /// number.
  std::size_t runs_of_one_object(const Level<Real>& level) {
    std::size_t runs = 0;
    for (std::size_t i = 0; i < level.size;) {
      const std::size_t begin = i;
      const auto ref = static_cast<std::uint64_t>(level.rays.ref[i]);
      while (i < level.size && level.rays.ref[i] == ref) ++i;
      if (ref != 0) runs_[runs++] = ref << 32 | begin << 16 | i;
    }
    return runs;
  }
  /// Appends the rays of a vector that look for something to sorted_, and returns how many they are.
  HWY_INLINE std::size_t take(std::size_t i, std::size_t count, std::size_t to) {
    const Rays<Real>& rays = shadow_.rays;
    const V<Real> t = load(&rays.t[i]);
    const M<Real> asked = hn::And(first<Real>(count), hn::Gt(t, set(Real(0))));
    const WordTag<Real> w;
    const auto keep = [asked](const Real* lane, Real* kept)
                          HWY_ATTR { hn::CompressStore(load(lane), asked, Tag<Real>(), kept); };
    const auto keep_word = [asked, w](const Word<Real>* lane, Word<Real>* kept) HWY_ATTR {
      hn::CompressStore(hn::LoadU(w, lane), hn::RebindMask(w, asked), w, kept);
    };
    keep(&rays.origin.x[i], &sorted_.origin.x[to]);
    keep(&rays.origin.y[i], &sorted_.origin.y[to]);
    keep(&rays.origin.z[i], &sorted_.origin.z[to]);
    keep(&rays.direction.x[i], &sorted_.direction.x[to]);
    keep(&rays.direction.y[i], &sorted_.direction.y[to]);
    keep(&rays.direction.z[i], &sorted_.direction.z[to]);
    keep(&rays.t_min[i], &sorted_.t_min[to]);
    keep(&rays.t[i], &sorted_.t[to]);
    keep_word(&rays.start[i], &sorted_.start[to]);
    keep_word(&rays.start_face[i], &sorted_.start_face[to]);
    std::size_t kept = to;
    for (unsigned bits = bits_of<Real>(asked); bits != 0; bits &= bits - 1)
      from_[kept++] = static_cast<std::uint16_t>(i + static_cast<unsigned>(__builtin_ctz(bits)));
    if (!scene_.members.empty()) {
      for (std::size_t k = to; k < kept; ++k) sorted_.start_instance[k] = rays.start_instance[from_[k]];
    }
    return kept - to;
  }

  /// Returns kd (l.n) + ks (r.v)^m.
  HWY_INLINE V3<Real> reflected(const Level<Real>& level, std::size_t i) const {
    const MaterialLanes<Real> material(scene_.materials, &level.material[i], level.is_of_one[i]);
    const V<Real> zero = set(Real(0));
    const V<Real> cos_theta = load(&shadow_.cos_theta[i]);
    const V3<Real> diffuse = scaled<Real>(material.kd(), cos_theta);
    const V3<Real> ks = material.ks();
    const M<Real> is_shiny = hn::Or(hn::Or(hn::Ne(ks.x, zero), hn::Ne(ks.y, zero)), hn::Ne(ks.z, zero));
    if (none<Real>(is_shiny)) return diffuse;
    const V3<Real> l = load3(shadow_.rays.direction, i), n = load3(level.normal, i);
    const V3<Real> r = sub<Real>(scaled<Real>(n, hn::Mul(set(Real(2)), cos_theta)), l);
    const V<Real> cos_alpha = hn::Neg(dot<Real>(r, load3(level.rays.direction, i)));
    const M<Real> counts = hn::And(is_shiny, hn::Gt(cos_alpha, set(formulas::resolution<Real>())));
    if (none<Real>(counts)) return diffuse;
    const V<Real> factor = hn::IfThenElse(counts, power_of<Real>(cos_alpha, material.m()), zero);
    return add<Real>(diffuse, scaled<Real>(ks, factor));
  }

  /// Slide "Schatten" with glass that lets light through: what is opaque hides the light, glass multiplies
  /// it.
  void look_through_glass(const Level<Real>& level) {
    const auto walking_rays = std::make_unique<Rays<Real>>(shadow_.rays);
    Rays<Real>& walk = *walking_rays;
    Lanes<Real> left = walk.t;  // distance to the light
    Lanes<std::uint8_t> state{};
    enum : std::uint8_t { walking, lit, hidden };
    for (std::size_t i = 0; i < level.size; ++i) {
      state[i] = left[i] < 0 ? hidden : walking;
      delta_.x[i] = delta_.y[i] = delta_.z[i] = 1;
    }
    walk.start_instance = level.rays.instance;
    for (bool any = true; any;) {
      any = false;
      for (std::size_t i = 0; i < level.size; ++i) {
        walk.t[i] = state[i] == walking ? left[i] : Real(-1);
        walk.ref[i] = 0;
      }
      finder_.template find<false>(walk, 0, level.size, true, nullptr);
      for (std::size_t i = 0; i < level.size; ++i) {
        if (state[i] != walking) continue;
        const Ref ref(static_cast<std::uint32_t>(walk.ref[i]));
        if (ref.bits == 0 ||
            !(walk.t[i] < left[i] - (walk.t_min[i] + formulas::resolution<Real>() * left[i]))) {
          state[i] = lit;
          continue;
        }
        const Rgb<Real>& kt = scene_.materials[label_of(scene_, ref).material].kt;
        if (kt == Rgb<Real>(0)) {
          state[i] = hidden;
          continue;
        }
        if (view_.options.glass_shadow == GlassShadow::filtered) {
          delta_.x[i] *= kt.x;
          delta_.y[i] *= kt.y;
          delta_.z[i] *= kt.z;
        }
        left[i] -= walk.t[i];
        go_ahead(walk, i);
        any = true;
      }
    }
    for (std::size_t i = 0; i < level.size; ++i) shadow_.rays.t[i] = state[i] == lit ? Real(1) : Real(-1);
  }
  /// Makes a ray start anew from what it has hit.
  static void go_ahead(Rays<Real>& walk, std::size_t i) {
    walk.origin.x[i] += walk.t[i] * walk.direction.x[i];
    walk.origin.y[i] += walk.t[i] * walk.direction.y[i];
    walk.origin.z[i] += walk.t[i] * walk.direction.z[i];
    walk.t_min[i] = std::max(walk.t_min[i], smallest_t(vector_at(walk.origin, i)));
    walk.start[i] = walk.ref[i];
    walk.start_face[i] = walk.face[i];
    walk.start_instance[i] = walk.instance[i];
  }
  static Real smallest_t(const Vec3<Real>& origin) {
    const Vec3<Real> size = glm::abs(origin);
    return formulas::resolution<Real>() * std::max({size.x, size.y, size.z});
  }

  /// Slide "Spiegelung, Brechung": fills the next level, and traces it each time it is full and at the end.
  void send_on(std::size_t index) {
    Level<Real>& level = *levels_[index];
    level_at(index + 1).size = 0;
    const std::size_t media = interiors_.size();
    for (std::size_t i = 0; i < level.size; i += lanes<Real>()) {
      const std::size_t end = std::min(level.size, i + lanes<Real>());
      const bool is_end = level.is_of_one[i] && !sends_on(level.material[i]);
      for (std::size_t lane = i; lane < end && !is_end; ++lane) {
        if (level.rays.ref[lane] != 0 && sends_on(level.material[lane])) send_from(index, lane);
      }
    }
    run_children(index);
    interiors_.shrink(media);
  }

  bool sends_on(std::uint32_t material) const {
    const Material<Real>& m = scene_.materials[material];
    return m.kr != Rgb<Real>(0) || m.kt != Rgb<Real>(0);
  }

  void send_from(std::size_t index, std::size_t i) {
    const Level<Real>& level = *levels_[index];
    const Material<Real>& material = scene_.materials[level.material[i]];
    const bool mirrors = material.kr != Rgb<Real>(0), transmits = material.kt != Rgb<Real>(0);
    const Vec3<Real> d = vector_at(level.rays.direction, i), n = vector_at(level.normal, i);
    const int depth = level.depth[i] + 1;
    const bool is_last = depth >= view_.options.depth;
    typename Interiors<Real>::Crossed beyond{level.interior[i], Real(1)};
    std::optional<Vec3<Real>> bent;
    if (transmits) {
      beyond = interiors_.cross(level.interior[i], level.rays.instance[i], material.eta);
      bent = beyond.ratio == 1 ? d : formulas::refracted_direction(d, n, beyond.ratio);
    }
    const bool is_total = transmits && !bent;
    if (is_last) return;  // the next level is black
    if (is_total || mirrors) {
      ++statistics_.mirrored_rays;
      add_child(index, i, is_total ? Rgb<Real>(1) : material.kr, formulas::mirror_direction(d, n),
                level.interior[i], depth, 0);
    }
    if (!bent) return;
    const bool is_unbent = beyond.ratio == 1;
    if (is_unbent && level.unbent[i] >= most_unbent)
      throw std::runtime_error("a ray crosses more than 1000 surfaces of equal refractive index");
    ++statistics_.refracted_rays;
    add_child(index, i, material.kt, *bent, beyond.interior, is_unbent ? depth - 1 : depth,
              is_unbent ? level.unbent[i] + 1 : 0);
  }

  void add_child(std::size_t index, std::size_t i, const Rgb<Real>& weight, const Vec3<Real>& direction,
                 std::int32_t interior, int depth, int unbent) {
    const Level<Real>& level = *levels_[index];
    Level<Real>& next = *levels_[index + 1];
    const std::size_t to = next.size++;
    const Vec3<Real> point = vector_at(level.point, i);
    put(next.rays.origin, to, point);
    put(next.rays.direction, to, direction);
    put(next.weight, to, weight);
    next.rays.t_min[to] = std::max(level.rays.t_min[i], smallest_t(point));
    next.rays.start[to] = level.rays.ref[i];
    next.rays.start_face[to] = level.rays.face[i];
    next.rays.start_instance[to] = level.rays.instance[i];
    next.parent[to] = static_cast<std::uint32_t>(i);
    next.depth[to] = static_cast<std::uint16_t>(depth);
    next.unbent[to] = static_cast<std::uint16_t>(unbent);
    next.interior[to] = interior;
    if (next.size == stream_size) run_children(index);
  }
  static void put(Lanes3<Real>& to, std::size_t lane, const Vec3<Real>& v) {
    to.x[lane] = v.x;
    to.y[lane] = v.y;
    to.z[lane] = v.z;
  }

  void run_children(std::size_t index) {
    Level<Real>& level = *levels_[index];
    Level<Real>& next = *levels_[index + 1];
    if (next.size == 0) return;
    trace(index + 1);
    for (std::size_t i = 0; i < next.size; ++i) {
      const std::size_t to = next.parent[i];
      level.colour.x[to] += next.weight.x[i] * next.colour.x[i];
      level.colour.y[to] += next.weight.y[i] * next.colour.y[i];
      level.colour.z[to] += next.weight.z[i] * next.colour.z[i];
    }
    next.size = 0;
  }

  static constexpr std::uint16_t most_unbent = 1000;

  const CompiledScene<Real>& scene_;
  const View<Real>& view_;
  std::vector<std::unique_ptr<Level<Real>>> levels_;
  ShadowRays<Real> shadow_;
  Rays<Real> sorted_;
  Lanes<std::uint64_t> runs_;
  Lanes<std::uint16_t> from_;
  Lanes3<Real> sum_;               ///< sum of the samples of a tile
  Lanes<Real> pixel_x_, pixel_y_;  ///< places of a tile's rays, from its corner
  bool knows_whole_tile_ = false;  ///< true if they, and the parents of camera rays, are those of a full tile
  Lanes3<Real> delta_;             ///< for lights that are seen through glass
  Interiors<Real> interiors_;
  std::int32_t around_the_eye_ = Interiors<Real>::nothing;  // for every ray, unless the eye lies on glass
  std::size_t media_around_the_eye_ = 0;
  Statistics statistics_;
  Surfaces<Real> surfaces_;
  Finder<Real> finder_;
};

}  // namespace plumb::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
