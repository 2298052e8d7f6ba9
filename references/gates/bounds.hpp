// What a comparison allows besides its tolerance, and which pixels it leaves out.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "references/comparison/comparison.hpp"
#include "references/comparison/limit.hpp"
#include "references/comparison/pixel_mask.hpp"
#include "tracer/image/image_file.hpp"

namespace plumb::gates {

/// How many pixels may be over: a number of pixels, or a percentage of those that are compared.
struct AllowOver {
  double amount = 0;
  bool is_percent = false;

  /// Returns the number of pixels, rounded down.
  std::size_t of(std::size_t pixels) const;
  /// Returns e.g. "12" or "0.5%".
  std::string text() const;
};

/// One part of a picture: a rectangle, or what is not black in a mask image of the picture's size.
struct Region {
  std::string text;  ///< as asked for, e.g. "0,0,16,16" or "mask.png"
  std::optional<Window> rectangle;
  std::string mask_path;  ///< when there is no rectangle
};

struct Bounds {
  comparison::Limit limit = 1e-6;
  AllowOver allow_over;
  std::vector<Region> ignore;  ///< these pixels are left out
  std::vector<Region> only;    ///< if there are any, all pixels outside of them are left out
  std::string because;         ///< why; empty for bounds that a command line asks for

  /// Returns the mask images among the regions.
  std::vector<std::string> mask_paths() const;
  bool has_regions() const { return !ignore.empty() || !only.empty(); }
  /// True if nothing but the tolerance decides.
  bool are_plain() const;
};

/// Reads "12" or "0.5%". These two functions throw std::invalid_argument, whose text begins with `what`.
AllowOver parse_allow_over(const std::string& text, const std::string& what);
/// Reads "X,Y,W,H" or the path of a mask image. A relative path starts in `directory`, unless that is empty.
Region parse_region(const std::string& text, const std::string& what, const std::string& directory = {});

/// Returns the pixels of a picture of this size that count. Throws std::invalid_argument when a rectangle
/// lies outside of the picture, when a mask has another size or when no pixel is left, and std::runtime_error
/// when a mask cannot be read.
comparison::PixelMask mask_of(const Bounds& bounds, int width, int height);

/// A comparison and what its bounds made of it.
struct BoundedComparison {
  comparison::PixelMask mask;         ///< of the pixels that count
  comparison::Comparison comparison;  ///< of the pixels that count
  std::size_t ignored = 0;            ///< number of pixels that do not count
  std::size_t ignored_non_finite = 0;
  std::size_t allowed_over = 0;  ///< the number of pixels that may be over

  /// A pixel that counts and is not finite is never allowed.
  bool agrees() const { return comparison.non_finite == 0 && comparison.pixels_over <= allowed_over; }
};

/// Compares pictures of one size and channel count. Throws as mask_of() and compare() do.
BoundedComparison compare_within(const PixelRows& reference, const PixelRows& test, const Bounds& bounds);
BoundedComparison compare_within(const Image& reference, const Image& test, const Bounds& bounds);

}  // namespace plumb::gates
