#include "references/diagnosis/by_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "references/diagnosis/diagnostician.hpp"
#include "references/diagnosis/remains.hpp"
#include "references/diagnosis/shading.hpp"

namespace plumb::diagnosis {
namespace {

bool names(const Diagnosis& diagnosis, const faults::Fault* fault) {
  return std::any_of(diagnosis.faults.begin(), diagnosis.faults.end(), [&](const FoundFault& found) {
    return found.fault == fault ||
           std::find(found.alike.begin(), found.alike.end(), fault) != found.alike.end();
  });
}

/// True if a fault rights so little beside what is left that both may have one cause, another one.
bool is_doubtful(const FoundFault& found, const Diagnosis& d) {
  return !is_of_geometry(*found.fault) && found.pixels < 2 * d.unexplained_pixels;
}

bool has_secondary_rays(const Scene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const Material& m) { return m.mirrors() || m.transmits(); });
}

}  // namespace

ByGeometry::ByGeometry(const Evidence& evidence, const ImageFile& seen, std::optional<double> tolerance,
                       Geometry geometry)
    : evidence_(evidence), seen_(seen), tolerance_(tolerance), geometry_(std::move(geometry)) {
  habit_ = background_of_its_own();
  if (habit_) with_habit_ = with_background(habit_->value);
}

std::optional<Diagnosis> ByGeometry::with_background_of_its_own() const {
  if (!habit_) return {};
  for (const bool is_rounded : {false, true}) {
    if (is_rounded && !only_what_shows_the_background_is_left()) break;
    const Evidence evidence(with_habit_.front(), evidence_.camera(), evidence_.job(), seen_,
                            is_rounded ? of_a_level() : tolerance_);
    std::optional<Diagnosis> found = Diagnostician(evidence, seen_).without_search();
    if (!found || found->verdict != PictureVerdict::right) continue;
    found->verdict = PictureVerdict::right_apart;
    found->habits = {*habit_};
    return found;
  }
  Diagnosis told;
  told.pixels = evidence_.pixels_of_picture();
  told.non_finite = evidence_.non_finite();
  name_what_is_told(told);
  if (told.certain.camera == Certainty::unknown) return {};
  return told;
}

/// The background is known to a level of the file, which may be one more where it is mirrored.
std::optional<double> ByGeometry::of_a_level() const {
  constexpr double level = 1.0 / 255;
  return tolerance_.value_or(0) + level;
}

/// True if every pixel that is not right mirrors or refracts the background, whose colour the file rounded.
bool ByGeometry::only_what_shows_the_background_is_left() const {
  if (evidence_.encodings().front().is_float) return false;
  const Evidence evidence(with_habit_.front(), evidence_.camera(), evidence_.job(), seen_, tolerance_);
  std::vector<PixelPlace> left;
  for (const std::size_t pixel : remains_of(evidence, {}).pixels) left.push_back(evidence.place_of(pixel));
  Scene other = with_habit_.front();
  other.background += Rgbd(1);
  textbook::Work work(std::numeric_limits<double>::infinity());
  const std::vector<float> with_other =
      faults::colours_with(other, evidence_.camera(), evidence_.job(), {}, left, work);
  const std::vector<float> colours = evidence.colours({}, left);
  for (std::size_t i = 0; i < colours.size(); i += 3) {
    if (std::equal(&colours[i], &colours[i] + 3, &with_other[i])) return false;
  }
  return true;
}

Diagnosis ByGeometry::completed(Diagnosis by_colours) const {
  add_what_is_certain(by_colours);
  const bool is_sure = std::none_of(by_colours.faults.begin(), by_colours.faults.end(),
                                    [&](const FoundFault& f) { return is_doubtful(f, by_colours); });
  if (!agrees(by_colours) || !is_sure || by_colours.faults.empty()) name_what_is_told(by_colours);
  return by_colours;
}

/// True if it names the camera's faults that the geometry shows and no others of the camera.
bool ByGeometry::agrees(const Diagnosis& d) const {
  const CameraFound& camera = geometry_.camera;
  if (camera.is_right) {
    return std::none_of(d.faults.begin(), d.faults.end(),
                        [](const FoundFault& found) { return is_of_geometry(*found.fault); });
  }
  for (std::size_t i = 0; i < camera.assumed.size(); ++i) {
    const faults::Fault* const fault = camera.assumed[i];
    if (std::find(camera.faults.begin(), camera.faults.end(), fault) == camera.faults.end()) continue;
    const auto& alike = camera.alike[i];
    const bool is_named =
        names(d, fault) ||
        std::any_of(alike.begin(), alike.end(), [&](const faults::Fault* other) { return names(d, other); });
    if (!is_named) return false;
  }
  return true;
}

void ByGeometry::add_what_is_certain(Diagnosis& d) const {
  d.certain.camera = geometry_.camera.is_right         ? Certainty::right
                     : geometry_.camera.faults.empty() ? Certainty::unknown
                                                       : Certainty::wrong;
  if (habit_ && d.certain.camera != Certainty::unknown) d.habits = {*habit_};
}

/// Returns the remark when no encoding makes the scene's background of what is seen where nothing is hit.
std::optional<Habit> ByGeometry::background_of_its_own() const {
  if (!geometry_.background) return {};
  const Rgbd seen = geometry_.background->colour;
  const auto is_near = [&](const Rgbd& colour, const OutputEncoding& encoding) {
    constexpr double two_levels = 2;  // because a tracer rounds as it likes
    for (int c = 0; c < 3; ++c) {
      const float level = encoding.level(static_cast<float>(colour[c]), static_cast<std::size_t>(c));
      if (!(std::abs(std::clamp(level, 0.0F, 255.0F) - 255 * seen[c]) <= two_levels)) return false;
    }
    return true;
  };
  const auto is_near_in_any = [&](const Rgbd& colour) {
    return std::any_of(evidence_.encodings().begin(), evidence_.encodings().end(),
                       [&](const OutputEncoding& encoding) { return is_near(colour, encoding); });
  };
  if (is_near_in_any(evidence_.scene().background)) return {};
  const Rgbd ambient = evidence_.scene().ambient;
  const char* const what = seen == Rgbd(0)                          ? "is black"
                           : is_near(ambient, {})                   ? "shows the ambient light"
                           : is_near(ambient / (1.0 + ambient), {}) ? "shows the ambient light, tone-mapped"
                                                                    : "shows a colour of its own";
  return Habit{"background", std::string("Where nothing is hit, it ") + what + ".", seen};
}

/// The scenes whose right picture has this colour where nothing is hit: tone-mapped or not, what fits better
/// first.
std::vector<Scene> ByGeometry::with_background(const Rgbd& seen) const {
  Scene linear = evidence_.scene(), mapped = evidence_.scene();
  linear.background = seen;
  constexpr double nearly_one = 0.999;  // because no finite colour is tone-mapped to 1
  mapped.background = glm::min(seen, Rgbd(nearly_one)) / (1.0 - glm::min(seen, Rgbd(nearly_one)));
  if (misfit_of(mapped) < misfit_of(linear)) std::swap(linear, mapped);
  return {linear, mapped};
}

double ByGeometry::misfit_of(const Scene& scene) const {
  constexpr std::size_t pixels = 500;  // because the two backgrounds differ at most of them
  Evidence evidence(scene, evidence_.camera(), evidence_.job(), seen_, tolerance_);
  std::vector<PixelPlace> places;
  const std::size_t stride = std::max<std::size_t>(1, evidence.survey().size() / pixels);
  for (std::size_t i = 0; i < evidence.survey().size(); i += stride) places.push_back(evidence.survey()[i]);
  evidence.look_at(places);
  return evidence.fit(set_of(geometry_.camera.assumed), places.size()).misfit;
}

/// Names what the geometry shows and the faults of the shading, and counts what remains beside them and the
/// habit. Faults of the camera that are not certain by themselves are proven by the colours that they give.
void ByGeometry::name_what_is_told(Diagnosis& d) const {
  constexpr double enough_right = 0.75;  // because of wrong cameras' surfaces next to none are right
  const CameraFound& camera = geometry_.camera;
  std::vector<Scene> scenes{with_habit_.empty() ? evidence_.scene() : with_habit_.front()};
  // Of two backgrounds that look the same where nothing is hit, what mirrors shows one.
  if (!with_habit_.empty() && has_secondary_rays(scenes.front())) scenes = with_habit_;
  Shading shading;
  std::unique_ptr<Evidence> best;
  for (const Scene& scene : scenes) {
    auto evidence = std::make_unique<Evidence>(scene, evidence_.camera(), evidence_.job(), seen_, tolerance_);
    Shading found = shading_of(*evidence, set_of(camera.assumed), geometry_.surfaces);
    if (best && found.right <= shading.right) continue;
    shading = std::move(found);
    best = std::move(evidence);
  }
  const Evidence& evidence = *best;
  const bool is_proven = shading.right >= enough_right;
  d.faults.clear();
  for (std::size_t i = 0; i < camera.assumed.size(); ++i) {
    const faults::Fault* const fault = camera.assumed[i];
    const bool is_sure = std::find(camera.faults.begin(), camera.faults.end(), fault) != camera.faults.end();
    if (is_sure || is_proven) add_of_the_camera(d, fault, camera.alike[i]);
  }
  for (const ShapeElsewhere& shape : geometry_.elsewhere) add_of_a_shape(d, shape);
  d.faults.insert(d.faults.end(), shading.faults.begin(), shading.faults.end());
  d.is_flipped = names(d, faults::find_fault("upside-down"));
  d.verdict = d.faults.empty() ? PictureVerdict::unexplained : PictureVerdict::faults;
  FaultSet set = is_proven ? shading.set : set_of(camera.faults);
  for (const ShapeElsewhere& shape : geometry_.elsewhere) {
    const FaultSet with_it = set_of({shape.fault});
    if (!std::binary_search(set.begin(), set.end(), with_it.front())) set = with(set, with_it.front());
  }
  const Remains remains = remains_of(evidence, set);
  tell_what_remains(evidence, set, remains, d);
  constexpr double nearly_all = 0.98;  // because of those at edges of shadows some are off
  const bool is_all_right = is_proven && share_within(evidence, set, remains.encoding) >= nearly_all;
  d.certain = {camera.is_right || is_proven ? Certainty::right : Certainty::unknown,
               is_all_right ? Certainty::right : Certainty::unknown,
               is_all_right ? Certainty::right : Certainty::unknown};
  tell_what_is_wrong(d);
  d.habits.clear();
  if (habit_ && d.certain.camera != Certainty::unknown) d.habits = {*habit_};
  if (d.certain.camera == Certainty::right && set.empty()) d.shapes = shapes_at(evidence, remains.pixels);
}

/// Returns the share of the surfaces' places that is right to the last level, or to float32's error.
double ByGeometry::share_within(const Evidence& evidence, const FaultSet& set,
                                const OutputEncoding& encoding) const {
  std::vector<PixelPlace> places;
  for (const SurfaceSeen& one : geometry_.surfaces.places) places.push_back(one.place);
  const std::vector<bool> right = within(evidence, set, encoding, places);
  return static_cast<double>(std::count(right.begin(), right.end(), true)) /
         static_cast<double>(std::max<std::size_t>(1, right.size()));
}

/// Adds a fault that the place of one shape tells, unless the shading has it already.
void ByGeometry::add_of_a_shape(Diagnosis& d, const ShapeElsewhere& shape) {
  constexpr double confidence = 0.9;  // below that of the camera, because fewer edges tell it
  if (names(d, shape.fault)) return;
  d.faults.push_back({shape.fault, confidence / static_cast<double>(1 + shape.alike.size()),
                      std::max<std::size_t>(1, shape.pixels), shape.alike});
}

/// Adds a fault that the places of things tell.
void ByGeometry::add_of_the_camera(Diagnosis& d, const faults::Fault* fault,
                                   const std::vector<const faults::Fault*>& alike) const {
  // Below 1, because where things are tells less than the colour of every pixel.
  constexpr double confidence = 0.95;
  d.faults.push_back({fault, confidence / static_cast<double>(1 + alike.size()),
                      std::max<std::size_t>(1, geometry_.camera.pixels), alike});
}

}  // namespace plumb::diagnosis
