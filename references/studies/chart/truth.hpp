// The pictures with which a chart compares others.
#pragma once

#include <functional>
#include <string>

#include "references/studies/chart/configuration.hpp"

namespace plumb::studies {

/// Number of samples of a pixel, a grid of 32 x 32, whose mean stands for the pixel's area. At an edge it is
/// an eighth as far from that as 16 samples are: the error of a grid falls with its spacing.
inline constexpr int samples_of_area = 1024;

/// Renders a truth: the textbook tracer in 113 bits for pixel centres; for areas the engine in double, whose
/// rounding is far below what any number of samples leaves. `progress` gets the fraction that is done.
Image render_truth(const Shot& shot, Truth truth, const std::function<void(double)>& progress);

/// The same, kept as a file at `path`; rendered anew when that is absent, damaged, or `fresh` is asked for.
Image stored_truth(const Shot& shot, Truth truth, const std::string& path, bool fresh,
                   const std::function<void(double)>& progress);

}  // namespace plumb::studies
