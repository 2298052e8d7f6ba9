// Chooses the cheapest configuration whose measured error stays under a bound.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "references/truth/figures.hpp"
#include "references/truth/oracle_sample.hpp"
#include "tracer/engine/statistics.hpp"

namespace plumb::studies {

/// One way to render a picture, and what came of it.
struct Candidate {
  RealType real = RealType::float64;
  int depth = 0;
  truth::ErrorFigures error;
  double cpu_seconds = 0;
  engine::Statistics statistics{};
};

/// Returns the name that --real has.
const char* to_string(RealType real);

/// A scene's picture in float and double at the depth asked for, and the oracle's pixels, which judge other
/// pictures.
class PictureJudge {
 public:
  /// Renders both with the engine. Has the oracle look at the pixels in which they differ most, then at
  /// spread ones. All arguments must outlive it. Throws what these throw.
  PictureJudge(const Scene& scene, const Camera& camera, const RenderJob& job);

  /// Renders with the engine in float and double, with the textbook tracer in others.
  Image rendered(RealType real, int depth, Candidate& candidate);
  truth::ErrorFigures error_of(const Image& image) const;
  double error_against_oracle(const Image& image) const;

  const truth::OracleSample& oracle() const { return oracle_; }
  std::size_t pixels() const {
    return static_cast<std::size_t>(job_.width) * static_cast<std::size_t>(job_.height);
  }
  const Image& picture(RealType real) const { return real == RealType::float32 ? in_float_ : in_double_; }
  /// Returns what the picture at the depth asked for came to.
  const Candidate& candidate(RealType real) const { return real == RealType::float32 ? float_ : double_; }
  const RenderJob& job() const { return job_; }

  /// Has the oracle look at those of these pixels at which it has not looked yet.
  void look_also_at(const std::vector<PixelPlace>& places);

 private:
  const Scene& scene_;
  const Camera& camera_;
  const RenderJob& job_;
  Candidate float_, double_;
  Image in_double_, in_float_;
  truth::OracleSample oracle_;
  std::vector<bool> is_looked_at_;  // by row and column
};

/// Returns the picture of the least depth whose error in that real type is within the bound. That of the
/// depth asked for must be. Every picture that was tried is reported, with its error.
using Tried = std::function<void(const Candidate&, Image&&)>;
Candidate least_depth(PictureJudge& judge, RealType real, double bound, const Tried& tried);

struct Choice {
  Candidate chosen;
  std::vector<Candidate> tried;  ///< in the order in which they were rendered
  std::size_t oracle_pixels = 0, pixels = 0;
  Image image;  ///< of the chosen one
};

/// Thrown when no configuration that was tried stays under the bound.
class BoundNotReached : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Returns the first that stays under the bound: float or double, each at its least depth, or long double at
/// the depth asked for. Throws BoundNotReached, which says what was reached, and what rendering throws.
Choice choose(const Scene& scene, const Camera& camera, const RenderJob& job, double bound);

/// Returns a few lines that say why, e.g. "float, depth 3: error 2.1e-07 (0.01 asked): ...".
std::string reason(const Choice& choice, double bound, int asked_depth);

}  // namespace plumb::studies
