#include "references/report/needs_report.hpp"

#include <algorithm>

#include "references/report/formatted.hpp"

namespace plumb::report {
namespace {

/// Padded to so many characters: a byte of UTF-8 that continues one is none.
std::string padded(std::string text, std::size_t width) {
  const auto characters = static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
  return text + std::string(width > characters ? width - characters : 0, ' ');
}

/// Joined by commas, broken into lines.
std::string listed(const std::vector<std::string>& names, std::size_t most = 12) {
  constexpr std::size_t longest = 80;
  std::string text, line;
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i) {
    if (line.size() + names[i].size() > longest) {
      text += line.substr(0, line.size() - 1) + "\n    ";
      line.clear();
    }
    line += names[i] + (i + 1 < names.size() ? ", " : "");
  }
  if (names.size() > most) line += formatted("and %zu more", names.size() - most);
  return text + line;
}

std::string features_text(const studies::Needs& needs) {
  std::string text = "\nWhat of the lecture it has, and how often that happens in the picture\n";
  std::vector<std::string> absent;
  for (const studies::Feature& f : needs.features) {
    if (f.in_scene == 0) {
      absent.push_back(f.what);
      continue;
    }
    text += "  " + padded(f.slide, 25) + padded(f.what, 28) +
            padded(std::to_string(f.in_scene) + " " + f.things + (f.in_scene > 1 ? "s" : ""), 14) +
            (f.seen == 0 ? "not seen" : std::to_string(f.seen) + " " + f.times) + "\n";
  }
  return text + (absent.empty() ? "" : "  Not in the scene: " + listed(absent, absent.size()) + ".\n");
}

/// What the errors were measured on.
std::string evidence_text(const studies::Needs& n) {
  if (n.oracle_pixels == n.observed.pixels)
    return formatted("  Measured against 113 bits on all %zu pixels.\n", n.oracle_pixels);
  return formatted(
      "  Measured against 113 bits on %zu of %zu pixels: those where float and double differ most, and\n"
      "  spread ones; float also against double on all. Elsewhere double was not checked.\n",
      n.oracle_pixels, n.observed.pixels);
}

std::string real_text(const NeedsReport& r) {
  const studies::Needs& n = r.needs;
  std::string text = "\nReal type: " + studies::sufficient_real(n, r.bound) +
                     formatted(" for an error of at most %g\n  Largest error: float %.2g, double %.2g.\n",
                               r.bound, n.in_float.error.largest(), n.in_double.error.largest());
  text += evidence_text(n) + "  Enough for";
  for (const double bound : bounds_of(r))
    text += " " + (bound == 1.0 / 255 ? "1/255" : formatted("%g", bound)) + ": " +
            studies::sufficient_real(n, bound) + ";";
  text.back() = '.';
  return text + "\n";
}

std::string depth_text(const NeedsReport& r) {
  const studies::DepthNeed& d = r.needs.depth;
  std::string text = formatted("\nDepth: %d for an error of at most %g\n", d.within_bound_from, r.bound);
  text +=
      d.same_from < d.asked
          ? formatted("  From depth %d on it is the picture of depth %d, bit for bit.", d.same_from, d.asked)
          : formatted("  No smaller depth gives the picture of depth %d bit for bit.", d.asked);
  text += formatted(" The deepest ray seen has depth %d.\n", r.needs.observed.deepest);
  std::string steps;
  for (const studies::DepthStep& step : d.steps) {
    if (step.depth > d.same_from) break;
    steps += formatted("%s %d: %.2g", steps.empty() ? "" : ",", step.depth, step.error);
  }
  text += "  Error by depth:" + steps + ".\n";
  if (r.needs.observed.black_at_limit > 0) {
    text += formatted(
        "  %llu rays are black because the depth ends at %d; depth %d changes the picture by %.2g.\n",
        static_cast<unsigned long long>(r.needs.observed.black_at_limit), d.asked, d.asked + 1,
        d.change_beyond);
  }
  return text;
}

std::string untouched_text(const NeedsReport& r) {
  const studies::Untouched& u = r.needs.untouched;
  std::string text = "\nNot needed in this picture\n";
  if (!r.needs.is_same_without_untouched)
    return text +
           "  Not known: without the shapes that no ray was seen to touch, and the lights that were not\n"
           "  seen to light anything, the picture is another one. Look at more pixels: a smaller --size.\n";
  const auto add = [&](const char* what, const std::vector<std::string>& names) {
    if (!names.empty()) text += "  " + std::string(what) + ": " + listed(names) + "\n";
  };
  add("Touch no ray (not met, and no blocker)", names_of(u.shapes, r.scene.shapes));
  add("Materials of nothing that is met", names_of(u.materials, r.scene.materials));
  add("Lights that light nothing", names_of(u.lights, r.scene.lights));
  if (u.shapes.empty() && u.lights.empty() && u.materials.empty())
    return text + "  Nothing: all of it counts.\n";
  if (!u.shapes.empty() || !u.lights.empty())
    text += "  Without these shapes and lights the picture is the same, bit for bit.\n";
  return text +
         "  This holds for this camera, this size and one sample a pixel; another picture may need them.\n";
}

std::string costs_text(const studies::Costs& costs) {
  std::string text =
      formatted("\nWhat it costs: %.1f ms of CPU in double, on one thread; with against without\n",
                1e3 * costs.cpu_seconds);
  for (const studies::FeatureCost& c : costs.costs)
    text +=
        "  " + padded(c.feature, 26) + formatted("x %.2f  (%.2f to %.2f)\n", c.ratio, c.least, c.greatest);
  return text + formatted("  Medians and ranges of %d rounds in turns.\n", costs.rounds);
}

std::string looked_text(const studies::Observed& o) {
  if (o.is_whole()) return "";
  return formatted(
      "Only %zu of %zu pixels were looked at, spread evenly%s: what was not seen may still happen.\n",
      o.looked_at, o.pixels,
      o.cut > 0 ? formatted("; %zu of them have more rays than are followed", o.cut).c_str() : "");
}

}  // namespace

std::vector<double> bounds_of(const NeedsReport& r) {
  std::vector<double> bounds{1.0 / 255, 1e-3, 1e-6};
  if (std::find(bounds.begin(), bounds.end(), r.bound) == bounds.end()) bounds.push_back(r.bound);
  std::sort(bounds.rbegin(), bounds.rend());
  return bounds;
}

std::string as_text(const NeedsReport& r) {
  return formatted("%s: %d x %d, depth %d\n", r.path.c_str(), r.width, r.height, r.needs.depth.asked) +
         looked_text(r.needs.observed) + features_text(r.needs) + real_text(r) + depth_text(r) +
         untouched_text(r) + costs_text(r.needs.costs);
}

}  // namespace plumb::report
