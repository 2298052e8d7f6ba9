// Looks at pixels of a picture, as many as a counted amount of work allows.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

#include "tracer/image/pixel_place.hpp"
#include "tracer/textbook/ray_budget.hpp"

namespace plumb::textbook {

/// The first `most` pixels of a picture, or all, each once, in an order of which each first part lies evenly
/// over the picture: Weyl's sequence by the plastic number (Roberts, "The Unreasonable Effectiveness of
/// Quasirandom Sequences", 2018), then row by row what that has not met.
std::vector<PixelPlace> spread_pixels(int width, int height, std::size_t most);
inline std::vector<PixelPlace> spread_pixels(int width, int height) {
  return spread_pixels(width, height, std::numeric_limits<std::size_t>::max());
}

/// How long pixels are looked at.
struct Looking {
  Work& work;  ///< until it is over
  int threads;
  std::function<void(double)> progress;  ///< with the fraction that is done; may be empty
};

/// Calls `look(begin, end, work)`, which spends what it traces, for pieces of 0..n in their order, each with
/// a work of its own, on several threads, until the work is over. Returns how many of the n were looked at:
/// at least one, and as many on any number of threads.
std::size_t look_at(std::size_t n, const Looking& looking,
                    const std::function<void(std::size_t begin, std::size_t end, Work& work)>& look);

}  // namespace plumb::textbook
