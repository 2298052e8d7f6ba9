// Undoing the filters of PNG: what section 9 of the specification says, applied to pictures, is taken back.
#include "tracer/image/codecs/png_filters.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <random>
#include <vector>

namespace plumb::codecs {
namespace {

using Bytes = std::vector<std::uint8_t>;

struct Picture {
  std::size_t size, height, channels;  // `size` bytes a row
  Bytes bytes;

  int at(std::size_t y, std::size_t i) const { return bytes[y * size + i]; }
};

/// As the specification has it, with its order of ties.
int paeth(int a, int b, int c) {
  const int p = a + b - c, pa = std::abs(p - a), pb = std::abs(p - b), pc = std::abs(p - c);
  if (pa <= pb && pa <= pc) return a;
  return pb <= pc ? b : c;
}

int predicted(int filter, int left, int up, int corner) {
  if (filter == 1) return left;
  if (filter == 2) return up;
  if (filter == 3) return (left + up) / 2;
  return filter == 4 ? paeth(left, up, corner) : 0;
}

Bytes filtered(const Picture& p, const std::function<int(std::size_t)>& filter_of_row) {
  Bytes out;
  for (std::size_t y = 0; y < p.height; ++y) {
    const int filter = filter_of_row(y);
    out.push_back(static_cast<std::uint8_t>(filter));
    for (std::size_t i = 0; i < p.size; ++i) {
      const bool has_left = i >= p.channels;
      const int left = has_left ? p.at(y, i - p.channels) : 0, up = y > 0 ? p.at(y - 1, i) : 0;
      const int corner = has_left && y > 0 ? p.at(y - 1, i - p.channels) : 0;
      out.push_back(static_cast<std::uint8_t>(p.at(y, i) - predicted(filter, left, up, corner)));
    }
  }
  return out;
}

void expect_restored(const Picture& p, const std::function<int(std::size_t)>& filter_of_row) {
  Bytes bytes = filtered(p, filter_of_row);
  ASSERT_TRUE(undo_filters(bytes.data(), p.size, p.height, p.channels));
  for (std::size_t y = 0; y < p.height; ++y) {
    for (std::size_t i = 0; i < p.size; ++i)
      ASSERT_EQ(bytes[y * (p.size + 1) + 1 + i], p.at(y, i)) << "row " << y << ", byte " << i;
  }
}

/// Runs of `run` equal pixels, in `run` equal rows; levels 0 .. `levels` - 1.
Picture random_picture(std::mt19937& random, std::size_t width, std::size_t channels, std::size_t run,
                       unsigned levels) {
  Picture p{width * channels, 24, channels, {}};
  const auto level = [&] { return static_cast<std::uint8_t>(random() % levels); };
  for (std::size_t y = 0; y < p.height; ++y) {
    for (std::size_t i = 0; i < p.size; ++i) {
      const std::size_t here = p.bytes.size(), x = i / channels;
      p.bytes.push_back(y % run != 0   ? p.bytes[here - p.size]
                        : x % run != 0 ? p.bytes[here - channels]
                                       : level());
    }
  }
  return p;
}

TEST(PngFilters, EveryFilterIsUndoneOnNoiseAndOnFlatPictures) {
  std::mt19937 random(1);
  for (const std::size_t channels : {1U, 3U}) {
    for (const std::size_t width : {1U, 2U, 15U, 16U, 17U, 48U, 131U}) {
      for (const std::size_t run : {1U, 5U, 40U}) {
        for (const unsigned levels : {1U, 2U, 256U}) {
          const Picture p = random_picture(random, width, channels, run, levels);
          for (int filter = 0; filter <= 4; ++filter) expect_restored(p, [&](std::size_t) { return filter; });
          expect_restored(p, [](std::size_t y) { return static_cast<int>(y * 7 % 5); });
        }
      }
    }
  }
}

/// In steps of 5, which meet at every kind of tie. Four pixels: (corner, up) over (left, any).
TEST(PngFilters, PaethChoosesAsTheSpecificationDoes) {
  for (int corner = 0; corner < 256; corner += 5) {
    Picture p{2, 2, 1, {static_cast<std::uint8_t>(corner), 0, 0, 77}};
    for (int up = 0; up < 256; up += 5) {
      for (int left = 0; left < 256; left += 5) {
        p.bytes[1] = static_cast<std::uint8_t>(up);
        p.bytes[2] = static_cast<std::uint8_t>(left);
        Bytes bytes = filtered(p, [](std::size_t) { return 4; });
        ASSERT_TRUE(undo_filters(bytes.data(), 2, 2, 1));
        ASSERT_EQ(bytes.back(), 77) << left << ' ' << up << ' ' << corner;
      }
    }
  }
}

TEST(PngFilters, ThereIsNoFifthFilter) {
  Bytes bytes{0, 1, 2, 3, 5, 1, 2, 3};
  EXPECT_FALSE(undo_filters(bytes.data(), 3, 2, 3));
}

/// What stands behind the last row belongs to others.
TEST(PngFilters, NothingBehindTheLastRowIsTouched) {
  for (std::uint8_t filter = 0; filter <= 4; ++filter) {
    for (std::size_t pixels = 1; pixels < 40; ++pixels) {
      Bytes bytes(1 + 3 * pixels, 0);
      bytes[0] = filter;
      bytes.resize(bytes.size() + 64, 200);
      ASSERT_TRUE(undo_filters(bytes.data(), 3 * pixels, 1, 3));
      for (std::size_t i = 0; i < 64; ++i) ASSERT_EQ(bytes[1 + 3 * pixels + i], 200);
    }
  }
}

}  // namespace
}  // namespace plumb::codecs
