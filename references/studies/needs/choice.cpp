#include "references/studies/needs/choice.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "references/renderers/ours.hpp"

namespace plumb::studies {
namespace {

/// Because 5,000 pixels find a mistake in one of 1,700 pixels with a chance of 95 %. Those in which float and
/// double differ are looked at anyway.
constexpr std::size_t most_spread_pixels = 5000;
constexpr std::size_t suspect_pixels = 256;
/// For the pixels that differ and for the spread ones each: about a second of a machine of 2023.
constexpr double most_oracle_units = 7.5e7;

std::string formatted(const char* format, const auto&... values) {
  std::string text(static_cast<std::size_t>(std::snprintf(nullptr, 0, format, values...)), '\0');
  std::snprintf(text.data(), text.size() + 1, format, values...);
  return text;
}

std::string named(const Candidate& c) {
  return std::string(to_string(c.real)) + ", depth " + std::to_string(c.depth);
}

std::string tried_text(const std::vector<Candidate>& tried) {
  std::string text;
  for (const Candidate& c : tried)
    text += formatted("  %-22s error %.2g, %.1f ms of CPU\n", named(c).c_str(), c.error.largest(),
                      1e3 * c.cpu_seconds);
  return text;
}

}  // namespace

const char* to_string(RealType real) {
  switch (real) {
    case RealType::float32:
      return "float";
    case RealType::long_double:
      return "long-double";
    case RealType::quad:
      return "quad";
    case RealType::float64:
      break;
  }
  return "double";
}

PictureJudge::PictureJudge(const Scene& scene, const Camera& camera, const RenderJob& job)
    : scene_(scene), camera_(camera), job_(job) {
  in_double_ = rendered(RealType::float64, job.options.depth, double_);
  in_float_ = rendered(RealType::float32, job.options.depth, float_);
  is_looked_at_.assign(pixels(), false);
  look_also_at(truth::most_different(in_float_, in_double_, suspect_pixels));
  look_also_at(textbook::spread_pixels(job.width, job.height, most_spread_pixels));
  float_.error = error_of(in_float_);
  double_.error = error_of(in_double_);
}

Image PictureJudge::rendered(RealType real, int depth, Candidate& candidate) {
  RenderJob job = job_;
  job.real = real;
  job.options.depth = depth;
  const engine::Stopwatch watch;
  Image image = renderers::render(renderers::OwnTracer::engine, scene_, camera_, job, &candidate.statistics);
  candidate.real = real;
  candidate.depth = depth;
  candidate.cpu_seconds = watch.elapsed().cpu;
  return image;
}

void PictureJudge::look_also_at(const std::vector<PixelPlace>& places) {
  std::vector<PixelPlace> unseen;
  for (const PixelPlace& p : places) {
    const std::size_t at = in_double_.offset(p.x, p.y) / 3;
    if (!is_looked_at_[at]) unseen.push_back(p);
    is_looked_at_[at] = true;
  }
  textbook::Work work(most_oracle_units);
  truth::OracleSample more = truth::ask_oracle(scene_, camera_, job_, unseen, work);
  oracle_.cut += more.cut;
  oracle_.pixels.insert(oracle_.pixels.end(), more.pixels.begin(), more.pixels.end());
}

double PictureJudge::error_against_oracle(const Image& image) const {
  double error = 0;
  for (const truth::OraclePixel& p : oracle_.pixels)
    error = std::max(error, truth::error_of_pixel(p.colour, image, p.place));
  return error;
}

truth::ErrorFigures PictureJudge::error_of(const Image& image) const {
  double against_double = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const float* const p = in_double_.pixel(x, y);
      against_double = std::max(against_double, truth::error_of_pixel(Rgbd(p[0], p[1], p[2]), image, {x, y}));
    }
  }
  return {error_against_oracle(image), against_double};
}

Candidate least_depth(PictureJudge& judge, RealType real, double bound, const Tried& tried) {
  Candidate least = judge.candidate(real);
  int too_small = 0;
  while (least.depth - too_small > 1) {
    Candidate middle;
    Image image = judge.rendered(real, too_small + (least.depth - too_small) / 2, middle);
    middle.error = judge.error_of(image);
    if (middle.error.largest() <= bound)
      least = middle;
    else
      too_small = middle.depth;
    tried(middle, std::move(image));
  }
  return least;
}

namespace {

/// Renders in long double with the textbook tracer. Double is no yardstick for it, so the oracle alone is.
Choice in_long_double(PictureJudge& judge, double bound, Choice choice) {
  Candidate candidate;
  if (judge.job().samples == 1) {
    choice.image = judge.rendered(RealType::long_double, judge.job().options.depth, candidate);
    judge.look_also_at(truth::most_different(judge.picture(RealType::float64), choice.image, suspect_pixels));
    candidate.error = {judge.error_against_oracle(choice.image), std::nullopt};
    choice.tried.push_back(candidate);
    choice.chosen = candidate;
    choice.oracle_pixels = judge.oracle().pixels.size();
    if (candidate.error.largest() <= bound) return choice;
  }
  throw BoundNotReached(formatted("no picture with an error of at most %g, expected one of:\n", bound) +
                        tried_text(choice.tried) +
                        "ask for a larger --error (pictures hold 24 bits: 6e-8 is the least for values "
                        "below 1), or render with --real quad");
}

}  // namespace

Choice choose(const Scene& scene, const Camera& camera, const RenderJob& job, double bound) {
  PictureJudge judge(scene, camera, job);
  if (judge.oracle().pixels.empty())
    throw BoundNotReached("no error could be measured: each pixel that was looked at has more than " +
                          std::to_string(textbook::most_rays_of_pixel) +
                          " rays, expected fewer; choose a smaller --depth");
  Choice choice;
  choice.oracle_pixels = judge.oracle().pixels.size();
  choice.pixels = judge.pixels();
  for (const RealType real : {RealType::float32, RealType::float64}) {
    choice.tried.push_back(judge.candidate(real));
    if (judge.candidate(real).error.largest() > bound) continue;
    choice.image = judge.picture(real);
    choice.chosen = least_depth(judge, real, bound, [&](const Candidate& tried, Image&& image) {
      choice.tried.push_back(tried);
      if (tried.error.largest() > bound) return;
      choice.image = std::move(image);
    });
    return choice;
  }
  return in_long_double(judge, bound, std::move(choice));
}

std::string reason(const Choice& choice, double bound, int asked_depth) {
  const Candidate& c = choice.chosen;
  std::string text =
      formatted("%s: error %.2g, at most %g was asked for\n", named(c).c_str(), c.error.largest(), bound);
  const std::string share =
      choice.oracle_pixels == choice.pixels ? "all" : std::to_string(choice.oracle_pixels) + " of";
  text += formatted("  against 113 bits %.2g, on %s %zu pixels", c.error.against_oracle, share.c_str(),
                    choice.pixels);
  if (c.error.against_double)
    text += formatted("; against double at depth %d %.2g, on all", asked_depth, *c.error.against_double);
  return text + "\ntried, the cheapest kinds first:\n" + tried_text(choice.tried);
}

}  // namespace plumb::studies
