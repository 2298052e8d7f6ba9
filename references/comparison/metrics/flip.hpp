// FLIP: how different two pictures look when they are flipped in place, per pixel from 0 to 1.
// LDR-FLIP: P. Andersson, J. Nilsson, T. Akenine-Moller, M. Oskarsson, K. Astrom, M. D. Fairchild, "FLIP: A
// Difference Evaluator for Alternating Images", High Performance Graphics 2020. HDR-FLIP: P. Andersson, J.
// Nilsson, P. Shirley, T. Akenine-Moller, "Visualizing Errors in Rendered High Dynamic Range Images",
// Eurographics 2021. The observer is the papers': a 0.7 m wide screen of 3840 pixels seen from 0.7 m, 67.02
// pixels a degree.
#pragma once

#include <optional>
#include <vector>

#include "references/comparison/metrics/picture.hpp"

namespace plumb::comparison {

/// What the values of a picture mean.
enum class ColourSpace {
  srgb,   ///< encoded by the sRGB curve, 0 to 1: judged by LDR-FLIP
  linear  ///< light, possibly above 1: judged by HDR-FLIP
};

/// Exposures of HDR-FLIP, in stops (2021, section 3.2). They follow from the reference alone, for the tone
/// curve ACES of K. Narkowicz (2016) without its pre-exposure of 0.6.
struct Exposures {
  double start = 0;  ///< the brightest pixel reaches 0.85
  double stop = 0;   ///< the median pixel reaches 0.85
  int count = 1;     ///< at least 2, else the stops in between, rounded up; 1 for a black reference
};

struct Flip {
  double mean = 0;
  double max = 0;
  std::optional<Exposures> exposures;  ///< of HDR-FLIP
};

/// Computes them from the largest and the median luminance of the reference. A median below 2^-23 counts as
/// 2^-23; a reference without any pixel above that counts as black. The paper's range needs a largest value
/// that is not below the median, and float32 holds no factor that would show less.
Exposures flip_exposures(const PictureView& reference);

/// Returns FLIP of every pixel, row by row; for linear colours the largest over all exposures (2021, section
/// 3.1). The pictures have one size and finite components. Of more than three channels the first three count;
/// of fewer, the first is grey.
std::vector<float> flip_map(const PictureView& reference, const PictureView& test, ColourSpace space);

/// Returns mean and largest value of that map.
Flip flip(const PictureView& reference, const PictureView& test, ColourSpace space);

}  // namespace plumb::comparison
