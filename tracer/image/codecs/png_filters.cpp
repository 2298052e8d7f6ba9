#include "tracer/image/codecs/png_filters.hpp"

#include <algorithm>
#include <cstring>
#include <vector>

namespace plumb::codecs {
namespace {

using Byte = std::uint8_t;

/// PNG, section 9.4: that of the three which is nearest to left + up - corner. That is the smaller, the
/// corner or the larger one; asked so, there is nothing to branch on.
int paeth(int left, int up, int corner) {
  const int low = std::min(left, up), high = std::max(left, up), beyond = 3 * corner - left - up;
  const int inner = high <= beyond ? low : corner;
  return beyond <= low ? high : inner;
}

/// Some bytes of a filtered row and the same of the row above; the pixel before both of them, 0 at the edge.
template <std::size_t step>
struct Place {
  Byte* row;
  const Byte* up;
  int left[step] = {};
  int corner[step] = {};
};

template <std::size_t step, class Predict>
void undo_pixels(Place<step>& at, std::size_t size, Predict predict) {
  for (const Byte* const end = at.row + size; at.row < end; at.row += step, at.up += step) {
    for (std::size_t c = 0; c < step; ++c) {
      const int above = at.up[c];
      at.left[c] = (at.row[c] + predict(at.left[c], above, at.corner[c])) & 255;
      at.corner[c] = above;
      at.row[c] = static_cast<Byte>(at.left[c]);
    }
  }
}

template <std::size_t step, class Predict>
void undo_each(Byte* row, const Byte* up, std::size_t size, Predict predict) {
  Place<step> at{row, up};
  undo_pixels(at, size, predict);
}

constexpr std::size_t block = 48;  // of whole pixels and whole words

bool is_zero(const Byte* bytes) {
  std::uint64_t words[block / 8], any = 0;
  std::memcpy(words, bytes, block);
  for (const std::uint64_t word : words) any |= word;
  return any == 0;
}

/// Where the pixel before is the one above it, zeros repeat the row above, as they mostly do in rendered
/// pictures.
template <std::size_t step>
void undo_paeth(Byte* row, const Byte* up, std::size_t size) {
  Place<step> at{row, up};
  for (const Byte* const end = row + size; at.row < end;) {
    const auto rest = static_cast<std::size_t>(end - at.row);
    if (rest < block || !is_zero(at.row) || !std::ranges::equal(at.left, at.corner)) {
      undo_pixels(at, std::min(rest, block), [](int l, int a, int c) { return paeth(l, a, c); });
      continue;
    }
    std::memcpy(at.row, at.up, block);
    at.row += block;
    at.up += block;
    for (std::size_t c = 0; c < step; ++c) at.left[c] = at.corner[c] = at.up[c - step];
  }
}

template <std::size_t step>
void undo(Byte filter, Byte* row, const Byte* up, std::size_t size) {
  if (filter == 1) undo_each<step>(row, up, size, [](int left, int, int) { return left; });
  if (filter == 2) {
    for (std::size_t i = 0; i < size; ++i) row[i] = static_cast<Byte>(row[i] + up[i]);
  }
  if (filter == 3)
    undo_each<step>(row, up, size, [](int left, int above, int) { return (left + above) / 2; });
  if (filter == 4) undo_paeth<step>(row, up, size);
}

}  // namespace

bool undo_filters(Byte* bytes, std::size_t size, std::size_t height, std::size_t channels) {
  const std::vector<Byte> black(size);
  const Byte* up = black.data();
  const auto one = channels == 1 ? undo<1> : undo<3>;
  for (std::size_t y = 0; y < height; ++y) {
    Byte* const row = bytes + y * (size + 1);
    if (row[0] > 4) return false;
    one(row[0], row + 1, up, size);
    up = row + 1;
  }
  return true;
}

}  // namespace plumb::codecs
