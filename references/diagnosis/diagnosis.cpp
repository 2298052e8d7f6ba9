#include "references/diagnosis/diagnosis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

#include "references/attribution/ray_tree.hpp"
#include "references/diagnosis/geometry.hpp"
#include "references/diagnosis/remains.hpp"
#include "references/diagnosis/search.hpp"

namespace plumb::references {
namespace {

/// A level counts as close up to this, because an error of another kind may add to it.
constexpr float close = 2;
/// The share of the pixels that are not right, that faults have to make right to the last level, so that they
/// are named: because in pictures of scenes in which one number was changed two faults gave 0.88 of them.
constexpr double enough_explained = 0.9;
/// The same of the telling pixels: because faults with which a scene is nearly empty give next to none of
/// them in a picture of it from farther away, and the faults of a real tracer gave half.
constexpr double enough_that_tells = 0.5;
/// The share of the picture that may stay without a cause, beside named faults or in a picture that is right
/// apart from it: because what is wrong with a larger part, e.g. a missing shape or half a picture, was taken
/// for faults of formulas that have nothing to do with it.
constexpr double most_apart = 0.05;

void set_remaining(const std::vector<float>& differences, const std::vector<std::size_t>& pixels,
                   Diagnosis& diagnosis) {
  double squares = 0;
  diagnosis.pixels_over = 0;
  for (const float d : differences) squares += double{d} * d;
  for (const std::size_t pixel : pixels) diagnosis.pixels_over += differences[pixel] <= close ? 0 : 1;
  diagnosis.rms = std::sqrt(squares / static_cast<double>(differences.size())) / 255;
}

/// Returns the faults that give the same picture in the place of one of a set.
std::vector<const Fault*> alike(const Evidence& evidence, const Fit& fit, std::size_t fault) {
  const FaultSet rest = without(fit.set, fault);
  std::vector<FaultSet> exchanged;
  for (std::size_t other = 0; other < fault_catalogue().size(); ++other) {
    if (std::binary_search(fit.set.begin(), fit.set.end(), other)) continue;
    exchanged.push_back(with(rest, other));
  }
  std::vector<const Fault*> found;
  for (const FaultSet& set : evidence.alike(fit, exchanged)) {
    const auto other = std::find_if(set.begin(), set.end(), [&](std::size_t f) {
      return !std::binary_search(rest.begin(), rest.end(), f);
    });
    found.push_back(&fault_catalogue()[*other]);
  }
  return found;
}

/// Returns, for each fault of the set, the number of survey pixels that are right with it and not without it.
std::vector<std::size_t> righted_by_each(const Evidence& evidence, const FaultSet& set,
                                         const OutputEncoding& encoding) {
  const std::vector<bool> together = within(evidence, set, encoding, evidence.survey());
  std::vector<std::size_t> all;
  for (const std::size_t fault : set) {
    const std::vector<bool> otherwise = within(evidence, without(set, fault), encoding, evidence.survey());
    std::size_t righted = 0;
    for (std::size_t i = 0; i < together.size(); ++i) righted += together[i] && !otherwise[i] ? 1 : 0;
    all.push_back(righted);
  }
  return all;
}

/// Takes out the fault that rights the fewest pixels until each rights more than `few`. Returns what they
/// right.
std::vector<std::size_t> without_idle(const Evidence& evidence, FaultSet& set, const OutputEncoding& encoding,
                                      std::size_t few) {
  for (;;) {
    std::vector<std::size_t> righted = righted_by_each(evidence, set, encoding);
    const auto least = std::min_element(righted.begin(), righted.end());
    if (least == righted.end() || *least > few) return righted;
    set.erase(set.begin() + (least - righted.begin()));
  }
}

/// True if the picture has one colour. It then tells too little to name a fault: many faults give it.
bool is_of_one_colour(const ImageFile& seen) {
  const auto channels = static_cast<std::size_t>(seen.channels);
  const std::size_t looked_at = channels < 3 ? 1 : 3;
  for (std::size_t i = channels; i < seen.values.size(); ++i) {
    if (i % channels < looked_at && seen.values[i] != seen.values[i - channels]) return false;
  }
  return true;
}

/// True if nothing is seen with these faults. Then the background of any picture seems explained.
bool shows_nothing(const Evidence& evidence, const FaultSet& set) {
  const std::vector<float> colours = evidence.colours(set, evidence.survey());
  for (std::size_t i = 3; i < colours.size(); ++i) {
    if (colours[i] != colours[i - 3]) return false;
  }
  return true;
}

/// Returns what the right picture shows at these pixels.
std::vector<ShapeSeen> shapes_at(const Evidence& evidence, const std::vector<std::size_t>& pixels) {
  RenderOptions first_hit = evidence.job().options;
  first_hit.depth = 1;
  const TreeTracer tracer(
      {evidence.scene(), evidence.camera(), evidence.width(), evidence.height(), first_hit});
  std::map<std::string, std::size_t> counts;
  for (const std::size_t pixel : pixels) {
    const PixelPlace place = evidence.place_of(pixel);
    const RayNode ray = tracer.tree_of(place.x, place.y);
    ++counts[ray.meeting ? evidence.scene().shapes[ray.meeting->shape].name : std::string()];
  }
  std::vector<ShapeSeen> shapes;
  for (const auto& [name, count] : counts) shapes.push_back({name, count});
  std::stable_sort(shapes.begin(), shapes.end(),
                   [](const ShapeSeen& a, const ShapeSeen& b) { return a.pixels > b.pixels; });
  return shapes;
}

class Diagnostician {
 public:
  Diagnostician(const Evidence& evidence, const ImageFile& seen) : evidence_(evidence), seen_(seen) {
    diagnosis_.pixels = evidence.pixels_of_picture();
    diagnosis_.non_finite = evidence.non_finite();
  }

  /// Returns the diagnosis when the picture is right, or tells nothing.
  std::optional<Diagnosis> without_search() {
    right_ = remains_of(evidence_, {});
    if (right_.pixels.empty() || 2 * diagnosis_.non_finite > diagnosis_.pixels) {
      tell(PictureVerdict::right, right_, {});
      if (!right_.pixels.empty()) diagnosis_.verdict = PictureVerdict::unexplained;
      return diagnosis_;
    }
    diagnosis_.is_of_one_colour = is_of_one_colour(seen_);
    if (!diagnosis_.is_of_one_colour) return {};
    tell_without_faults();
    return diagnosis_;
  }

  /// Comes after without_search().
  Diagnosis with_search(Evidence& evidence) {
    Fit fit = explain(evidence);
    if (fit.set.empty() || !are_faults(right_, fit)) tell_without_faults();
    return diagnosis_;
  }

 private:
  void tell_without_faults() {
    const bool is_apart = is_small_part(right_.pixels.size());
    tell(is_apart ? PictureVerdict::right_apart : PictureVerdict::unexplained, right_, {});
    if (is_apart) diagnosis_.shapes = shapes_at(evidence_, right_.pixels);
  }

  bool is_small_part(std::size_t pixels) const {
    return static_cast<double>(pixels) <= most_apart * static_cast<double>(diagnosis_.pixels);
  }

  void tell(PictureVerdict verdict, const Remains& remains, const FaultSet& set) {
    diagnosis_.verdict = verdict;
    diagnosis_.encoding = remains.encoding;
    diagnosis_.edges = remains.edges;
    diagnosis_.unexplained_pixels = remains.pixels.size();
    set_remaining(evidence_.differences({set, remains.encoding, 0, 0}), remains.pixels, diagnosis_);
  }

  /// True if the fit's faults explain enough. Then it also fills in the diagnosis.
  bool are_faults(const Remains& right, Fit& fit) {
    Remains left = remains_of(evidence_, fit.set);
    std::vector<std::size_t> righted =
        without_idle(evidence_, fit.set, left.encoding, least_righted(right, left));
    if (fit.set.empty()) return false;
    left = remains_of(evidence_, fit.set);
    if (!left.pixels.empty() && shows_nothing(evidence_, fit.set)) return false;
    const double wrong = static_cast<double>(right.pixels.size());
    explained_ = 1 - static_cast<double>(left.pixels.size()) / wrong;
    if (explained_ < enough_explained || told_share(right, left) < enough_that_tells) return false;
    if (!is_small_part(left.pixels.size())) return false;
    tell(PictureVerdict::faults, left, fit.set);
    fit.encoding = left.encoding;
    for (std::size_t i = 0; i < fit.set.size(); ++i) add_fault(fit, i, righted[i]);
    std::stable_sort(diagnosis_.faults.begin(), diagnosis_.faults.end(),
                     [](const FoundFault& a, const FoundFault& b) { return a.pixels > b.pixels; });
    return true;
  }

  /// Returns, of the telling pixels that are not right, the share that the faults make right. Pixels of the
  /// picture's most frequent colour tell nothing, because whatever empties the scene gives it.
  double told_share(const Remains& right, const Remains& left) const {
    if (left.pixels.empty()) return 1;
    const std::array<float, 3> most_frequent = most_frequent_colour();
    const auto tells = [&](std::size_t pixel) { return colour_seen(pixel) != most_frequent; };
    const auto left_untold = std::count_if(left.pixels.begin(), left.pixels.end(), std::not_fn(tells));
    const auto telling = std::count_if(right.pixels.begin(), right.pixels.end(), tells) + left_untold;
    return 1 - static_cast<double>(left.pixels.size()) / static_cast<double>(telling);
  }

  std::array<float, 3> colour_seen(std::size_t pixel) const {
    const float* const at = evidence_.seen(pixel);
    return {at[0], at[1], at[2]};
  }

  /// Counts evenly spread pixels in large pictures.
  std::array<float, 3> most_frequent_colour() const {
    constexpr std::size_t most_counted = 200'000;
    const std::size_t stride = 1 + evidence_.pixels_of_picture() / most_counted;
    std::map<std::array<float, 3>, std::size_t> counts;
    for (std::size_t i = 0; i < evidence_.pixels_of_picture(); i += stride) {
      if (evidence_.is_finite(i)) ++counts[colour_seen(i)];
    }
    const auto most = std::max_element(counts.begin(), counts.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    return most == counts.end() ? std::array<float, 3>{} : most->first;
  }

  /// Returns how many pixels of the survey a fault must right.
  std::size_t least_righted(const Remains& right, const Remains& left) const {
    constexpr double of_picture = 0.0005;  // because float and double disagree in up to 18 of 153,600 pixels
    // because beside pixels with another cause a small share of them may be right by chance
    constexpr double of_wrong = 0.05;
    const double share = left.pixels.empty()
                             ? of_picture
                             : std::max(of_picture, of_wrong * static_cast<double>(right.pixels.size()) /
                                                        static_cast<double>(diagnosis_.pixels));
    return static_cast<std::size_t>(share * static_cast<double>(evidence_.survey().size()));
  }

  void add_fault(const Fit& fit, std::size_t number, std::size_t righted) {
    const std::size_t index = fit.set[number];
    FoundFault found{&fault_catalogue()[index], 0, 0, alike(evidence_, fit, index)};
    found.pixels = std::max<std::size_t>(1, righted * diagnosis_.pixels / evidence_.survey().size());
    found.confidence = explained_ / static_cast<double>(1 + found.alike.size());
    diagnosis_.faults.push_back(found);
    diagnosis_.is_flipped |= found.fault->id == "upside-down";
  }

  const Evidence& evidence_;
  const ImageFile& seen_;
  Diagnosis diagnosis_;
  Remains right_;
  double explained_ = 0;  ///< share of the pixels that are not right that the faults make right
};

/// Faults that change where things are.
bool is_of_geometry(const Fault& fault) {
  constexpr int pixel_corner = 4;  // a shift by half a pixel, which no grid of cells tells
  constexpr int last_of_the_camera = 7;
  return (fault.catalogue <= last_of_the_camera && fault.catalogue != pixel_corner) ||
         fault.id == "upside-down" || fault.id == "left-right-swapped";
}

bool names(const Diagnosis& diagnosis, const Fault* fault) {
  return std::any_of(diagnosis.faults.begin(), diagnosis.faults.end(), [&](const FoundFault& found) {
    return found.fault == fault ||
           std::find(found.alike.begin(), found.alike.end(), fault) != found.alike.end();
  });
}

/// Holds what the colours told against what the places of things tell, and adds to it.
class ByGeometry {
 public:
  ByGeometry(const Evidence& evidence, const ImageFile& seen, std::optional<double> tolerance,
             Geometry geometry)
      : evidence_(evidence), seen_(seen), tolerance_(tolerance), geometry_(std::move(geometry)) {
    habit_ = background_of_its_own();
    if (habit_) with_habit_ = with_background(habit_->value);
  }

  /// Returns what accounts for nearly all of the picture, when that takes another background.
  std::optional<Diagnosis> with_background_of_its_own() const {
    if (!habit_) return {};
    std::optional<Diagnosis> found = explained(*with_habit_);
    if (!found) return {};
    if (found->verdict == PictureVerdict::right) found->verdict = PictureVerdict::right_apart;
    add_what_is_certain(*found);
    return found;
  }

  /// Adds what is certain to what the colours told, and takes out what contradicts it.
  Diagnosis completed(Diagnosis by_colours) const {
    add_what_is_certain(by_colours);
    const bool is_sure = std::none_of(by_colours.faults.begin(), by_colours.faults.end(),
                                      [&](const FoundFault& f) { return is_doubtful(f, by_colours); });
    const bool only_habit_is_known = habit_ && by_colours.faults.empty();
    if (!agrees(by_colours) || !is_sure || only_habit_is_known) name_the_camera(by_colours);
    return by_colours;
  }

 private:
  /// True if it names the camera's faults that the geometry shows and no others of the camera.
  bool agrees(const Diagnosis& d) const {
    const CameraFound& camera = geometry_.camera;
    if (camera.is_right) {
      return std::none_of(d.faults.begin(), d.faults.end(),
                          [](const FoundFault& found) { return is_of_geometry(*found.fault); });
    }
    for (std::size_t i = 0; i < camera.faults.size(); ++i) {
      const auto& alike = camera.alike[i];
      const bool is_named =
          names(d, camera.faults[i]) ||
          std::any_of(alike.begin(), alike.end(), [&](const Fault* other) { return names(d, other); });
      if (!is_named) return false;
    }
    return true;
  }

  void add_what_is_certain(Diagnosis& d) const {
    if (habit_) d.habits.push_back(*habit_);
    d.camera = geometry_.camera.is_right         ? Certainty::right
               : geometry_.camera.faults.empty() ? Certainty::unknown
                                                 : Certainty::wrong;
  }

  /// True if a fault rights so little beside what is left that both may have one cause, another one.
  static bool is_doubtful(const FoundFault& found, const Diagnosis& d) {
    return !is_of_geometry(*found.fault) && found.pixels < 2 * d.unexplained_pixels;
  }

  /// Returns the remark when no encoding makes the scene's background of what is seen where nothing is hit.
  std::optional<Habit> background_of_its_own() const {
    const bool is_camera_known = geometry_.camera.is_right || !geometry_.camera.faults.empty();
    if (!geometry_.background || !is_camera_known) return {};
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

  /// The scene whose right picture has this colour where nothing is hit: tone-mapped or not, as it fits
  /// better.
  Scene with_background(const Rgbd& seen) const {
    Scene linear = evidence_.scene(), mapped = evidence_.scene();
    linear.background = seen;
    constexpr double nearly_one = 0.999;  // because no finite colour is tone-mapped to 1
    mapped.background = glm::min(seen, Rgbd(nearly_one)) / (1.0 - glm::min(seen, Rgbd(nearly_one)));
    return misfit_of(mapped) < misfit_of(linear) ? mapped : linear;
  }

  double misfit_of(const Scene& scene) const {
    constexpr std::size_t pixels = 500;  // because the two backgrounds differ at most of them
    Evidence evidence(scene, evidence_.camera(), evidence_.job(), seen_, tolerance_);
    std::vector<PixelPlace> places;
    const std::size_t stride = std::max<std::size_t>(1, evidence.survey().size() / pixels);
    for (std::size_t i = 0; i < evidence.survey().size(); i += stride) places.push_back(evidence.survey()[i]);
    evidence.look_at(places);
    return evidence.fit(set_of(geometry_.camera.faults), places.size()).misfit;
  }

  static FaultSet set_of(const std::vector<const Fault*>& faults) {
    const auto& formulas = fault_catalogue();
    FaultSet set;
    for (const Fault* fault : faults) {
      const bool is_family = find_camera_family(fault->id) == fault;
      const auto& list = is_family ? camera_families() : formulas;
      set.push_back(static_cast<std::size_t>(fault - list.data()) + (is_family ? formulas.size() : 0));
    }
    std::sort(set.begin(), set.end());
    return set;
  }

  /// Searches again in the scene with another background. Returns what accounts for nearly all and does not
  /// contradict the geometry.
  std::optional<Diagnosis> explained(const Scene& scene) const {
    constexpr std::size_t most_faults = 3;  // because of four names and more every second one was false
    constexpr double most_left = 0.01;      // because with more left, faults soaked up what others caused
    Evidence evidence(scene, evidence_.camera(), evidence_.job(), seen_, tolerance_);
    Diagnostician diagnostician(evidence, seen_);
    const std::optional<Diagnosis> simple = diagnostician.without_search();
    Diagnosis found = simple ? *simple : diagnostician.with_search(evidence);
    const double left = static_cast<double>(found.unexplained_pixels) / static_cast<double>(found.pixels);
    const bool is_found = found.verdict != PictureVerdict::unexplained && left <= most_left &&
                          found.faults.size() <= most_faults && agrees(found);
    if (!is_found) return {};
    return found;
  }

  /// Names what the geometry shows and nothing else, and counts what remains beside it and the habit.
  void name_the_camera(Diagnosis& d) const {
    // Below 1, because where things are tells less than the colour of every pixel.
    constexpr double confidence = 0.95;
    const CameraFound& camera = geometry_.camera;
    d.faults.clear();
    d.is_flipped = false;
    for (std::size_t i = 0; i < camera.faults.size(); ++i) {
      const double shared = static_cast<double>(1 + camera.alike[i].size());
      d.faults.push_back(
          {camera.faults[i], confidence / shared, std::max<std::size_t>(1, camera.pixels), camera.alike[i]});
      d.is_flipped |= camera.faults[i]->id == "upside-down";
    }
    d.verdict = d.faults.empty() ? PictureVerdict::unexplained : PictureVerdict::faults;
    const FaultSet set = set_of(camera.faults);
    const Scene& scene = with_habit_ ? *with_habit_ : evidence_.scene();
    Evidence evidence(scene, evidence_.camera(), evidence_.job(), seen_, tolerance_);
    const Remains left = remains_of(evidence, set);
    d.edges = left.edges;
    d.unexplained_pixels = left.pixels.size();
    d.encoding = left.encoding;
    set_remaining(evidence.differences({set, left.encoding, 0, 0}), left.pixels, d);
  }

  const Evidence& evidence_;
  const ImageFile& seen_;
  std::optional<double> tolerance_;
  Geometry geometry_;
  std::optional<Habit> habit_;
  std::optional<Scene> with_habit_;  ///< the scene whose background is as the habit shows it
};

std::string count_text(std::size_t count, std::size_t of) {
  return std::to_string(count) + " of " + std::to_string(of) + " pixels";
}

std::string in_words(const ShapeSeen& shape) {
  return shape.name.empty() ? std::string("the background") : "'" + shape.name + "'";
}

/// E.g. "where nothing is hit, it is black".
std::string as_clause(const Habit& habit) {
  std::string text = habit.title.substr(0, habit.title.size() - 1);
  text.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(text.front())));
  return text;
}

std::string shapes_in_words(const std::vector<ShapeSeen>& shapes) {
  constexpr std::size_t most = 3;
  if (shapes.size() == 1) return "all on " + in_words(shapes.front());
  std::string text;
  for (std::size_t i = 0; i < std::min(most, shapes.size()); ++i)
    text += (i == 0 ? "" : ", ") + std::to_string(shapes[i].pixels) + " on " + in_words(shapes[i]);
  return shapes.size() > most ? text + ", others elsewhere" : text;
}

std::string not_right_in_words(const Diagnosis& d) {
  switch (d.verdict) {
    case PictureVerdict::right:
      return {};
    case PictureVerdict::right_apart:
      if (d.explains_all() && !d.habits.empty()) return "right, with habits";
      return "right apart from " + count_text(d.unexplained_pixels, d.pixels) + ", " +
             shapes_in_words(d.shapes);
    case PictureVerdict::faults:
      return d.explains_all()
                 ? std::string()
                 : "explains a part; " + count_text(d.unexplained_pixels, d.pixels) + " have another cause";
    case PictureVerdict::unexplained:
      break;
  }
  return count_text(d.unexplained_pixels, d.pixels) + " are not right" +
         (d.is_of_one_colour ? std::string("; ") + one_colour_tells_nothing : std::string());
}

}  // namespace

const char* to_string(PictureVerdict verdict) {
  switch (verdict) {
    case PictureVerdict::right:
      return "right";
    case PictureVerdict::right_apart:
      return "right_apart";
    case PictureVerdict::faults:
      return "faults";
    case PictureVerdict::unexplained:
      break;
  }
  return "unexplained";
}

Diagnosis diagnose(const Scene& scene, const Camera& camera, const textbook::RenderJob& job,
                   const ImageFile& seen, std::optional<double> tolerance) {
  Evidence evidence(scene, camera, job, seen, tolerance);
  Diagnostician diagnostician(evidence, seen);
  if (auto simple = diagnostician.without_search()) return *simple;
  Diagnosis by_colours = diagnostician.with_search(evidence);
  const bool is_told = by_colours.verdict == PictureVerdict::right_apart ||
                       (by_colours.verdict == PictureVerdict::faults && by_colours.explains_all());
  if (is_told) return by_colours;
  auto geometry = geometry_of(scene, camera, job, seen);
  if (!geometry) return by_colours;
  const ByGeometry by_geometry(evidence, seen, tolerance, std::move(*geometry));
  if (auto found = by_geometry.with_background_of_its_own()) return *found;
  return by_geometry.completed(std::move(by_colours));
}

std::string summary_of(const Diagnosis& diagnosis) {
  std::string text = not_right_in_words(diagnosis);
  if (diagnosis.camera == Certainty::right && diagnosis.verdict == PictureVerdict::unexplained)
    text += "; the camera is right";
  for (const Habit& habit : diagnosis.habits) text += "; " + as_clause(habit);
  if (diagnosis.non_finite == 0) return text;
  return text + (text.empty() ? "" : "; ") + std::to_string(diagnosis.non_finite) +
         (diagnosis.non_finite == 1 ? " pixel is not finite" : " pixels are not finite");
}

}  // namespace plumb::references
