// How people write a layer of normals or of depths as colours.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace plumb::diagnosis {

/// Red, green and blue as a file has them, 0 to 1 in integers.
using Seen = std::array<float, 3>;

/// How well a layer that a tracer would have made accounts for the one that was handed in.
struct LayerFit {
  std::string encoding;         ///< in words, e.g. "n / 2 + 1/2"
  std::vector<bool> explained;  ///< for each pixel
};

/// Returns the fit of these unit normals in the best of the usual encodings: n / 2 + 1/2, n itself, its
/// absolute value or what of it is positive, each with no curve, tone-mapped, or with the sRGB curve. A file
/// that `is_rounded` has levels of 8 bits or more, rounded or truncated to 8; else it has floats.
LayerFit fit_of_normals(std::span<const std::array<float, 3>> normals, std::span<const Seen> seen,
                        bool is_rounded);

/// Returns the fit of these depths by a straight line, of the depth along the ray, of that along the camera's
/// direction, or of the reciprocal of either. Nothing when the line has too few levels to tell anything.
std::optional<LayerFit> fit_of_depths(std::span<const float> along_ray, std::span<const float> along_camera,
                                      std::span<const Seen> seen, bool is_rounded);

}  // namespace plumb::diagnosis
