// Plain PNG (W3C, second edition): 8 bits, grey, RGB or with alpha, not interlaced, no palette and no
// transparent colour. libdeflate inflates; libpng with zlib takes three times as long.
#include <libdeflate.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "tracer/image/codecs/codecs.hpp"
#include "tracer/image/mapped_file.hpp"

namespace plumb::codecs {
namespace {

using Byte = std::uint8_t;

std::uint32_t number(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return __builtin_bswap32(value);
}

struct Png {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::size_t channels = 0;
  std::string deflated;
};

bool read_header(std::string_view data, Png& png) {
  constexpr std::size_t size = 13;
  constexpr std::uint32_t most = 1 << 20;
  if (data.size() != size) return false;
  png.width = number(data, 0);
  png.height = number(data, 4);
  const char kind = data[9];
  png.channels = kind == 0 ? 1 : kind == 2 ? 3 : kind == 4 ? 2 : kind == 6 ? 4 : 0;
  return data[8] == 8 && png.channels != 0 && data.substr(10) == std::string_view("\0\0\0", 3) &&
         png.width > 0 && png.height > 0 && png.width < most && png.height < most &&
         std::uint64_t{png.width} * png.height < (std::uint64_t{1} << 28);
}

/// Chunks: length, name, data, CRC of name and data.
bool read_chunks(std::string_view bytes, Png& png) {
  constexpr std::size_t around = 12;
  if (!bytes.starts_with("\x89PNG\r\n\x1a\n")) return false;
  for (bytes.remove_prefix(8); bytes.size() >= around;) {
    const std::size_t size = number(bytes, 0);
    if (size > bytes.size() - around) return false;
    const std::string_view name = bytes.substr(4, 4), data = bytes.substr(8, size);
    if (libdeflate_crc32(0, name.data(), size + 4) != number(bytes, 8 + size)) return false;
    if (name == "IHDR" && !read_header(data, png)) return false;
    if (name == "tRNS") return false;
    if (name == "IDAT") png.deflated += data;
    if (name == "IEND") return png.channels != 0;
    bytes.remove_prefix(size + around);
  }
  return false;
}

Byte paeth(int left, int up, int corner) {
  const int a = std::abs(up - corner), b = std::abs(left - corner), c = std::abs(left + up - 2 * corner);
  const int nearer = b <= c ? up : corner;
  return static_cast<Byte>(a <= b && a <= c ? left : nearer);
}

/// `row` holds filtered bytes; `up` the row above. `step` bytes a pixel, known to the compiler.
template <std::size_t step>
void undo(Byte filter, Byte* row, const Byte* up, std::size_t size) {
  const auto each = [&](auto predicted) {
    for (std::size_t i = 0; i < step; ++i) row[i] = static_cast<Byte>(row[i] + predicted(0, up[i], 0));
    for (std::size_t i = step; i < size; ++i)
      row[i] = static_cast<Byte>(row[i] + predicted(row[i - step], up[i], up[i - step]));
  };
  if (filter == 1) each([](int left, int, int) { return left; });
  if (filter == 2) each([](int, int above, int) { return above; });
  if (filter == 3) each([](int left, int above, int) { return (left + above) / 2; });
  if (filter == 4) each([](int left, int above, int corner) { return paeth(left, above, corner); });
}

bool undo_filters(Byte* bytes, std::size_t size, std::size_t height, std::size_t channels) {
  const std::vector<Byte> black(size);
  const Byte* up = black.data();
  const auto one = channels == 1 ? undo<1> : channels == 2 ? undo<2> : channels == 3 ? undo<3> : undo<4>;
  for (std::size_t y = 0; y < height; ++y) {
    Byte* const row = bytes + y * (size + 1);
    if (row[0] > 4) return false;
    one(row[0], row + 1, up, size);
    up = row + 1;
  }
  return true;
}

bool inflate(const Png& png, Byte* bytes, std::size_t size) {
  libdeflate_decompressor* const inflater = libdeflate_alloc_decompressor();
  const auto result =
      libdeflate_zlib_decompress(inflater, png.deflated.data(), png.deflated.size(), bytes, size, nullptr);
  libdeflate_free_decompressor(inflater);
  return result == LIBDEFLATE_SUCCESS;
}

}  // namespace

bool open_png(const std::string& path, PixelRows& rows) {
  Png png;
  {
    const MappedFile file(path);
    if (!read_chunks(file.bytes(), png)) return false;
  }
  const std::size_t row = png.width * png.channels, size = (row + 1) * png.height;
  const std::shared_ptr<Byte[]> bytes(new Byte[size]);
  if (!inflate(png, bytes.get(), size) || !undo_filters(bytes.get(), row, png.height, png.channels))
    return false;
  rows.width = static_cast<int>(png.width);
  rows.height = static_cast<int>(png.height);
  rows.channels = static_cast<int>(png.channels);
  rows.sample = Sample::bits8;
  rows.is_bytes = true;
  rows.stride = static_cast<std::ptrdiff_t>(row + 1);
  rows.top = reinterpret_cast<const std::byte*>(bytes.get()) + 1;
  rows.owner = bytes;
  return true;
}

}  // namespace plumb::codecs
