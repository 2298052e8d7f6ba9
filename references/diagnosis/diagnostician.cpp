#include "references/diagnosis/diagnostician.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

#include "references/attribution/ray_tree.hpp"
#include "references/diagnosis/geometry.hpp"
#include "references/diagnosis/search.hpp"

namespace plumb::diagnosis {
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

/// Returns the faults that give the same picture in the place of one of a set.
std::vector<const faults::Fault*> alike(const Evidence& evidence, const Fit& fit, std::size_t fault) {
  const FaultSet rest = without(fit.set, fault);
  std::vector<FaultSet> exchanged;
  for (std::size_t other = 0; other < faults::fault_catalogue().size(); ++other) {
    if (std::binary_search(fit.set.begin(), fit.set.end(), other)) continue;
    exchanged.push_back(with(rest, other));
  }
  std::vector<const faults::Fault*> found;
  for (const FaultSet& set : evidence.alike(fit, exchanged)) {
    const auto other = std::find_if(set.begin(), set.end(), [&](std::size_t f) {
      return !std::binary_search(rest.begin(), rest.end(), f);
    });
    found.push_back(&faults::fault_catalogue()[*other]);
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

/// Returns the number of survey pixels whose levels are others without the fault.
std::size_t changed_by(const Evidence& evidence, const Fit& fit, std::size_t fault) {
  const std::vector<float> with_it = evidence.colours(fit.set, evidence.survey());
  const std::vector<float> rest = evidence.colours(without(fit.set, fault), evidence.survey());
  std::size_t changed = 0;
  for (std::size_t i = 0; i < with_it.size(); i += 3) {
    bool is_other = false;
    for (std::size_t c = 0; c < 3; ++c)
      is_other = is_other || fit.encoding.level(with_it[i + c], c) != fit.encoding.level(rest[i + c], c);
    changed += is_other ? 1 : 0;
  }
  return changed;
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

}  // namespace

std::vector<ShapeSeen> shapes_at(const Evidence& evidence, const std::vector<std::size_t>& pixels) {
  RenderOptions first_hit = evidence.job().options;
  first_hit.depth = 1;
  const attribution::TreeTracer tracer(
      {evidence.scene(), evidence.camera(), evidence.width(), evidence.height(), first_hit});
  std::map<std::string, std::size_t> counts;
  constexpr std::size_t most = 20'000;  // because a tree of each of a large picture's pixels takes seconds
  const std::size_t stride = 1 + pixels.size() / most;
  for (std::size_t i = 0; i < pixels.size(); i += stride) {
    const PixelPlace place = evidence.place_of(pixels[i]);
    const attribution::RayNode ray = tracer.tree_of(place.x, place.y);
    ++counts[ray.meeting ? evidence.scene().shapes[ray.meeting->shape].name : std::string()];
  }
  std::vector<ShapeSeen> shapes;
  for (const auto& [name, count] : counts) shapes.push_back({name, count * stride});
  std::stable_sort(shapes.begin(), shapes.end(),
                   [](const ShapeSeen& a, const ShapeSeen& b) { return a.pixels > b.pixels; });
  return shapes;
}

void tell_what_remains(const Evidence& evidence, const FaultSet& set, const Remains& remains,
                       Diagnosis& diagnosis) {
  diagnosis.encoding = remains.encoding;
  diagnosis.edges = remains.edges;
  diagnosis.unexplained_pixels = remains.pixels.size();
  const std::vector<float> differences = evidence.differences({set, remains.encoding, 0, 0});
  double squares = 0;
  for (const float d : differences) squares += double{d} * d;
  diagnosis.rms = std::sqrt(squares / static_cast<double>(differences.size())) / 255;
  diagnosis.pixels_over = 0;
  for (const std::size_t pixel : remains.pixels) diagnosis.pixels_over += differences[pixel] <= close ? 0 : 1;
}

void tell_what_is_wrong(Diagnosis& diagnosis) {
  for (const FoundFault& found : diagnosis.faults) {
    constexpr int first_of_shadows = 19, last_of_shadows = 22;
    constexpr int first_of_transforms = 23, last_of_transforms = 33;
    const faults::Fault& fault = *found.fault;
    const bool is_of_shadows = (fault.catalogue >= first_of_shadows && fault.catalogue <= last_of_shadows) ||
                               fault.id == "shadows-missing";
    const bool is_of_shapes =
        (fault.catalogue >= first_of_transforms && fault.catalogue <= last_of_transforms) ||
        fault.id == "transforms-missing";
    if (is_of_geometry(fault) || fault.catalogue == 4 || fault.catalogue == 8)
      diagnosis.certain.camera = Certainty::wrong;
    else if (is_of_shadows)
      diagnosis.certain.shadows = Certainty::wrong;
    else if (!is_of_shapes)
      diagnosis.certain.shading = Certainty::wrong;
  }
}

Diagnostician::Diagnostician(const Evidence& evidence, const ImageFile& seen)
    : evidence_(evidence), seen_(seen) {
  diagnosis_.pixels = evidence.pixels_of_picture();
  diagnosis_.non_finite = evidence.non_finite();
}

std::optional<Diagnosis> Diagnostician::without_search() {
  right_ = remains_of(evidence_, {});
  if (right_.pixels.empty() || 2 * diagnosis_.non_finite > diagnosis_.pixels) {
    diagnosis_.verdict = PictureVerdict::right;
    tell_what_remains(evidence_, {}, right_, diagnosis_);
    if (!right_.pixels.empty()) diagnosis_.verdict = PictureVerdict::unexplained;
    return diagnosis_;
  }
  diagnosis_.is_of_one_colour = is_of_one_colour(seen_);
  if (!diagnosis_.is_of_one_colour) return {};
  tell_without_faults();
  return diagnosis_;
}

Diagnosis Diagnostician::with_search(Evidence& evidence) {
  Fit fit = explain(evidence);
  if (fit.set.empty() || !are_faults(right_, fit)) tell_without_faults();
  return diagnosis_;
}

void Diagnostician::tell_without_faults() {
  const bool is_apart = is_small_part(right_.pixels.size());
  diagnosis_.verdict = is_apart ? PictureVerdict::right_apart : PictureVerdict::unexplained;
  tell_what_remains(evidence_, {}, right_, diagnosis_);
  if (is_apart) diagnosis_.shapes = shapes_at(evidence_, right_.pixels);
}

bool Diagnostician::is_small_part(std::size_t pixels) const {
  return static_cast<double>(pixels) <= most_apart * static_cast<double>(diagnosis_.pixels);
}

/// True if the fit's faults explain enough. Then it also fills in the diagnosis.
bool Diagnostician::are_faults(const Remains& right, Fit& fit) {
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
  diagnosis_.verdict = PictureVerdict::faults;
  tell_what_remains(evidence_, fit.set, left, diagnosis_);
  fit.encoding = left.encoding;
  for (std::size_t i = 0; i < fit.set.size(); ++i) add_fault(fit, i, righted[i]);
  std::stable_sort(diagnosis_.faults.begin(), diagnosis_.faults.end(),
                   [](const FoundFault& a, const FoundFault& b) { return a.pixels > b.pixels; });
  return true;
}

/// Returns, of the telling pixels that are not right, the share that the faults make right. Pixels of the
/// picture's most frequent colour tell nothing, because whatever empties the scene gives it.
double Diagnostician::told_share(const Remains& right, const Remains& left) const {
  if (left.pixels.empty()) return 1;
  const std::array<float, 3> most_frequent = most_frequent_colour();
  const auto tells = [&](std::size_t pixel) { return colour_seen(pixel) != most_frequent; };
  const auto left_untold = std::count_if(left.pixels.begin(), left.pixels.end(), std::not_fn(tells));
  const auto telling = std::count_if(right.pixels.begin(), right.pixels.end(), tells) + left_untold;
  return 1 - static_cast<double>(left.pixels.size()) / static_cast<double>(telling);
}

std::array<float, 3> Diagnostician::colour_seen(std::size_t pixel) const {
  const float* const at = evidence_.seen(pixel);
  return {at[0], at[1], at[2]};
}

/// Counts evenly spread pixels in large pictures.
std::array<float, 3> Diagnostician::most_frequent_colour() const {
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
std::size_t Diagnostician::least_righted(const Remains& right, const Remains& left) const {
  constexpr double of_picture = 0.0005;  // because float and double disagree in up to 18 of 153,600 pixels
  // because beside pixels with another cause a small share of them may be right by chance
  constexpr double of_wrong = 0.05;
  const double share = left.pixels.empty()
                           ? of_picture
                           : std::max(of_picture, of_wrong * static_cast<double>(right.pixels.size()) /
                                                      static_cast<double>(diagnosis_.pixels));
  return static_cast<std::size_t>(share * static_cast<double>(evidence_.survey().size()));
}

void Diagnostician::add_fault(const Fit& fit, std::size_t number, std::size_t righted) {
  const std::size_t index = fit.set[number];
  FoundFault found{&faults::fault_catalogue()[index], 0, 0, alike(evidence_, fit, index)};
  found.pixels = std::max<std::size_t>(1, righted * diagnosis_.pixels / evidence_.survey().size());
  found.changed = changed_by(evidence_, fit, index) * diagnosis_.pixels / evidence_.survey().size();
  found.confidence = explained_ / static_cast<double>(1 + found.alike.size());
  diagnosis_.faults.push_back(found);
  diagnosis_.is_flipped |= found.fault->id == "upside-down";
}

}  // namespace plumb::diagnosis
