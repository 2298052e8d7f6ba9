// The cheapest configuration whose measured error stays under a bound.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "references/truth/figures.hpp"
#include "references/truth/oracle_sample.hpp"
#include "tracer/engine/statistics.hpp"

namespace plumb::references {

/// One way to render a picture, and what it came to.
struct Candidate {
  RealType real = RealType::float64;
  int depth = 0;
  ErrorFigures error;
  double cpu_seconds = 0;
  engine::Statistics statistics{};
};

/// As --real has it.
const char* to_string(RealType real);

/// A scene's picture in float and double at the depth asked for, and the oracle's pixels, by which others are
/// judged.
class PictureJudge {
 public:
  /// Renders both with the engine, and has the oracle look at the pixels in which they differ most, then at
  /// spread ones. All must outlive it. Throws what these throw.
  PictureJudge(const Scene& scene, const Camera& camera, const RenderJob& job);

  /// The engine renders float and double, the textbook tracer others.
  Image rendered(RealType real, int depth, Candidate& candidate);
  ErrorFigures error_of(const Image& image) const;
  double error_against_oracle(const Image& image) const;

  const OracleSample& oracle() const { return oracle_; }
  std::size_t pixels() const {
    return static_cast<std::size_t>(job_.width) * static_cast<std::size_t>(job_.height);
  }
  const Image& picture(RealType real) const { return real == RealType::float32 ? in_float_ : in_double_; }
  /// Of the pictures at the depth asked for.
  const Candidate& candidate(RealType real) const { return real == RealType::float32 ? float_ : double_; }
  const RenderJob& job() const { return job_; }

  /// Has the oracle look at those of these pixels that it has not looked at.
  void look_also_at(const std::vector<PixelPlace>& places);

 private:
  const Scene& scene_;
  const Camera& camera_;
  const RenderJob& job_;
  Candidate float_, double_;
  Image in_double_, in_float_;
  OracleSample oracle_;
  std::vector<bool> is_looked_at_;  // by row and column
};

/// The least depth at which a picture in that real type has no error above the bound; the asked depth has
/// none. Every picture that was tried is reported, with its error.
using Tried = std::function<void(const Candidate&, Image&&)>;
Candidate least_depth(PictureJudge& judge, RealType real, double bound, const Tried& tried);

struct Choice {
  Candidate chosen;
  std::vector<Candidate> tried;  ///< in the order in which they were rendered
  std::size_t oracle_pixels = 0, pixels = 0;
  Image image;  ///< of the chosen one
};

/// No configuration that was tried stays under the bound.
class BoundNotReached : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The first that stays under the bound of: float, double, each at its least depth; long double at the depth
/// asked for. Throws BoundNotReached, which says what was reached, and what rendering throws.
Choice choose(const Scene& scene, const Camera& camera, const RenderJob& job, double bound);

/// E.g. "float, depth 3: error 2.1e-07 (0.01 asked): ..."; a few lines that say why.
std::string reason(const Choice& choice, double bound, int asked_depth);

}  // namespace plumb::references
