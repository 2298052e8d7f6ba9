#include "references/attribution/attribution.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>

#include "references/attribution/divergence.hpp"
#include "references/attribution/perturbation.hpp"
#include "references/attribution/pixel_tracer.hpp"
#include "tracer/scene/hierarchy.hpp"

namespace plumb::references {
namespace {

constexpr double smallest_jump = 1e3;  // times the move: a smooth pixel changes by far less
constexpr int patterns = 48;           // two surfaces stay in one order in all of them once in 2^47 cases
constexpr int most_patterns = 4096;    // for pixels that vary: many ties in one ray tree have many outcomes
constexpr int patterns_of_one = 6;     // of a single shape, to find out whether it takes part
constexpr std::size_t pixels_named = 64;  // the shapes are looked for in so many pixels

// A picture that differs as a whole is no matter of chance: one pixel of the sample that has no cause settles
// the verdict.
constexpr std::size_t most_without_sample = 2000;
constexpr std::size_t pixels_of_sample = 256;

/// A pixel over the tolerance while it is tried.
struct Suspect {
  AttributedPixel* pixel;
  Colour unmoved;
  bool varies = false;  ///< moving surfaces makes it jump
  // The patterns whose outcomes are the two pictures' values, and what their ray trees differ in.
  std::optional<int> as_test{};
  std::optional<int> as_reference{};
  Colour of_test{};
  Colour of_reference{};
  std::optional<Cause> cause{};

  bool is_proven() const { return varies && cause; }
};

constexpr int no_pattern = -1;  // nothing is moved

/// Attributes the pixels of one picture, cause by cause.
class Attribution {
 public:
  explicit Attribution(const AttributionJob& job)
      : job_(job),
        scene_(with_instances_apart(job.shot.scene)),
        perturbation_(scene_, job.shot.camera, job.resolution),
        work_(job.work),
        still_(scene_, job, job.shot.options, work_) {}

  Budget run() {
    for (const PixelPlace p : pixels_over(job_.reference, job_.test, job_.tolerance)) {
      budget_.pixels.push_back({p.x, p.y, Cause::unexplained});
    }
    if (job_.holds != Holds::float32) explain_by_format();
    const Pixels all = still_unexplained();
    if (all.size() > most_without_sample && !is_explained(sample_of(all))) {
      budget_.unexamined = all.size() - sample_of(all).size();
    } else {
      explain(still_unexplained());
      if (work_.is_over()) budget_.unexamined = still_unexplained().size();
    }
    return std::move(budget_);
  }

 private:
  using Pixels = std::vector<AttributedPixel*>;

  Pixels still_unexplained() {
    Pixels pixels;
    for (AttributedPixel& p : budget_.pixels) {
      if (p.cause == Cause::unexplained && is_finite(p)) pixels.push_back(&p);
    }
    return pixels;
  }

  static Pixels sample_of(const Pixels& all) {
    Pixels sample;
    for (std::size_t i = 0; i < pixels_of_sample; ++i)
      sample.push_back(all[i * all.size() / pixels_of_sample]);
    return sample;
  }

  bool is_explained(const Pixels& pixels) {
    explain(pixels);
    return std::all_of(pixels.begin(), pixels.end(),
                       [](const AttributedPixel* p) { return p->cause != Cause::unexplained; });
  }

  void explain(const Pixels& pixels) {
    explain_by_moves(pixels);
    if (job_.resolution.is_of_plumb) return;
    for (const int more : {-1, 1}) explain_by_depth(job_.shot.options.depth + more, pixels);
  }

  const float* reference(const AttributedPixel& p) const { return job_.reference.pixel(p.x, p.y); }
  const float* test(const AttributedPixel& p) const { return job_.test.pixel(p.x, p.y); }

  bool is_finite(const AttributedPixel& p) const {
    return std::all_of(reference(p), reference(p) + 3, [](float v) { return std::isfinite(v); }) &&
           std::all_of(test(p), test(p) + 3, [](float v) { return std::isfinite(v); });
  }

  void explain_by_format() {
    textbook::Work one_picture(std::numeric_limits<double>::infinity());
    const PixelTracer tracer(scene_, job_, job_.shot.options, one_picture);
    for (AttributedPixel& p : budget_.pixels) {
      if (is_finite(p)) explain_by_format(p, tracer);
    }
  }

  /// Clamping and rounding to integers, to the last bit but for the rounding of the float itself. A clamped
  /// reference does not tell the test's value; that must be what is traced.
  void explain_by_format(AttributedPixel& p, const PixelTracer& tracer) const {
    const double levels = job_.holds == Holds::bits8 ? 255 : 65535;
    bool clamps = false;
    for (int c = 0; c < 3; ++c) {
      const double value = test(p)[c];
      const double held = std::clamp(value, 0.0, 1.0);
      clamps = clamps || held != value;
      // Half a level is rounded away; the test may be off by its own tolerance, which decides a tie.
      const double allowed = 0.5 / levels + job_.tolerance;
      if (std::abs(held - static_cast<double>(reference(p)[c])) > allowed) return;
    }
    if (clamps && !is_traced(p, tracer)) return;
    p.cause = clamps ? Cause::clamped : Cause::quantisation;
  }

  std::vector<Suspect> suspects(const Pixels& pixels) {
    std::vector<Suspect> all;
    for (AttributedPixel* const p : pixels) {
      if (work_.is_over()) break;
      const std::optional<Colour> unmoved = still_.at(*p);
      if (!unmoved) continue;
      Suspect& s = all.emplace_back(Suspect{p, *unmoved});
      try_outcome(no_pattern, s.unmoved, s);
    }
    return all;
  }

  bool is_traced(const AttributedPixel& p, const PixelTracer& tracer) const {
    const std::optional<Colour> traced = tracer.at(p);
    return traced && is_within(test(p), traced->data(), job_.tolerance);
  }

  void explain_by_moves(const Pixels& pixels) {
    std::vector<Suspect> all = suspects(pixels);
    for (int pattern = 0; pattern < most_patterns && !work_.is_over(); ++pattern) {
      if (pattern == patterns) std::erase_if(all, [](const Suspect& s) { return !s.varies; });
      if (std::all_of(all.begin(), all.end(), [](const Suspect& s) { return s.is_proven(); })) break;
      const std::shared_ptr<const PixelTracer> moved = moved_by(pattern);
      for (Suspect& s : all) {
        if (!s.is_proven() && !work_.is_over()) try_pattern(pattern, *moved, s);
      }
    }
    const std::set<ShapeId> found = shapes_that_take_part(all);
    for (const Suspect& s : all) {
      // Whatever it is when no shape takes part, it is no matter of where surfaces are.
      if (s.is_proven() && (!found.empty() || s.cause == Cause::reference_tolerance))
        s.pixel->cause = *s.cause;
    }
    for (const ShapeId id : found) add_name(scene_.shapes[id].name);
  }

  /// The worlds of the last patterns are kept, for the trees of outcomes that were found before.
  std::shared_ptr<const PixelTracer> moved_by(int pattern) const {
    constexpr std::size_t most_shapes = 100'000;  // some 50 MB
    for (const auto& [of, tracer] : moved_) {
      if (of == pattern) return tracer;
    }
    const std::size_t most = std::clamp<std::size_t>(most_shapes / (1 + scene_.shapes.size()), 2, patterns);
    if (moved_.size() >= most) moved_.pop_front();
    moved_.emplace_back(
        pattern, std::make_shared<const PixelTracer>(perturbation_.moved(pattern), job_, job_.shot.options,
                                                     work_, perturbation_.formulas(pattern)));
    return moved_.back().second;
  }

  void try_pattern(int pattern, const PixelTracer& moved, Suspect& s) const {
    const std::optional<Colour> outcome = moved.at(*s.pixel);
    if (!outcome) return;
    s.varies =
        s.varies || !is_within(s.unmoved.data(), outcome->data(), std::max(job_.tolerance, jump_of(pattern)));
    try_outcome(pattern, *outcome, s);
  }

  /// Whether the outcome is what one of the pictures shows; when both are found, their rays tell the cause.
  void try_outcome(int pattern, const Colour& outcome, Suspect& s) const {
    const auto shows = [&](const float* picture, std::optional<int>& as, Colour& of) {
      if (as || !is_within(picture, outcome.data(), job_.tolerance)) return;
      as = pattern;
      of = outcome;
      if (!s.as_test || !s.as_reference) return;
      // Two outcomes that are hardly apart, or have the same rays, are no matter of chance.
      if (!is_within(s.of_test.data(), s.of_reference.data(), jump_of(pattern))) s.cause = divergence(s);
      if (!s.cause) as.reset();
    };
    shows(test(*s.pixel), s.as_test, s.of_test);
    shows(reference(*s.pixel), s.as_reference, s.of_reference);
  }

  /// What a smooth pixel never changes by when surfaces move as in this pattern, and half the tolerance: the
  /// two values are more than the tolerance apart, and each outcome is nearly one of them.
  double jump_of(int pattern) const {
    const double factor = pattern == no_pattern ? 1e-3 : Perturbation::factor(pattern);
    return std::max(job_.tolerance / 2, factor * smallest_jump * job_.resolution.step);
  }

  std::optional<Cause> divergence(const Suspect& s) const {
    return first_divergence(tree(*s.as_test, s), tree(*s.as_reference, s), perturbation_.extent(),
                            job_.resolution);
  }

  RayNode tree(int pattern, const Suspect& s) const {
    if (pattern == no_pattern) return still_.tree_of(*s.pixel);
    return moved_by(pattern)->tree_of(*s.pixel);
  }

  using Meetings = std::map<ShapeId, std::vector<const Suspect*>>;

  /// Those whose move alone changes one of the proven pixels. Where none does, once more with the reference's
  /// shadows: of the two faces at an edge by which a ray leaves a box, one may differ only by whether the box
  /// itself hides a light there.
  std::set<ShapeId> shapes_that_take_part(const std::vector<Suspect>& all) const {
    const Meetings meetings = met_by(sample_of_proven(all));
    textbook::Work work(job_.work / 5);
    std::set<ShapeId> found = shapes_that_change(
        meetings, {}, [](const Suspect& s) { return std::optional(s.unmoved); }, work);
    if (!found.empty() || meetings.empty()) return found;
    const PerturbedFormulas shadows = perturbation_.reference_shadows();
    const PixelTracer still(scene_, job_, job_.shot.options, work, shadows);
    return shapes_that_change(
        meetings, shadows, [&](const Suspect& s) { return still.at(*s.pixel); }, work);
  }

  /// With many shapes, of the first that are tried.
  template <class Unmoved>
  std::set<ShapeId> shapes_that_change(const Meetings& meetings, const PerturbedFormulas& formulas,
                                       const Unmoved& unmoved_of, textbook::Work& work) const {
    std::set<ShapeId> found;
    for (const auto& [id, pixels] : meetings) {
      for (int i = 0; i < patterns_of_one && !found.contains(id) && !work.is_over(); ++i) {
        const PixelTracer moved(perturbation_.with_one_moved(id, i), job_, job_.shot.options, work, formulas);
        const bool changes = std::any_of(pixels.begin(), pixels.end(), [&](const Suspect* s) {
          const std::optional<Colour> unmoved = unmoved_of(*s);
          const std::optional<Colour> outcome = moved.at(*s->pixel);
          return unmoved && outcome && !is_within(unmoved->data(), outcome->data(), job_.tolerance);
        });
        if (changes) found.insert(id);
      }
    }
    return found;
  }

  /// The shapes that the rays of these pixels meet, moved or not, and what hides lights from them.
  Meetings met_by(const std::vector<const Suspect*>& proven) const {
    std::vector<ShapeId> of_instance;
    for_each_instance(scene_, [&](const Instance& instance) { of_instance.push_back(instance.shape); });
    Meetings meetings;
    for (const Suspect* s : proven) {
      std::set<ShapeId> met;
      add_met(still_.tree_of(*s->pixel), of_instance, met);
      add_met(tree(*s->as_test, *s), of_instance, met);
      add_met(tree(*s->as_reference, *s), of_instance, met);
      for (const ShapeId id : met) meetings[id].push_back(s);
    }
    return meetings;
  }

  static void add_met(const RayNode& node, const std::vector<ShapeId>& of_instance, std::set<ShapeId>& met) {
    if (!node.meeting) return;
    met.insert(node.meeting->shape);
    for (const auto& light : node.meeting->lights) {
      const auto blocker = static_cast<std::size_t>(light.blocker.surface.instance);
      if (light.counts && blocker < of_instance.size()) met.insert(of_instance[blocker]);
    }
    for (const RayNode& child : node.children) add_met(child, of_instance, met);
  }

  static std::vector<const Suspect*> sample_of_proven(const std::vector<Suspect>& all) {
    std::vector<const Suspect*> proven;
    for (const Suspect& s : all) {
      if (s.is_proven()) proven.push_back(&s);
    }
    std::vector<const Suspect*> sample;
    const std::size_t stride = std::max<std::size_t>(1, proven.size() / pixels_named);
    for (std::size_t i = 0; i < proven.size(); i += stride) sample.push_back(proven[i]);
    return sample;
  }

  void add_name(const std::string& name) {
    if (std::find(budget_.shapes.begin(), budget_.shapes.end(), name) == budget_.shapes.end())
      budget_.shapes.push_back(name);
  }

  void explain_by_depth(int depth, const Pixels& pixels) {
    if (depth < 1 || work_.is_over()) return;
    RenderOptions options = job_.shot.options;
    options.depth = depth;
    const PixelTracer tracer(scene_, job_, options, work_);
    for (AttributedPixel* const pixel : pixels) {
      AttributedPixel& p = *pixel;
      if (p.cause != Cause::unexplained || work_.is_over()) continue;
      const std::optional<Colour> ours = still_.at(p);
      const std::optional<Colour> other = tracer.at(p);
      const bool both = ours && other && is_within(test(p), ours->data(), job_.tolerance) &&
                        is_within(reference(p), other->data(), job_.tolerance) &&
                        !is_within(ours->data(), other->data(), job_.tolerance);
      if (both && first_divergence(still_.tree_of(p), tracer.tree_of(p), perturbation_.extent(),
                                   job_.resolution) == Cause::depth)
        p.cause = Cause::depth;
    }
  }

  const AttributionJob& job_;
  Scene scene_;
  Perturbation perturbation_;
  mutable textbook::Work work_;
  PixelTracer still_;  // nothing is moved
  mutable std::deque<std::pair<int, std::shared_ptr<const PixelTracer>>> moved_;
  Budget budget_;
};

}  // namespace

const char* to_string(Cause cause) {
  constexpr std::array<const char*, cause_count> names{
      "silhouette", "shadow_edge",  "secondary_edge", "coincident", "reference_tolerance",
      "depth",      "quantisation", "clamped",        "undecided",  "unexplained"};
  return names.at(static_cast<std::size_t>(cause));
}

std::size_t Budget::count(Cause cause) const {
  return static_cast<std::size_t>(std::count_if(pixels.begin(), pixels.end(),
                                                [&](const AttributedPixel& p) { return p.cause == cause; }));
}

std::string Budget::note() const {
  if (unexamined == 0) return {};
  return std::to_string(unexamined) + " of the unexplained pixels were not examined " +
         "to the end: there are too many, or each takes too many rays";
}

Budget attribute(const AttributionJob& job) { return Attribution(job).run(); }

std::string broken_bound(const Budget& budget, int width, int height) {
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  const std::size_t lines =
      std::min(2 * static_cast<std::size_t>(width) + 2 * static_cast<std::size_t>(height), 16 + pixels / 20);
  const std::size_t some = 16 + pixels / 100;
  const std::pair<Cause, std::size_t> bounds[] = {{Cause::silhouette, lines},
                                                  {Cause::shadow_edge, lines},
                                                  {Cause::secondary_edge, lines},
                                                  {Cause::depth, some}};
  for (const auto& [cause, most] : bounds) {
    const std::size_t found = budget.count(cause);
    if (found > most) {
      return std::to_string(found) + " pixels are put down to " + to_string(cause) + ", at most " +
             std::to_string(most) + " are allowed";
    }
  }
  if (100 * budget.unverified() <= pixels) return {};
  return std::to_string(budget.unverified()) +
         " pixels are unverified: the reference does not tell apart the surfaces that meet there, or the "
         "scene's last digits leave the colour open, so nothing says what colour ours has; at most " +
         std::to_string(pixels / 100) + " are allowed, 1 % of the picture";
}

}  // namespace plumb::references
