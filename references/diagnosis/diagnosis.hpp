// Finds what is wrong with the tracer that made a picture.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "references/diagnosis/evidence.hpp"

namespace plumb::diagnosis {

enum class PictureVerdict {
  right,        ///< every pixel is what an encoding holds of the lecture's, or proven to lie on an edge
  right_apart,  ///< the same but for a few pixels, which no known fault explains
  faults,       ///< the faults explain it, all or in part
  unexplained   ///< none of these: no set of known faults gives this picture
};

const char* to_string(PictureVerdict verdict);

struct FoundFault {
  const faults::Fault* fault;  ///< of fault_catalogue() or geometry_families()
  double confidence;  ///< 0 to 1: the share explained, divided among the faults that cannot be told apart
  /// Number that are right with it and not without it; of a fault that the geometry tells, number that show
  /// another surface than with the right camera. Never 0.
  std::size_t pixels;
  std::vector<const faults::Fault*> alike;  ///< faults that give the same picture of this scene in its place
  std::size_t changed = 0;                  ///< number whose level is another without it
};

/// Something that a tracer does and that is no formula of the lecture: a remark, not a mistake.
struct Habit {
  std::string id;     ///< "background": the colour where nothing is hit
  std::string title;  ///< one sentence
  Rgbd value;         ///< as the file has it, 0 to 1
};

enum class Certainty { unknown, right, wrong };

/// What is known even if not all is explained.
struct Certain {
  Certainty camera = Certainty::unknown;   ///< where things are, whatever their colours
  Certainty shadows = Certainty::unknown;  ///< which lights reach a surface
  Certainty shading = Certainty::unknown;  ///< the other colours of surfaces
};

struct ShapeSeen {
  std::string name;  ///< empty: the background
  std::size_t pixels;
};

struct Diagnosis {
  PictureVerdict verdict = PictureVerdict::unexplained;
  std::vector<FoundFault> faults;  ///< the largest effect first; none when it is unexplained
  OutputEncoding encoding;
  bool is_flipped = false;      ///< upside-down is among the faults
  double rms = 0;               ///< of the differences that remain, in shares of 255 levels
  std::size_t pixels_over = 0;  ///< number that remain more than 2 levels away
  std::size_t pixels = 0;       ///< number in the picture
  std::size_t non_finite = 0;   ///< number with a component that is no finite number
  std::size_t edges = 0;        ///< number that are right because they are proven to lie on an edge
  /// Number of pixels that the picture with the faults found, or the right one, does not account for.
  std::size_t unexplained_pixels = 0;
  bool is_of_one_colour = false;  ///< true if it is not right and of one colour, which tells nothing
  std::vector<Habit> habits{};    ///< pixels that these account for are not counted as unexplained
  Certain certain;
  /// What the pixels that are not explained should show, the most first. Empty where that is not known.
  std::vector<ShapeSeen> shapes{};
  /// Faults of which the picture shows that its tracer does not have them: it is right where it would not be
  /// with them. Empty while the camera is unknown.
  std::vector<const faults::Fault*> excluded{};

  bool explains_all() const { return unexplained_pixels == 0; }
  /// True if something is known of the picture; else a diagnosis abstains.
  bool tells_something() const {
    return verdict != PictureVerdict::unexplained || certain.camera != Certainty::unknown || !habits.empty();
  }
};

/// Diagnoses a picture of the job's size. `tolerance` is in shares of 1. Colours of floats may be off by it,
/// relative above 1, instead of by float32's own error; levels of integers may be off by so much more. Throws
/// std::runtime_error when the scene cannot be traced.
Diagnosis diagnose(const Scene& scene, const Camera& camera, const textbook::RenderJob& job,
                   const ImageFile& seen, std::optional<double> tolerance = {});

inline constexpr const char* one_colour_tells_nothing =
    "the picture has one colour, which tells no mistake from another";

/// Returns what is not right, in one line, e.g. "right apart from 313 of 76800 pixels, all on 'tiny'"; empty
/// for a picture that is right or explained.
std::string summary_of(const Diagnosis& diagnosis);

}  // namespace plumb::diagnosis
