#include "references/report/sentences.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "references/report/formatted.hpp"
#include "tracer/text/numbers.hpp"

namespace plumb::report {
namespace {

/// To `digits` digits.
std::string number(double value, int digits) {
  std::array<char, 32> text{};
  return {
      text.data(),
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, digits).ptr};
}

/// The shortest text that reads back as the same float32.
std::string components(const std::vector<float>& values) {
  std::string text;
  for (const float value : values) {
    std::array<char, 32> component{};
    text.append(text.empty() ? "" : " ");
    text.append(component.data(),
                std::to_chars(component.data(), component.data() + component.size(), value).ptr);
  }
  return text;
}

std::string size_text(int width, int height) { return std::to_string(width) + "x" + std::to_string(height); }

std::string name_of(truth::Verdict verdict) {
  std::string name = truth::to_string(verdict);
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

/// Parts with a separator between; empty ones are left out.
class Joined {
 public:
  explicit Joined(const char* separator) : separator_(separator) {}
  void add(const std::string& part) {
    if (!part.empty()) text_ += (text_.empty() ? "" : separator_) + part;
  }
  const std::string& text() const { return text_; }

 private:
  std::string separator_;
  std::string text_;
};

/// The budget in words: what the pixels over are, and what is wrong.
std::string budget_text(const gates::SceneResult& result) {
  const comparison::Comparison& c = result.comparison;
  if (c.non_finite > 0) return std::to_string(c.non_finite) + " pixels are not finite";
  const attribution::Budget& budget = result.budget;
  if (budget.explained() == 0) return {};
  std::string said = std::to_string(budget.explained()) + " of " + std::to_string(c.pixels_over) +
                     " pixels over are explained, each by a proof:";
  for (std::size_t i = 0; i + 1 < attribution::cause_count; ++i) {
    const auto cause = static_cast<attribution::Cause>(i);
    if (budget.count(cause) > 0)
      said +=
          std::string(" ") + attribution::to_string(cause) + " " + std::to_string(budget.count(cause)) + ",";
  }
  said.pop_back();
  if (!budget.shapes.empty()) said += "; shapes that take part:";
  for (const std::string& name : budget.shapes) said += " '" + name + "'";
  return result.broken_bound ? said + "; but " + in_words(*result.broken_bound) : said;
}

/// What agreement means little without: a picture of nothing, a file that was read with reservations.
std::string reservations(const gates::SceneResult& result) {
  Joined said("; ");
  if (result.is_of_one_colour)
    said.add(
        "nothing is seen: every pixel has the same colour; is the camera turned away, or do the transforms "
        "act "
        "in another order (--dialect post or trs)?");
  if (result.scene_warnings > 0)
    said.add(std::to_string(result.scene_warnings) + (result.scene_warnings == 1 ? " warning" : " warnings") +
             ", see plumb lint");
  return said.text();
}

std::string suspect_text(const gates::FloatSuspect& suspect) {
  const std::string by =
      suspect.error ? ": float32 alone differs from double by up to " + number(*suspect.error, 3) + " here"
                    : "";
  return "rendered with --real float" + by + "; try --real double";
}

/// Which could not be compared, and the first that differs.
std::string terms_text(const gates::SceneResult& result) {
  Joined said("; ");
  for (const gates::TermResult& t : result.terms) {
    if (!t.trouble.empty())
      said.add(std::string("the term ") + attribution::to_string(t.term) +
               " could not be compared: " + t.trouble);
  }
  const auto first = std::find_if(result.terms.begin(), result.terms.end(),
                                  [](const gates::TermResult& t) { return t.unexplained > 0; });
  if (first == result.terms.end()) return said.text();
  const bool differs = result.status == gates::Status::differ;
  said.add(std::string(differs ? "the difference lives in the term " : "alone, there differs the term ") +
           attribution::to_string(first->term));
  return said.text();
}

/// The figures of a difference from a baseline.
std::string difference_text(const comparison::Comparison& c) {
  std::string text = std::to_string(c.pixels_over) + " of " + std::to_string(c.pixels) + " pixels are over";
  if (c.non_finite > 0) text += ", " + std::to_string(c.non_finite) + " of them are not finite";
  double error = 0;
  for (std::size_t i = 0; i < c.worst.test.size(); ++i) {
    error = std::max(
        error, std::abs(static_cast<double>(c.worst.test[i]) - static_cast<double>(c.worst.reference[i])));
  }
  text += "; worst pixel (" + std::to_string(c.worst.x) + ", " + std::to_string(c.worst.y) + "): ours " +
          components(c.worst.test) + ", baseline " + components(c.worst.reference);
  return c.non_finite > 0 ? text : text + ", off by " + number(error, 6);
}

/// Who to ask about the baseline.
std::string history_text(const gates::RegressedScene& scene) {
  const renderers::Baseline& baseline = *scene.approved;
  return "\nbaseline approved by " + baseline.who + ", " + baseline.when + ": " + baseline.why +
         (scene.has_changed ? "\nthe scene file has changed since" : "");
}

/// What differs from the baseline; of a scene that agrees, what verify would say.
std::string compared_text(const gates::RegressedScene& scene) {
  const gates::SceneResult& result = scene.result;
  if (result.no_figures == gates::NoFigures::nothing_approved) return "new: there is no baseline yet";
  if (result.no_figures == gates::NoFigures::other_size)
    return "the size is " + size_text(result.width, result.height) + ", of the baseline " +
           size_text(scene.approved->width, scene.approved->height) + history_text(scene);
  if (result.status != gates::Status::differ) return message_of(result);
  Joined lines("\n");
  lines.add(difference_text(result.comparison) + history_text(scene));
  lines.add(message_of(result));
  return lines.text();
}

std::string list(const std::vector<gates::Region>& regions) {
  std::string text;
  for (const gates::Region& region : regions) text += (text.empty() ? "" : " ") + region.text;
  return text;
}

std::string pixels_text(std::size_t pixels) {
  return std::to_string(pixels) + (pixels == 1 ? " pixel" : " pixels");
}

std::string regions_text(const gates::Bounds& bounds, const gates::BoundedComparison& result) {
  std::string text = pixels_text(result.ignored) + " ignored";
  if (!bounds.only.empty()) text += ", only " + list(bounds.only) + " compared";
  if (!bounds.ignore.empty()) text += ", not compared: " + list(bounds.ignore);
  if (result.ignored_non_finite > 0)
    text += "; " + std::to_string(result.ignored_non_finite) + " of the ignored are not finite";
  return text;
}

}  // namespace

std::string in_words(const attribution::BrokenBound& broken) {
  if (broken.cause)
    return std::to_string(broken.found) + " pixels are put down to " + attribution::to_string(*broken.cause) +
           ", at most " + std::to_string(broken.allowed) + " are allowed";
  return std::to_string(broken.found) +
         " pixels are unverified: the reference does not tell apart the surfaces that meet there, or the "
         "scene's last digits leave the colour open, so nothing says what colour ours has; at most " +
         std::to_string(broken.allowed) + " are allowed, 1 % of the picture";
}

std::string note_of(const attribution::Budget& budget) {
  if (budget.unexamined == 0) return {};
  return std::to_string(budget.unexamined) +
         " of the unexplained pixels were not examined to the end: there are too many, or each takes too "
         "many "
         "rays";
}

std::string note_of(const truth::Judgement& judgement) {
  Joined said("; ");
  const std::size_t both = judgement.count(truth::Verdict::both_wrong);
  const std::size_t wrong = judgement.count(truth::Verdict::ours_wrong) + both;
  if (wrong > 0)
    said.add("judged in 113 bits, our side is wrong at " + pixels_text(wrong) +
             (both > 0 ? " (at " + std::to_string(both) + " of them the reference is, too)" : ""));
  if (judgement.not_judged > 0)
    said.add(
        pixels_text(judgement.not_judged) + " over not judged: " +
        (judgement.ran_out ? "the work for one scene was spent" : "more rays than are traced for one pixel"));
  return said.text();
}

std::string judgement_text(const truth::Judgement& judgement) {
  std::string text;
  for (const truth::Verdict verdict : truth::all_verdicts) {
    text +=
        formatted("%s%s %zu", text.empty() ? "" : ", ", name_of(verdict).c_str(), judgement.count(verdict));
  }
  return text;
}

std::string judged_text(const truth::JudgedPixel& p) {
  return "in 113 bits: " + name_of(p.verdict) + "; the scene as written gives " + to_text(p.oracle.x) + " " +
         to_text(p.oracle.y) + " " + to_text(p.oracle.z) + "\n";
}

std::string cause_text(const comparison::LikelyCause& c) {
  if (!c.because.empty())
    return formatted("%s (then 0 pixels over, because %s)", c.text.c_str(), c.because.c_str());
  std::string text = formatted("%s (then %zu pixels over", c.text.c_str(), c.pixels_over);
  if (c.pixels_over > 0) text += formatted(", %.4g %% of the squared error gone", 100 * c.removed);
  return text + ")";
}

std::string bounds_text(const gates::Bounds& bounds, const gates::BoundedComparison& result) {
  if (bounds.are_plain()) return {};
  Joined parts("; ");
  if (!bounds.because.empty()) parts.add("tolerance " + number(bounds.limit.tolerance, 6));
  if (bounds.limit.is_relative()) parts.add("relative " + number(bounds.limit.relative, 6));
  if (bounds.allow_over.amount > 0)
    parts.add(pixels_text(result.allowed_over) + " may be over (" + bounds.allow_over.text() + ")");
  if (bounds.has_regions()) parts.add(regions_text(bounds, result));
  if (!bounds.because.empty()) parts.add("because " + bounds.because);
  return parts.text();
}

std::string not_compared_text(const gates::SceneResult& result) {
  if (!result.no_figures) return {};
  switch (*result.no_figures) {
    case gates::NoFigures::nothing_approved:
      return "there is nothing to compare with: no image was approved yet";
    case gates::NoFigures::other_size:
      return "images of two sizes are not compared";
    case gates::NoFigures::trouble:
      break;
  }
  return "nothing was compared";
}

std::string message_of(const gates::SceneResult& result) {
  if (result.status == gates::Status::error) return result.trouble;
  Joined said("; ");
  if (result.has_causes) {
    said.add(budget_text(result));
    said.add(note_of(result.budget));
  }
  if (result.judgement) said.add(note_of(*result.judgement));
  if (!result.reference_warnings.empty())
    said.add(result.reference_title + " warns: " + result.reference_warnings);
  said.add(reservations(result));
  if (result.suspect) said.add(suspect_text(*result.suspect));
  said.add(terms_text(result));
  return said.text();
}

std::string message_without_bounds(const gates::RegressedScene& scene) {
  if (!scene.lost.empty())
    return "THE SCENE IS GONE, its baseline " + scene.lost +
           " is there: bring the scene back, or approve that it is gone";
  if (scene.result.status == gates::Status::error) return scene.result.trouble;
  Joined lines("\n");
  lines.add(compared_text(scene));
  lines.add(scene.not_stored);
  if (!scene.cannot_be_approved.empty()) lines.add("cannot be approved: " + scene.cannot_be_approved);
  return lines.text();
}

std::string message_of(const gates::RegressedScene& scene) {
  const std::string bounds =
      scene.bounds ? bounds_text(scene.bounds->bounds, scene.bounds->comparison) : std::string();
  const bool is_within =
      scene.result.status == gates::Status::agree && scene.result.comparison.pixels_over > 0;
  Joined lines("\n");
  lines.add(message_without_bounds(scene));
  if (!bounds.empty()) lines.add("bounds: " + bounds + (is_within ? "; without them it differs" : ""));
  return lines.text();
}

}  // namespace plumb::report
