// The picture that is to be explained, and how well a set of faults explains it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "references/diagnosis/float_noise.hpp"
#include "references/diagnosis/levels.hpp"
#include "references/faults/fault.hpp"
#include "tracer/image/image_file.hpp"

namespace plumb::references {

/// Faults as indices into the catalogue, in its order, each once.
using FaultSet = std::vector<std::size_t>;

std::vector<const Fault*> faults_of(const FaultSet& set);
/// With a fault that is not in it, and without one that is.
FaultSet with(FaultSet set, std::size_t fault);
FaultSet without(FaultSet set, std::size_t fault);

/// How far a picture is from the one that a set of faults gives.
struct Fit {
  FaultSet set;
  OutputEncoding encoding;
  /// Mean of ln(1 + d) over the pixels looked at, d the largest difference of a pixel in levels of 8 bits: it
  /// asks how many pixels are right before it asks how wrong the others are.
  double misfit = 0;
  /// How far the picture is a function of what the set gives, whichever: Chatterjee's xi ("A New Coefficient
  /// of Correlation", 2021), mean of the channels; 1 when it is one, about 0 when they have nothing to do
  /// with each other. Where the right points are seen in each pixel, it is high even if they have wrong
  /// colours.
  double association = 0;
};

class Evidence {
 public:
  /// All must outlive it. The job's size is the picture's. `tolerance` is in shares of 1: without it, colours
  /// may be off by what float32 rounds (see float_errors()).
  Evidence(const Scene& scene, const Camera& camera, const textbook::RenderJob& job, const ImageFile& seen,
           std::optional<double> tolerance);

  /// What the right colour of a pixel may be off by, relative above 1, and what a level of integers may be
  /// off by beside.
  float colour_error(std::size_t pixel) const { return errors_.allowed[pixel]; }
  /// The same without what is allowed where nothing was measured: for curves that are steep at 0.
  float measured_error(std::size_t pixel) const { return errors_.measured[pixel]; }
  double allowed_levels() const { return allowed_levels_; }
  /// Whether the picture has numbers at a pixel.
  bool is_finite(std::size_t pixel) const;
  std::size_t non_finite() const;
  /// The whole picture that a set gives, which is kept until another is asked for; the right one, by the
  /// engine, is kept for good. Not finite where the set cannot be traced.
  const Image& picture_with(const FaultSet& set) const;
  /// As colours(), of the scene as FloatMoves moves it.
  std::vector<float> moved_colours(int number, const FaultSet& set, const std::vector<PixelPlace>& places,
                                   textbook::Work& work) const;
  /// Of the right tracer in such a scene, what its rays meet; see course_of(). Nothing where a pixel has too
  /// many.
  std::vector<std::optional<std::uint64_t>> moved_courses(int number, const std::vector<PixelPlace>& places,
                                                          textbook::Work& work) const;
  /// At these pixels the right picture by the textbook tracer in float32, which rounds otherwise than the
  /// engine.
  std::vector<float> textbook_in_float(const std::vector<PixelPlace>& places) const;
  /// The right picture of such a scene, by the engine in float32.
  Image moved_in_float(int number) const;

  /// Whether this share of what the search may trace is traced.
  bool is_over(double share) const;
  /// Units of Work that a pixel of the right picture costs on average.
  double units_of_pixel() const { return units_of_pixel_; }
  /// The pixels that count from now on.
  void look_at(const std::vector<PixelPlace>& pixels);
  std::size_t pixels() const { return places_.size(); }

  /// Linear r g b at these pixels, interleaved; not finite where the set cannot be traced.
  std::vector<float> colours(const FaultSet& set, const std::vector<PixelPlace>& places) const;

  /// At the first `most` of the pixels, with the best encoding. A set that cannot be traced fits worst.
  Fit fit(const FaultSet& set, std::size_t most) const;
  /// At these pixels, in the fit's encoding: largest difference of each, in levels.
  std::vector<float> differences_at(const Fit& fit, const std::vector<PixelPlace>& places) const;
  /// Those of the sets that give the same levels as a fit at all pixels looked at.
  std::vector<FaultSet> alike(const Fit& fit, const std::vector<FaultSet>& sets) const;

  /// Places spread evenly over the picture: all, where that costs little.
  const std::vector<PixelPlace>& survey() const { return survey_; }
  /// Largest difference of each pixel of the picture, in levels, row by row.
  std::vector<float> differences(const Fit& fit) const;

  std::size_t pixels_of_picture() const { return seen_.size() / 3; }
  int width() const { return job_.width; }
  int height() const { return job_.height; }
  const std::vector<OutputEncoding>& encodings() const { return encodings_; }
  /// The levels that the picture has at a pixel.
  const float* seen(std::size_t pixel) const { return &seen_[3 * pixel]; }
  std::size_t index_of(const PixelPlace& place) const;
  PixelPlace place_of(std::size_t pixel) const;
  const Scene& scene() const { return scene_; }
  const Camera& camera() const { return camera_; }
  const textbook::RenderJob& job() const { return job_; }

 private:
  const FloatMoves& moves() const;
  std::vector<PixelPlace> first(std::size_t most) const;
  double misfit(const std::vector<float>& unrounded, const OutputEncoding& encoding) const;
  double association(const std::vector<float>& colours) const;

  const Scene& scene_;
  const Camera& camera_;
  textbook::RenderJob job_;
  std::vector<float> seen_;  // in levels
  std::vector<OutputEncoding> encodings_;
  std::vector<PixelPlace> places_;
  mutable textbook::Work work_;
  double units_of_pixel_;
  std::vector<PixelPlace> survey_;
  Image right_;
  FloatErrors errors_;
  double allowed_levels_ = 0;
  mutable FaultSet set_of_other_;
  mutable Image other_;
  mutable std::unique_ptr<FloatMoves> moves_;
};

}  // namespace plumb::references
