// What is wrong with the tracer that made a picture.
#pragma once

#include <string>
#include <vector>

#include "references/diagnosis/evidence.hpp"

namespace plumb::references {

enum class PictureVerdict {
  right,       ///< the lecture's picture, in one of the encodings
  faults,      ///< explained by the faults
  unexplained  ///< neither: no set of known faults gives this picture
};

const char* to_string(PictureVerdict verdict);

struct FoundFault {
  const Fault* fault;
  double confidence;   ///< 0 to 1: the share explained, divided among those that cannot be told apart
  std::size_t pixels;  ///< that are right with it and not without it
  std::vector<const Fault*> alike;  ///< that give the same picture of this scene in its place
};

struct Diagnosis {
  PictureVerdict verdict = PictureVerdict::unexplained;
  std::vector<FoundFault> faults;  ///< by effect, the largest first; none when it is unexplained
  OutputEncoding encoding;
  bool is_flipped = false;      ///< upside-down is among the faults
  double rms = 0;               ///< of what remains, in shares of 255 levels
  std::size_t pixels_over = 0;  ///< that remain more than 2 levels away
  std::size_t pixels = 0;       ///< of the picture
  double explained = 0;         ///< share of the pixels that show more than the background
};

/// The picture's size is that of the job. Throws std::runtime_error when the scene cannot be traced.
Diagnosis diagnose(const Scene& scene, const Camera& camera, const textbook::RenderJob& job,
                   const ImageFile& seen);

}  // namespace plumb::references
