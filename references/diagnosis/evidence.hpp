// The picture that is to be explained. Tells how well a set of faults explains it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "references/diagnosis/float_noise.hpp"
#include "references/diagnosis/levels.hpp"
#include "references/faults/fault.hpp"
#include "tracer/image/image_file.hpp"

namespace plumb::diagnosis {

/// Faults as ascending indices into the catalogue, each once. Those of geometry_families() come after it,
/// then those of shading_families().
using FaultSet = std::vector<std::size_t>;

/// The number of all faults that a set may have.
std::size_t number_of_faults();
const faults::Fault& fault_at(std::size_t index);
std::vector<const faults::Fault*> faults_of(const FaultSet& set);
FaultSet set_of(const std::vector<const faults::Fault*>& faults);
/// Return the set with a fault that is not in it, and without one that is.
FaultSet with(FaultSet set, std::size_t fault);
FaultSet without(FaultSet set, std::size_t fault);

/// How far a picture is from the one that a set of faults gives.
struct Fit {
  FaultSet set;
  OutputEncoding encoding;
  /// Mean of ln(1 + d) over the pixels that count. d is the largest difference of a pixel's channels, in
  /// levels of 8 bits. It asks how many pixels are right before it asks how wrong the others are.
  double misfit = 0;
  /// How far the picture is a function, whichever, of what the set gives: Chatterjee's xi ("A New Coefficient
  /// of Correlation", 2021), mean of the channels. It is 1 for a function, and about 0 when they have nothing
  /// to do with each other. It is high where each pixel shows the right point, even in wrong colours.
  double association = 0;
};

class Evidence {
 public:
  /// Scene and camera must outlive it. The job's size is the picture's. `tolerance` is in shares of 1;
  /// without it, colours may be off by what float32 rounds (see float_errors()).
  Evidence(const Scene& scene, const Camera& camera, const textbook::RenderJob& job, const ImageFile& seen,
           std::optional<double> tolerance);

  /// How far the right colour of a pixel may be off, relative above 1.
  float colour_error(std::size_t pixel) const { return errors_.allowed[pixel]; }
  /// The same without what is allowed where nothing was measured: for curves that are steep at 0.
  float measured_error(std::size_t pixel) const { return errors_.measured[pixel]; }
  /// How far a level of integers may be off in addition.
  double allowed_levels() const { return allowed_levels_; }
  /// True if the picture has finite numbers at a pixel.
  bool is_finite(std::size_t pixel) const;
  std::size_t non_finite() const;
  /// Returns the complete picture that a set gives, which is kept until another is asked for. The right one
  /// is the engine's and kept for good. Colours are not finite when the set cannot be traced.
  const Image& picture_with(const FaultSet& set) const;
  /// Returns what colours() does, of the scene that FloatMoves makes of this number.
  std::vector<float> moved_colours(int number, const FaultSet& set, const std::vector<PixelPlace>& places,
                                   textbook::Work& work) const;
  /// Of the right tracer in such a scene, what its rays meet; see course_of(). Nothing where a pixel has too
  /// many.
  std::vector<std::optional<std::uint64_t>> moved_courses(int number, const std::vector<PixelPlace>& places,
                                                          textbook::Work& work) const;
  /// At these pixels the right picture by the textbook tracer in float32, which rounds otherwise than the
  /// engine.
  std::vector<float> textbook_in_float(const std::vector<PixelPlace>& places) const;
  /// Returns the right picture of such a scene, by the engine in float32.
  Image moved_in_float(int number) const;

  /// True if this share of what the search may trace is traced.
  bool is_over(double share) const;
  /// The units of Work that a pixel of the right picture costs on average.
  double units_of_pixel() const { return units_of_pixel_; }
  /// Sets the pixels that count from now on.
  void look_at(const std::vector<PixelPlace>& pixels);
  std::size_t pixels() const { return places_.size(); }

  /// Returns linear r g b at these places, interleaved; not finite when the set cannot be traced.
  std::vector<float> colours(const FaultSet& set, const std::vector<PixelPlace>& places) const;

  /// Fits a set at the first `most` of the pixels, with the best encoding. One that cannot be traced fits
  /// worst.
  Fit fit(const FaultSet& set, std::size_t most) const;
  /// Returns the largest difference of each of these pixels, in levels, in the fit's encoding.
  std::vector<float> differences_at(const Fit& fit, const std::vector<PixelPlace>& places) const;
  /// Returns those of the sets that give the same levels as a fit at all pixels that count.
  std::vector<FaultSet> alike(const Fit& fit, const std::vector<FaultSet>& sets) const;

  /// Places spread evenly over the picture; as many as it has pixels, where that costs little.
  const std::vector<PixelPlace>& survey() const { return survey_; }
  /// Returns the largest difference of each pixel of the picture, in levels, row by row.
  std::vector<float> differences(const Fit& fit) const;

  std::size_t pixels_of_picture() const { return seen_.size() / 3; }
  int width() const { return job_.width; }
  int height() const { return job_.height; }
  const std::vector<OutputEncoding>& encodings() const { return encodings_; }
  /// The levels that the picture has at a pixel: red, green, blue.
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

}  // namespace plumb::diagnosis
