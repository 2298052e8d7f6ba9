#include "references/diagnosis/geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <set>
#include <utility>

#include "tracer/scene/hierarchy.hpp"
#include "tracer/textbook/tracer.hpp"

namespace plumb::diagnosis {
namespace {

/// What is seen in a cell of the grid: 0 where nothing is hit.
using Label = std::uint32_t;
constexpr Label faces_of_a_shape = 8;  ///< labels of one shape follow each other

constexpr int cells_of_a_picture = 17'000;
/// because edges of a coarser grid hide whole objects
constexpr int fewest_cells = 4'000;
/// Intersections with a shape, of all cameras: some 4 s.
constexpr double most_intersections = 2e8;
/// because pixels that are nearer are of one smooth surface, and shadows' edges are farther apart
constexpr float edge_levels = 10;
/// because of 53 pictures of other scenes one agreed by 0.57 with a camera, the others by less than 0.55;
/// real tracers' pictures agreed by 0.67 and more with the camera that made them
constexpr double least_agreement = 0.6;
/// because cameras nearer than that have changed places with a few speckles; such a picture cannot tell them
/// apart
constexpr double least_lead = 0.03;
/// because the one camera that was named falsely led by 0.09, and those of real tracers by 0.18 and more
constexpr double least_lead_of_a_fault = 0.12;

/// A camera that somebody may have built, by the faults it has.
struct Candidate {
  std::vector<const faults::Fault*> faults;
  std::vector<Label> labels;
  double agreement = 0;
  std::vector<std::vector<const faults::Fault*>> same;  ///< other faults that give the same labels
};

/// Every stride-th pixel of a picture.
struct Grid {
  int width;
  int height;
  int stride;

  std::size_t cells() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  int pixel(int cell) const { return cell * stride + stride / 2; }
};

/// Keeps what the camera ray meets; no other ray is traced.
struct FirstHit {
  Label* label;

  bool ray_begins(textbook::RayKind kind, const Ray<double>&, int) const {
    return kind == textbook::RayKind::camera;
  }
  void is_black_at_depth_limit() const {}
  void meets(const textbook::Hit<double>& hit, const textbook::Surface<double>&, const Vec3d&,
             const Vec3d&) const {
    *label = 1 + faces_of_a_shape * static_cast<Label>(hit.surface.instance) +
             (static_cast<Label>(hit.surface.face) & (faces_of_a_shape - 1));
  }
  void is_lit_by(std::size_t, const textbook::LightSeen<double>&) const {}
  void ray_ends(const Rgbd&) const {}
};

std::vector<Label> labels_of(const faults::Subject& subject, const Grid& grid) {
  const textbook::World<double> world(subject.scene, subject.formulas);
  Label label = 0;
  const textbook::Tracer<double, textbook::ReplaceableFormulas<double>, FirstHit> tracer(
      world, subject.camera, subject.job.width, subject.job.height, subject.job.options, FirstHit{&label});
  std::vector<Label> labels(grid.cells());
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      label = 0;
      tracer.raycast(grid.pixel(x), grid.pixel(y));
      labels[grid.index(x, y)] = label;
    }
  }
  return labels;
}

/// The cells whose right or lower neighbour is another.
template <class Differ>
std::vector<bool> edges_where(const Grid& grid, const Differ& differ) {
  std::vector<bool> edges(grid.cells());
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      const std::size_t i = grid.index(x, y);
      edges[i] = (x + 1 < grid.width && differ(i, i + 1)) ||
                 (y + 1 < grid.height && differ(i, i + static_cast<std::size_t>(grid.width)));
    }
  }
  return edges;
}

/// The cells that are edges or have one beside them.
std::vector<bool> widened(const std::vector<bool>& edges, const Grid& grid) {
  std::vector<bool> wide(edges.size());
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      if (!edges[grid.index(x, y)]) continue;
      for (int v = std::max(0, y - 1); v <= std::min(grid.height - 1, y + 1); ++v) {
        for (int u = std::max(0, x - 1); u <= std::min(grid.width - 1, x + 1); ++u)
          wide[grid.index(u, v)] = true;
      }
    }
  }
  return wide;
}

double share_in(const std::vector<bool>& edges, const std::vector<bool>& wide) {
  std::size_t all = 0, in = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    all += edges[i] ? 1 : 0;
    in += edges[i] && wide[i] ? 1 : 0;
  }
  return all == 0 ? 0 : static_cast<double>(in) / static_cast<double>(all);
}

template <class Key>
double entropy(const std::map<Key, std::size_t>& counts, std::size_t all) {
  double sum = 0;
  for (const auto& [key, count] : counts) {
    const double share = static_cast<double>(count) / static_cast<double>(all);
    sum -= share * std::log(share);
  }
  return sum;
}

/// The picture, as far as its geometry goes.
class PictureSeen {
 public:
  PictureSeen(const ImageFile& seen, const Grid& grid) : grid_(grid) {
    std::map<std::array<int, 3>, std::size_t> numbers;
    for (int y = 0; y < grid.height; ++y) {
      for (int x = 0; x < grid.width; ++x) {
        const auto colour = colour_at(seen, grid.pixel(x), grid.pixel(y));
        std::array<int, 3> rough{};
        for (std::size_t c = 0; c < 3; ++c) rough[c] = static_cast<int>(std::sqrt(colour[c] / 255) * 7.99F);
        colours_.push_back(colour);
        rough_.push_back(numbers.try_emplace(rough, numbers.size()).first->second);
      }
    }
    edges_ = edges_where(grid, [&](std::size_t a, std::size_t b) { return distance(a, b) > edge_levels; });
    wide_ = widened(edges_, grid);
  }

  /// Half the F1 score of the edges, found within one cell, and half the normalised mutual information of
  /// labels and rough colours (Strehl and Ghosh, "Cluster Ensembles", 2002, with the mean of the entropies).
  double agreement(const std::vector<Label>& labels) const {
    const auto edges =
        edges_where(grid_, [&](std::size_t a, std::size_t b) { return labels[a] != labels[b]; });
    const double recall = share_in(edges, wide_);
    const double precision = share_in(edges_, widened(edges, grid_));
    const double f1 = recall + precision > 0 ? 2 * recall * precision / (recall + precision) : 0;
    return (f1 + information(labels)) / 2;
  }

  /// The share of these cells that are edges of the picture or lie beside one.
  double share_of_edges(const std::vector<std::size_t>& cells) const {
    const auto in = std::count_if(cells.begin(), cells.end(), [&](std::size_t i) { return wide_[i]; });
    return cells.empty() ? 0 : static_cast<double>(in) / static_cast<double>(cells.size());
  }

  /// The colour that nearly all cells have where nothing is hit, apart from those at edges.
  std::optional<BackgroundSeen> background(const std::vector<Label>& labels) const {
    constexpr double nearly_all = 0.9;   // because speckles and what lies at edges are few
    constexpr std::size_t fewest = 100;  // of cells
    const auto wide = widened(
        edges_where(grid_, [&](std::size_t a, std::size_t b) { return labels[a] != labels[b]; }), grid_);
    std::map<std::array<float, 3>, std::size_t> counts;
    std::size_t all = 0;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      if (labels[i] != 0 || wide[i]) continue;
      ++counts[colours_[i]];
      ++all;
    }
    const auto most = std::max_element(counts.begin(), counts.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    if (all < fewest || static_cast<double>(most->second) < nearly_all * static_cast<double>(all)) return {};
    const auto& c = most->first;
    const auto stride = static_cast<std::size_t>(grid_.stride);
    return BackgroundSeen{Rgbd(c[0], c[1], c[2]) / 255.0, most->second * stride * stride};
  }

 private:
  static std::array<float, 3> colour_at(const ImageFile& seen, int x, int y) {
    const auto channels = static_cast<std::size_t>(seen.channels);
    const std::size_t at =
        (static_cast<std::size_t>(y) * static_cast<std::size_t>(seen.width) + static_cast<std::size_t>(x)) *
        channels;
    std::array<float, 3> colour{};
    for (std::size_t c = 0; c < 3; ++c) {
      const float value = seen.values[at + (channels < 3 ? 0 : c)];
      colour[c] = value > 0 ? 255 * std::min(1.0F, value) : 0;  // what is no number is black
    }
    return colour;
  }

  float distance(std::size_t a, std::size_t b) const {
    float most = 0;
    for (std::size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(colours_[a][c] - colours_[b][c]));
    return most;
  }

  double information(const std::vector<Label>& labels) const {
    std::map<Label, std::size_t> of_labels;
    std::map<std::size_t, std::size_t> of_colours;
    std::map<std::pair<Label, std::size_t>, std::size_t> of_both;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      ++of_labels[labels[i]];
      ++of_colours[rough_[i]];
      ++of_both[{labels[i], rough_[i]}];
    }
    const double label = entropy(of_labels, labels.size()), colour = entropy(of_colours, labels.size());
    const double shared = label + colour - entropy(of_both, labels.size());
    return label + colour > 0 ? 2 * shared / (label + colour) : 0;
  }

  Grid grid_;
  std::vector<std::array<float, 3>> colours_;  // in levels
  std::vector<std::size_t> rough_;             // numbers of rough colours
  std::vector<bool> edges_;
  std::vector<bool> wide_;
};

/// Nothing, or one of these faults.
std::vector<const faults::Fault*> one_of(std::initializer_list<const char*> ids) {
  std::vector<const faults::Fault*> choice{nullptr};
  for (const char* id : ids) {
    const faults::Fault* const fault = faults::find_fault(id);
    choice.push_back(fault != nullptr ? fault : faults::find_geometry_family(id));
  }
  return choice;
}

std::vector<const faults::Fault*> without_nothing(std::initializer_list<const faults::Fault*> faults) {
  std::vector<const faults::Fault*> some;
  for (const faults::Fault* fault : faults) {
    if (fault != nullptr) some.push_back(fault);
  }
  return some;
}

/// The cell that a fault of the finished picture takes from another place.
std::vector<Label> turned(const std::vector<Label>& labels, const Grid& grid, bool left_right,
                          bool upside_down) {
  std::vector<Label> all(labels.size());
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      all[grid.index(x, y)] =
          labels[grid.index(left_right ? grid.width - 1 - x : x, upside_down ? grid.height - 1 - y : y)];
    }
  }
  return all;
}

std::vector<const faults::Fault*> before_the_picture_is_turned(std::vector<const faults::Fault*> faults) {
  std::erase_if(faults, [](const faults::Fault* fault) { return fault->after != nullptr; });
  return faults;
}

bool has_transforms(const Scene& scene) {
  return std::any_of(scene.shapes.begin(), scene.shapes.end(),
                     [](const Shape& shape) { return !shape.transform.empty(); });
}

/// All cameras, those with the fewest faults first, each picture of labels once.
class Candidates {
 public:
  Candidates(faults::Subject subject, const PictureSeen& seen, const Grid& grid)
      : subject_(std::move(subject)), seen_(seen), grid_(grid) {
    subject_.scene.lights.clear();
    const auto fields =
        one_of({"full-angle-as-half", "degrees-into-tan", "field-of-view-fixed", "focal-length-of-its-own",
                "image-plane-of-its-own", "half-angle-in-the-numerator", "whole-angle-in-the-numerator",
                "degrees-into-tan-of-the-width"});
    const auto shapes = one_of({"aspect-ignored", "field-of-view-vertical", "aspect-in-whole-numbers"});
    const auto poses =
        one_of({"camera-without-effect", "camera-direction-ignored", "camera-up-ignored",
                "camera-transform-ignored", "camera-matrix-transposed", "camera-looks-backwards",
                "camera-direction-added", "eye-hard-coded", "camera-axes-not-normalised"});
    for (const faults::Fault* field : fields) {
      for (const faults::Fault* shape : shapes) {
        for (const faults::Fault* pose : poses) add(without_nothing({field, shape, pose}));
      }
    }
  }

  /// Adds, to the few cameras that agree best and to the right one, the faults that put shapes elsewhere.
  void add_transforms() {
    if (!has_transforms(subject_.scene)) return;
    constexpr std::size_t few = 8;  // because the camera shows in most of the scene, whatever its shapes do
    std::vector<std::pair<double, std::vector<const faults::Fault*>>> best;
    for (const auto& [labels, candidate] : by_labels_)
      best.emplace_back(candidate.agreement, candidate.faults);
    std::stable_sort(best.begin(), best.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    best.resize(std::min(best.size(), few));
    if (std::none_of(best.begin(), best.end(), [](const auto& b) { return b.second.empty(); }))
      best.emplace_back();
    const auto transforms =
        one_of({"transforms-missing", "composite-transform-ignored", "inverse-in-wrong-order",
                "translation-added", "translation-in-wrong-column", "rotation-about-unit-axes-only",
                "rotation-by-half", "rotation-degrees-as-radians", "ray-by-matrix", "rotation-sense",
                "rotation-sense-about-x", "rotation-sense-about-y", "rotation-sense-about-z"});
    for (const auto& [agreement, faults] : best) {
      for (const faults::Fault* transform : transforms) {
        if (transform == nullptr) continue;
        std::vector<const faults::Fault*> both = before_the_picture_is_turned(faults);
        both.push_back(transform);
        add(both);
      }
    }
  }

  std::vector<Candidate> take() {
    std::vector<Candidate> all;
    for (auto& [labels, candidate] : by_labels_) {
      candidate.labels = labels;
      all.push_back(std::move(candidate));
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const Candidate& a, const Candidate& b) { return a.agreement > b.agreement; });
    return all;
  }

 private:
  void add(const std::vector<const faults::Fault*>& faults) {
    faults::Subject subject = subject_;
    for (const faults::Fault* fault : faults) fault->apply(subject);
    std::vector<Label> labels;
    try {
      labels = labels_of(subject, grid_);
    } catch (const std::exception&) {
      return;  // a camera that no ray leaves makes no picture
    }
    const faults::Fault* const flip = faults::find_fault("upside-down");
    const faults::Fault* const swap = faults::find_fault("left-right-swapped");
    for (const auto& after : {without_nothing({}), without_nothing({flip}), without_nothing({swap}),
                              without_nothing({flip, swap})}) {
      std::vector<const faults::Fault*> all = faults;
      all.insert(all.end(), after.begin(), after.end());
      const bool is_flipped = std::find(after.begin(), after.end(), flip) != after.end();
      const bool is_swapped = std::find(after.begin(), after.end(), swap) != after.end();
      keep(std::move(all), turned(labels, grid_, is_swapped, is_flipped));
    }
  }

  void keep(std::vector<const faults::Fault*> faults, std::vector<Label> labels) {
    const auto [at, is_new] = by_labels_.try_emplace(std::move(labels));
    Candidate& candidate = at->second;
    if (is_new) {
      candidate.agreement = seen_.agreement(at->first);
      candidate.faults = std::move(faults);
      return;
    }
    if (faults.size() < candidate.faults.size()) std::swap(faults, candidate.faults);
    candidate.same.push_back(std::move(faults));
  }

  faults::Subject subject_;
  const PictureSeen& seen_;
  Grid grid_;
  std::map<std::vector<Label>, Candidate> by_labels_;
};

bool has(const std::vector<const faults::Fault*>& faults, const faults::Fault* fault) {
  return std::find(faults.begin(), faults.end(), fault) != faults.end();
}

/// The faults in which another set of as many differs from this one, when that is one.
const faults::Fault* in_place_of(const faults::Fault* fault, const std::vector<const faults::Fault*>& faults,
                                 const std::vector<const faults::Fault*>& others) {
  if (others.size() != faults.size() || has(others, fault)) return nullptr;
  const faults::Fault* other = nullptr;
  for (const faults::Fault* one : others) {
    if (has(faults, one)) continue;
    if (other != nullptr) return nullptr;
    other = one;
  }
  return other;
}

bool has_number(const std::vector<const faults::Fault*>& faults, int number) {
  return std::any_of(faults.begin(), faults.end(),
                     [&](const faults::Fault* f) { return f->catalogue == number; });
}

/// Moves to the front, of those that agree about as well as the first, one with the fewest faults.
void prefer_the_simplest(std::vector<Candidate>& all) {
  const auto end = std::find_if(all.begin(), all.end(), [&](const Candidate& c) {
    return c.agreement <= all.front().agreement - least_lead;
  });
  const auto simplest = std::min_element(all.begin(), end, [](const Candidate& a, const Candidate& b) {
    return a.faults.size() < b.faults.size();
  });
  std::rotate(all.begin(), simplest, simplest + 1);
}

/// Holds each fault of the camera that agrees best against the cameras without one of its number.
CameraFound found_among(const std::vector<Candidate>& all) {
  const Candidate& best = all.front();
  CameraFound found;
  found.is_right = std::none_of(all.begin(), all.end(), [&](const Candidate& c) {
    return c.agreement > best.agreement - least_lead &&
           std::any_of(c.faults.begin(), c.faults.end(),
                       [](const faults::Fault* fault) { return is_of_geometry(*fault); });
  });
  found.assumed = best.faults;
  for (const faults::Fault* fault : best.faults) {
    std::vector<const faults::Fault*> alike;
    for (const auto& others : best.same) {
      const faults::Fault* const in_place = in_place_of(fault, best.faults, others);
      if (in_place != nullptr && !has(alike, in_place)) alike.push_back(in_place);
    }
    found.alike.push_back(alike);
    const auto other = std::find_if(
        all.begin(), all.end(), [&](const Candidate& c) { return !has_number(c.faults, fault->catalogue); });
    if (other == all.end() || best.agreement - other->agreement >= least_lead_of_a_fault)
      found.faults.push_back(fault);
  }
  return found;
}

bool is_of_transforms(const faults::Fault* fault) {
  return !is_of_geometry(*fault) && fault->after == nullptr;
}

Label shape_of(Label label) { return label == 0 ? 0 : (label - 1) / faces_of_a_shape + 1; }

/// Tells, shape by shape, which fault of the transforms puts it where the picture has it.
class ShapesElsewhere {
 public:
  /// The first of the candidates is the camera that the picture agrees with.
  ShapesElsewhere(const std::vector<Candidate>& all, const PictureSeen& seen, const Grid& grid)
      : all_(all), seen_(seen), grid_(grid), base_(without_transforms(all)) {}

  std::vector<ShapeElsewhere> found() const {
    std::vector<ShapeElsewhere> found;
    const std::set<Label> shapes = [&] {
      std::set<Label> seen;
      for (const Label label : base_.labels) seen.insert(shape_of(label));
      seen.erase(0);
      return seen;
    }();
    for (const Label shape : shapes) {
      const auto one = of_shape(shape);
      if (one && std::none_of(found.begin(), found.end(),
                              [&](const ShapeElsewhere& other) { return other.fault == one->fault; }))
        found.push_back(*one);
    }
    return found;
  }

 private:
  static const Candidate& without_transforms(const std::vector<Candidate>& all) {
    std::vector<const faults::Fault*> camera = all.front().faults;
    std::erase_if(camera, is_of_transforms);
    const auto base =
        std::find_if(all.begin(), all.end(), [&](const Candidate& c) { return c.faults == camera; });
    return base == all.end() ? all.front() : *base;
  }

  /// Returns nothing unless one place of the shape is seen, and what puts it there has one number.
  std::optional<ShapeElsewhere> of_shape(Label shape) const {
    std::optional<ShapeElsewhere> found;
    for (const Candidate& candidate : all_) {
      const std::vector<const faults::Fault*> faults = transforms_of(candidate);
      if (faults.empty() || !shows(candidate.labels, shape)) continue;
      if (!found) found = ShapeElsewhere{faults.front(), {}, pixels_moved(candidate.labels, shape)};
      for (const faults::Fault* fault : faults) {
        if (fault->catalogue != found->fault->catalogue) return {};
        if (fault != found->fault && !has(found->alike, fault)) found->alike.push_back(fault);
      }
    }
    return found;
  }

  /// Returns the faults of transforms that make the candidate of the base, one at a time.
  std::vector<const faults::Fault*> transforms_of(const Candidate& candidate) const {
    std::vector<const faults::Fault*> transforms;
    std::vector<std::vector<const faults::Fault*>> sets = candidate.same;
    sets.push_back(candidate.faults);
    for (const auto& faults : sets) {
      if (faults.size() != base_.faults.size() + 1) continue;
      const auto other = std::find_if(faults.begin(), faults.end(), is_of_transforms);
      const bool has_the_rest = std::all_of(base_.faults.begin(), base_.faults.end(),
                                            [&](const faults::Fault* f) { return has(faults, f); });
      if (other != faults.end() && has_the_rest) transforms.push_back(*other);
    }
    return transforms;
  }

  /// True if the edges that the shape has there are the picture's, and those that it has in the base are not.
  bool shows(const std::vector<Label>& labels, Label shape) const {
    constexpr std::size_t fewest = 40;  // because a few edges lie on others by chance
    // because shadows, highlights and other shapes have edges, too
    constexpr double nearly_all = 0.9, hardly_any = 0.5;
    const std::vector<std::size_t> there = edges_apart(labels, base_.labels, shape);
    const std::vector<std::size_t> here = edges_apart(base_.labels, labels, shape);
    return there.size() >= fewest && here.size() >= fewest && seen_.share_of_edges(there) >= nearly_all &&
           seen_.share_of_edges(here) <= hardly_any;
  }

  /// Returns the edges of a shape that are none, nor beside one, of whatever shape in the other picture.
  std::vector<std::size_t> edges_apart(const std::vector<Label>& labels, const std::vector<Label>& other,
                                       Label shape) const {
    const auto of_shape = edges_where(grid_, [&](std::size_t a, std::size_t b) {
      return labels[a] != labels[b] && (shape_of(labels[a]) == shape || shape_of(labels[b]) == shape);
    });
    const auto wide = widened(
        edges_where(grid_, [&](std::size_t a, std::size_t b) { return other[a] != other[b]; }), grid_);
    std::vector<std::size_t> apart;
    for (std::size_t i = 0; i < of_shape.size(); ++i) {
      if (of_shape[i] && !wide[i]) apart.push_back(i);
    }
    return apart;
  }

  std::size_t pixels_moved(const std::vector<Label>& labels, Label shape) const {
    std::size_t cells = 0;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const bool is_of_shape = shape_of(labels[i]) == shape || shape_of(base_.labels[i]) == shape;
      cells += is_of_shape && labels[i] != base_.labels[i] ? 1 : 0;
    }
    return cells * static_cast<std::size_t>(grid_.stride) * static_cast<std::size_t>(grid_.stride);
  }

  const std::vector<Candidate>& all_;
  const PictureSeen& seen_;
  Grid grid_;
  const Candidate& base_;
};

SurfacesSeen surfaces_of(const std::vector<Label>& labels, const Grid& grid) {
  const auto edges =
      widened(edges_where(grid, [&](std::size_t a, std::size_t b) { return labels[a] != labels[b]; }), grid);
  SurfacesSeen surfaces{{}, static_cast<std::size_t>(grid.stride) * static_cast<std::size_t>(grid.stride)};
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      const std::size_t i = grid.index(x, y);
      if (labels[i] != 0 && !edges[i]) surfaces.places.push_back({{grid.pixel(x), grid.pixel(y)}, labels[i]});
    }
  }
  return surfaces;
}

std::size_t instances_of(const Scene& scene) {
  std::size_t all = 0;
  const auto counts = count_instances(scene);
  for (const ShapeId root : scene.roots()) all += counts[root];
  return all;
}

}  // namespace

bool is_of_geometry(const faults::Fault& fault) {
  constexpr int pixel_corner = 4;  // a shift by half a pixel, which no grid of cells tells
  constexpr int last_of_the_camera = 7, focal_lengths = 40;
  return (fault.catalogue <= last_of_the_camera && fault.catalogue != pixel_corner) ||
         fault.catalogue == focal_lengths || fault.id == "aspect-in-whole-numbers" ||
         fault.id == "upside-down" || fault.id == "left-right-swapped";
}

std::optional<Geometry> geometry_of(const Scene& scene, const Camera& camera, const textbook::RenderJob& job,
                                    const ImageFile& seen) {
  constexpr double cameras = 300;
  const double affordable =
      most_intersections / (cameras * static_cast<double>(std::max<std::size_t>(1, instances_of(scene))));
  const double cells = std::min<double>(cells_of_a_picture, affordable);
  const double pixels = static_cast<double>(job.width) * job.height;
  const int stride = std::max(1, static_cast<int>(std::lround(std::sqrt(pixels / cells))));
  const Grid grid{job.width / stride, job.height / stride, stride};
  if (cells < fewest_cells || grid.cells() < fewest_cells) return {};
  const PictureSeen picture(seen, grid);
  Candidates candidates({scene, camera, job, {}}, picture, grid);
  candidates.add_transforms();
  std::vector<Candidate> all = candidates.take();
  if (all.empty()) return {};
  prefer_the_simplest(all);
  const auto right =
      std::find_if(all.begin(), all.end(), [](const Candidate& c) { return c.faults.empty(); });
  if (all.front().agreement < least_agreement) {
    // Colours may still prove the right camera.
    if (right == all.end()) return {};
    return Geometry{{}, picture.background(right->labels), surfaces_of(right->labels, grid)};
  }
  const std::vector<Label>& labels = all.front().labels;
  Geometry geometry{found_among(all), picture.background(labels), surfaces_of(labels, grid),
                    ShapesElsewhere(all, picture, grid).found()};
  if (right != all.end()) {
    for (std::size_t i = 0; i < right->labels.size(); ++i)
      geometry.camera.pixels += right->labels[i] != all.front().labels[i] ? 1 : 0;
  }
  geometry.camera.pixels *= static_cast<std::size_t>(stride) * static_cast<std::size_t>(stride);
  return geometry;
}

}  // namespace plumb::diagnosis
