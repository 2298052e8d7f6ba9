#include "references/diagnosis/evidence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>

#include "references/attribution/ray_tree.hpp"
#include "references/renderers/ours.hpp"
#include "tracer/textbook/sampled_pixels.hpp"

namespace plumb::diagnosis {
namespace {

constexpr float levels_of_a_byte = 255;
constexpr double most_units_of_survey = 8e6;  // a fifth of a second
constexpr double most_units_in_all = 3.4e8;   // 8 s at most, a quarter of it as a rule

/// Returns the largest difference of the three channels, in levels. `unrounded` is rounded first. What is no
/// number is off by all levels, even where it is none on both sides.
float difference(const float* unrounded, const float* seen, const OutputEncoding& encoding) {
  float largest = 0;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const float level = encoding.rounded(unrounded[channel], channel);
    const float apart = std::abs(level - seen[channel]);
    if (!std::isfinite(apart)) return levels_of_a_byte;
    largest = std::max(largest, apart);
  }
  return largest;
}

std::vector<float> unrounded(const float* colours, std::size_t count, const OutputEncoding& encoding) {
  std::vector<float> all(count);
  std::transform(colours, colours + count, all.begin(), [&](float c) { return encoding.unrounded(c); });
  return all;
}

/// ln(1 + d), from a table where d is a number of levels.
double log_of(float difference) {
  static const std::vector<double> known = [] {
    std::vector<double> logs;
    for (int d = 0; d < 256; ++d) logs.push_back(std::log1p(d));
    return logs;
  }();
  const auto whole = static_cast<std::size_t>(std::min(difference, levels_of_a_byte));
  return static_cast<float>(whole) == difference ? known[whole] : std::log1p(difference);
}

/// Returns Chatterjee's coefficient of y as a function of x, with ties of y. Values of x that are no number
/// count as equal. Zero where y is constant.
double xi(const std::vector<float>& x, const std::vector<float>& y) {
  const std::size_t n = x.size();
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t i) { return std::isfinite(x[i]) ? x[i] : -1.0F; };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  std::vector<float> sorted = y;
  std::sort(sorted.begin(), sorted.end());
  const auto not_above = [&](std::size_t i) {
    return static_cast<double>(std::upper_bound(sorted.begin(), sorted.end(), y[i]) - sorted.begin());
  };
  double steps = 0;
  double spread = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (i > 0) steps += std::abs(not_above(order[i]) - not_above(order[i - 1]));
    const auto not_below =
        static_cast<double>(sorted.end() - std::lower_bound(sorted.begin(), sorted.end(), y[i]));
    spread += not_below * (static_cast<double>(n) - not_below);
  }
  return spread == 0 ? 0 : 1 - static_cast<double>(n) * steps / (2 * spread);
}

}  // namespace

std::size_t number_of_faults() {
  return faults::fault_catalogue().size() + faults::geometry_families().size() +
         faults::shading_families().size();
}

const faults::Fault& fault_at(std::size_t index) {
  for (const auto* list : {&faults::fault_catalogue(), &faults::geometry_families()}) {
    if (index < list->size()) return (*list)[index];
    index -= list->size();
  }
  return faults::shading_families().at(index);
}

std::vector<const faults::Fault*> faults_of(const FaultSet& set) {
  std::vector<const faults::Fault*> faults;
  for (const std::size_t fault : set) faults.push_back(&fault_at(fault));
  return faults;
}

FaultSet set_of(const std::vector<const faults::Fault*>& faults) {
  FaultSet set;
  for (std::size_t i = 0; i < number_of_faults(); ++i) {
    if (std::find(faults.begin(), faults.end(), &fault_at(i)) != faults.end()) set.push_back(i);
  }
  return set;
}

FaultSet with(FaultSet set, std::size_t fault) {
  set.insert(std::lower_bound(set.begin(), set.end(), fault), fault);
  return set;
}

FaultSet without(FaultSet set, std::size_t fault) {
  set.erase(std::find(set.begin(), set.end(), fault));
  return set;
}

Evidence::Evidence(const Scene& scene, const Camera& camera, const textbook::RenderJob& job,
                   const ImageFile& seen, std::optional<double> tolerance)
    : scene_(scene), camera_(camera), job_(job), work_(most_units_in_all) {
  SeenLevels known = seen_levels(seen);
  encodings_ = encodings_of(known.read);
  seen_ = std::move(known.values);
  const std::vector<PixelPlace> probe = textbook::spread_pixels(job_.width, job_.height, 200);
  textbook::Work work(0);
  faults::colours_with(scene_, camera_, job_, {}, probe, work);
  units_of_pixel_ = work.spent() / static_cast<double>(probe.size());
  survey_ = textbook::spread_pixels(
      job_.width, job_.height,
      static_cast<std::size_t>(std::clamp(most_units_of_survey / units_of_pixel_, 2000.0,
                                          static_cast<double>(pixels_of_picture()))));
  right_ = renderers::render(renderers::OwnTracer::engine, scene_, camera_, job_);
  if (known.read.is_float && tolerance)
    errors_.allowed.assign(pixels_of_picture(), static_cast<float>(*tolerance));
  else
    errors_ = float_errors(scene_, camera_, job_, right_);
  if (errors_.measured.empty()) errors_.measured = errors_.allowed;
  allowed_levels_ = known.read.is_float ? 0 : levels_of_a_byte * tolerance.value_or(0);
}

bool Evidence::is_finite(std::size_t pixel) const {
  const float* const at = seen(pixel);
  return std::isfinite(at[0]) && std::isfinite(at[1]) && std::isfinite(at[2]);
}

std::size_t Evidence::non_finite() const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < pixels_of_picture(); ++i) count += is_finite(i) ? 0 : 1;
  return count;
}

PixelPlace Evidence::place_of(std::size_t pixel) const {
  const auto width = static_cast<std::size_t>(job_.width);
  return {static_cast<int>(pixel % width), static_cast<int>(pixel / width)};
}

const Image& Evidence::picture_with(const FaultSet& set) const {
  if (set.empty()) return right_;
  if (set == set_of_other_) return other_;
  try {
    other_ = faults::render_with(scene_, camera_, job_, faults_of(set));
  } catch (const std::runtime_error&) {
    other_ = Image(job_.width, job_.height);
    std::fill(other_.rgb.begin(), other_.rgb.end(), std::numeric_limits<float>::infinity());
  }
  set_of_other_ = set;
  return other_;
}

const FloatMoves& Evidence::moves() const {
  if (!moves_) moves_ = std::make_unique<FloatMoves>(scene_, camera_);
  return *moves_;
}

std::vector<float> Evidence::textbook_in_float(const std::vector<PixelPlace>& places) const {
  using Formulas = textbook::ReplaceableFormulas<float>;
  const textbook::World<float, Formulas> world(scene_, Formulas({}));
  const textbook::Tracer<float, Formulas> tracer(world, camera_, job_.width, job_.height, job_.options);
  std::vector<float> colours;
  for (const auto& [x, y] : places) {
    const Rgb<float> colour = tracer.raycast(x, y);
    colours.insert(colours.end(), {colour.x, colour.y, colour.z});
  }
  return colours;
}

Image Evidence::moved_in_float(int number) const {
  textbook::RenderJob in_float = job_;
  in_float.real = RealType::float32;
  return renderers::render(renderers::OwnTracer::engine, moves().moved(number), camera_, in_float);
}

std::vector<float> Evidence::moved_colours(int number, const FaultSet& set,
                                           const std::vector<PixelPlace>& places,
                                           textbook::Work& work) const {
  work.spend(textbook::units_of_world<double>(scene_));
  try {
    return faults::colours_with(moves().moved(number), camera_, job_, faults_of(set), places, work);
  } catch (const std::runtime_error&) {
    return std::vector<float>(3 * places.size(), std::numeric_limits<float>::infinity());
  }
}

std::vector<std::optional<std::uint64_t>> Evidence::moved_courses(int number,
                                                                  const std::vector<PixelPlace>& places,
                                                                  textbook::Work& work) const {
  const Scene moved = moves().moved(number);
  const attribution::TreeTracer tracer({moved, camera_, job_.width, job_.height, job_.options}, work);
  std::vector<std::optional<std::uint64_t>> courses;
  for (const auto& [x, y] : places) {
    const attribution::RayNode tree = tracer.tree_of(x, y);
    courses.push_back(attribution::is_cut(tree) ? std::nullopt : std::optional(attribution::course_of(tree)));
  }
  return courses;
}

bool Evidence::is_over(double share) const { return work_.spent() > share * most_units_in_all; }

void Evidence::look_at(const std::vector<PixelPlace>& pixels) { places_ = pixels; }

std::size_t Evidence::index_of(const PixelPlace& place) const {
  return static_cast<std::size_t>(place.y) * static_cast<std::size_t>(job_.width) +
         static_cast<std::size_t>(place.x);
}

std::vector<PixelPlace> Evidence::first(std::size_t most) const {
  return {places_.begin(), places_.begin() + static_cast<std::ptrdiff_t>(std::min(most, places_.size()))};
}

std::vector<float> Evidence::colours(const FaultSet& set, const std::vector<PixelPlace>& places) const {
  try {
    return faults::colours_with(scene_, camera_, job_, faults_of(set), places, work_);
  } catch (const std::runtime_error&) {
    // A fault may make a scene that cannot be traced: it explains nothing.
    return std::vector<float>(3 * places.size(), std::numeric_limits<float>::infinity());
  }
}

double Evidence::misfit(const std::vector<float>& unrounded, const OutputEncoding& encoding) const {
  double sum = 0;
  const std::size_t count = unrounded.size() / 3;
  for (std::size_t i = 0; i < count; ++i)
    sum += log_of(difference(&unrounded[3 * i], seen(index_of(places_[i])), encoding));
  return count == 0 ? 0 : sum / static_cast<double>(count);
}

Fit Evidence::fit(const FaultSet& set, std::size_t most) const {
  const std::vector<float> traced = colours(set, first(most));
  Fit best{set, encodings_.front(), std::numeric_limits<double>::infinity(), 0};
  std::map<std::pair<bool, Curve>, std::vector<float>> known;
  for (const OutputEncoding& encoding : encodings_) {
    auto& levels_of = known[{encoding.tone_map, encoding.curve}];
    if (levels_of.empty()) levels_of = unrounded(traced.data(), traced.size(), encoding);
    const double misfit = this->misfit(levels_of, encoding);
    if (misfit < best.misfit) best = {set, encoding, misfit, 0};
  }
  best.association = association(traced);
  return best;
}

std::vector<FaultSet> Evidence::alike(const Fit& fit, const std::vector<FaultSet>& sets) const {
  const std::vector<float> known = colours(fit.set, places_);
  const auto agrees = [&](const FaultSet& set, std::size_t most) {
    const std::vector<float> other = colours(set, first(most));
    for (std::size_t i = 0; i < other.size(); ++i) {
      if (fit.encoding.level(other[i], i % 3) != fit.encoding.level(known[i], i % 3)) return false;
    }
    return true;
  };
  std::vector<FaultSet> found;
  for (const FaultSet& set : sets) {
    if (agrees(set, places_.size() / 20) && agrees(set, places_.size())) found.push_back(set);
  }
  return found;
}

double Evidence::association(const std::vector<float>& colours) const {
  std::vector<float> given(colours.size() / 3);
  std::vector<float> levels_seen(given.size());
  double sum = 0;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    for (std::size_t i = 0; i < given.size(); ++i) {
      given[i] = colours[3 * i + channel];
      const float level = seen(index_of(places_[i]))[channel];
      levels_seen[i] = std::isfinite(level) ? level : -levels_of_a_byte;  // what is no number has no order
    }
    sum += xi(given, levels_seen);
  }
  return sum / 3;
}

std::vector<float> Evidence::differences_at(const Fit& fit, const std::vector<PixelPlace>& places) const {
  const std::vector<float> traced = colours(fit.set, places);
  const std::vector<float> found = unrounded(traced.data(), traced.size(), fit.encoding);
  std::vector<float> all(places.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i] = difference(&found[3 * i], seen(index_of(places[i])), fit.encoding);
  return all;
}

std::vector<float> Evidence::differences(const Fit& fit) const {
  const Image& image = picture_with(fit.set);
  const std::vector<float> found = unrounded(image.rgb.data(), image.rgb.size(), fit.encoding);
  std::vector<float> all(seen_.size() / 3);
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = difference(&found[3 * i], seen(i), fit.encoding);
  return all;
}

}  // namespace plumb::diagnosis
