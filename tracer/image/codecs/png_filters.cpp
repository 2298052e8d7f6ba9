#include "tracer/image/codecs/png_filters.hpp"

#include <emmintrin.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace plumb::codecs {
namespace {

using Byte = std::uint8_t;

/// For the filters that add the left pixel (2) or its mean with the upper one (3); both are 0 before the
/// first.
template <std::size_t step, class Predict>
void undo_each(Byte* row, const Byte* up, std::size_t size, Predict predict) {
  int left[step] = {};
  for (std::size_t x = 0; x < size; x += step) {
    for (std::size_t c = 0; c < step; ++c) {
      left[c] = (row[x + c] + predict(left[c], int{up[x + c]})) & 255;
      row[x + c] = static_cast<Byte>(left[c]);
    }
  }
}

/// The components of one pixel, 16 bits each; what is behind them does not matter. Every x86-64 has SSE2, for
/// which Highway's headers have no vectors.
using V = __m128i;

V choose(V mask, V yes, V no) { return _mm_or_si128(_mm_and_si128(mask, yes), _mm_andnot_si128(mask, no)); }

/// PNG, section 9.4: returns that of the three which is nearest to left + up - corner. It is the smaller one,
/// the corner or the larger one; asked this way, there is no branch.
V paeth(V left, V up, V corner) {
  const V low = _mm_min_epi16(left, up), high = _mm_max_epi16(left, up);
  const V thrice = _mm_add_epi16(_mm_add_epi16(corner, corner), corner);
  const V beyond = _mm_sub_epi16(_mm_sub_epi16(thrice, up), left);
  const V inner = choose(_mm_cmpgt_epi16(high, beyond), corner, low);
  return choose(_mm_cmpgt_epi16(beyond, low), inner, high);
}

/// Loads `bytes` bytes, the first of which may be a pixel's.
template <std::size_t bytes>
V load(const Byte* from) {
  // Takes one load, or puts bytes together in registers: a load of bytes that were just written would wait
  // for them.
  std::uint32_t packed = 0;
  if constexpr (bytes == sizeof packed) {
    std::memcpy(&packed, from, sizeof packed);
  } else {
    for (std::size_t c = 0; c < bytes; ++c) packed |= std::uint32_t{from[c]} << (8 * c);
  }
  return _mm_unpacklo_epi8(_mm_cvtsi32_si128(static_cast<int>(packed)), _mm_setzero_si128());
}

template <std::size_t step>
void store(V pixel, Byte* to) {
  const int bytes = _mm_cvtsi128_si32(_mm_packus_epi16(pixel, pixel));
  for (std::size_t c = 0; c < step; ++c) to[c] = static_cast<Byte>(bytes >> (8 * c));
}

/// A place in a filtered row and in the row above, and the pixels before both of them, 0 at the edge.
struct Place {
  Byte* row;
  const Byte* up;
  V left = _mm_setzero_si128();
  V corner = _mm_setzero_si128();
};

/// Pixels of `step` bytes, of which `loaded` are read.
template <std::size_t step, std::size_t loaded>
void undo_pixels(Place& at, std::size_t size) {
  const V low_bytes = _mm_set1_epi16(255);
  for (const Byte* const end = at.row + size; at.row < end; at.row += step, at.up += step) {
    const V above = load<loaded>(at.up);
    const V sum = _mm_add_epi16(load<loaded>(at.row), paeth(at.left, above, at.corner));
    at.left = _mm_and_si128(sum, low_bytes);
    at.corner = above;
    store<step>(at.left, at.row);
  }
}

template <std::size_t step>
void undo_some(Place& at, std::size_t rest) {
  constexpr std::size_t some = 8 * step, most_loaded = 4;
  if (rest < some + most_loaded) return undo_pixels<step, step>(at, std::min(rest, some));
  undo_pixels<step, most_loaded>(at, some);
}

constexpr std::size_t block = 48;  // of whole pixels and whole vectors

bool is_zero(const Byte* bytes) {
  V any = _mm_setzero_si128();
  for (std::size_t i = 0; i < block; i += sizeof any)
    any = _mm_or_si128(any, _mm_loadu_si128(reinterpret_cast<const V*>(bytes + i)));
  return _mm_movemask_epi8(_mm_cmpeq_epi8(any, _mm_setzero_si128())) == 0xffff;
}

template <std::size_t step>
bool is_same(V a, V b) {
  constexpr int all = (1 << (2 * step)) - 1;
  return (_mm_movemask_epi8(_mm_cmpeq_epi16(a, b)) & all) == all;
}

/// Where the pixel before equals the one above it, zeros repeat the row above, as they mostly do in rendered
/// pictures.
template <std::size_t step>
void undo_paeth(Byte* row, const Byte* up, std::size_t size) {
  Place at{row, up};
  for (const Byte* const end = row + size; at.row < end;) {
    const auto rest = static_cast<std::size_t>(end - at.row);
    if (rest < block || !is_zero(at.row) || !is_same<step>(at.left, at.corner)) {
      undo_some<step>(at, rest);
      continue;
    }
    std::memcpy(at.row, at.up, block);
    at.row += block;
    at.up += block;
    at.left = at.corner = load<step>(at.up - step);
  }
}

/// PNG, section 9.4, to the letter, for pixels that fill more than half of a register.
template <std::size_t step>
void undo_wide_paeth(Byte* row, const Byte* up, std::size_t size) {
  for (std::size_t x = 0; x < size; ++x) {
    const int left = x < step ? 0 : row[x - step], above = up[x], corner = x < step ? 0 : up[x - step];
    const int p = left + above - corner;
    const int from_left = std::abs(p - left), from_above = std::abs(p - above),
              from_corner = std::abs(p - corner);
    const int nearest = from_left <= from_above && from_left <= from_corner ? left
                        : from_above <= from_corner                         ? above
                                                                            : corner;
    row[x] = static_cast<Byte>(row[x] + nearest);
  }
}

template <std::size_t step>
void undo(Byte filter, Byte* row, const Byte* up, std::size_t size) {
  if (filter == 1) undo_each<step>(row, up, size, [](int left, int) { return left; });
  if (filter == 2) {
    for (std::size_t i = 0; i < size; ++i) row[i] = static_cast<Byte>(row[i] + up[i]);
  }
  if (filter == 3) undo_each<step>(row, up, size, [](int left, int above) { return (left + above) / 2; });
  if (filter != 4) return;
  if constexpr (step <= 4) {
    undo_paeth<step>(row, up, size);
  } else {
    undo_wide_paeth<step>(row, up, size);
  }
}

using Undo = void (*)(Byte filter, Byte* row, const Byte* up, std::size_t size);

Undo undo_for(std::size_t step) {
  switch (step) {
    case 1:
      return undo<1>;
    case 2:
      return undo<2>;
    case 3:
      return undo<3>;
    case 4:
      return undo<4>;
    case 6:
      return undo<6>;
    default:
      return undo<8>;
  }
}

}  // namespace

bool undo_filters(Byte* bytes, std::size_t size, std::size_t height, std::size_t step) {
  const std::vector<Byte> black(size);
  const Byte* up = black.data();
  const Undo one = undo_for(step);
  for (std::size_t y = 0; y < height; ++y) {
    Byte* const row = bytes + y * (size + 1);
    if (row[0] > 4) return false;
    one(row[0], row + 1, up, size);
    up = row + 1;
  }
  return true;
}

}  // namespace plumb::codecs
