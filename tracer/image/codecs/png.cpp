// Plain PNG (W3C, second edition): 8 bits, grey or RGB, not interlaced, no palette and no
// transparent colour. libdeflate inflates; libpng with zlib takes three times as long.
#include <libdeflate.h>
#include <sys/mman.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string_view>

#include "tracer/image/codecs/codecs.hpp"
#include "tracer/image/codecs/damage.hpp"
#include "tracer/image/codecs/png_filters.hpp"

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
  std::size_t channels = 0;  ///< 0: not of the plain kind
  bool is_transparent = false;
  std::string deflated;
};

void read_header(std::string_view data, Png& png) {
  constexpr std::size_t size = 13;
  constexpr std::uint32_t most = 1 << 20;
  if (data.size() != size) return;
  png.width = number(data, 0);
  png.height = number(data, 4);
  const bool is_plain = data[8] == 8 && data.substr(10) == std::string_view("\0\0\0", 3) && png.width > 0 &&
                        png.height > 0 && png.width < most && png.height < most &&
                        std::uint64_t{png.width} * png.height < (std::uint64_t{1} << 28);
  const char kind = data[9];  // OpenImageIO multiplies by alpha
  png.channels = !is_plain ? 0 : kind == 0 ? 1 : kind == 2 ? 3 : 0;
}

std::string place(std::string_view name, std::size_t at) {
  const bool is_word = std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalpha(c); });
  return "chunk " + (is_word ? std::string(name) + " " : "") + "at byte " + std::to_string(at);
}

/// Chunks: length, name, data, CRC of name and data. Of every kind of PNG: what reads the others neither
/// misses the end nor minds a CRC.
Png read_chunks(const Source& source) {
  constexpr std::size_t around = 12;
  const std::string_view file = source.file->bytes();
  Png png;
  for (std::size_t at = 8; file.size() - at >= around;) {
    const std::string_view rest = file.substr(at), name = rest.substr(4, 4);
    const std::size_t size = number(rest, 0);
    if (size > rest.size() - around)
      refuse_damaged(source.path, "found " + place(name, at) + " with " + std::to_string(size) +
                                      " bytes, expected at most the " + std::to_string(rest.size() - around) +
                                      " that are left");
    const std::string_view data = rest.substr(8, size);
    if (libdeflate_crc32(0, name.data(), size + 4) != number(rest, 8 + size))
      refuse_damaged(source.path,
                     "found " + place(name, at) + ", whose check sum (CRC) is not that of its data");
    if (name == "IHDR") read_header(data, png);
    if (name == "tRNS") png.is_transparent = true;
    if (name == "IDAT") png.deflated += data;
    if (name == "IEND") return png;
    at += size + around;
  }
  refuse_damaged(source.path, "found no chunk IEND, expected it at the end");
}

void inflate(const Source& source, const Png& png, Byte* bytes, std::size_t size) {
  libdeflate_decompressor* const inflater = libdeflate_alloc_decompressor();
  const auto result =
      libdeflate_zlib_decompress(inflater, png.deflated.data(), png.deflated.size(), bytes, size, nullptr);
  libdeflate_free_decompressor(inflater);
  if (result != LIBDEFLATE_SUCCESS)
    refuse_damaged(source.path, "found pixels (IDAT) that are not the deflated " + std::to_string(size) +
                                    " bytes which the header announces");
}

/// Memory in pages of 2 MiB where there are any: one fault for each of 4 KiB costs as much as inflating them.
std::shared_ptr<Byte[]> large_pages(std::size_t size) {
  constexpr std::size_t page = std::size_t{1} << 21;
  const std::size_t whole = (size + page - 1) / page * page;
  auto* const bytes = static_cast<Byte*>(std::aligned_alloc(page, whole));
  if (bytes == nullptr) throw std::bad_alloc();
  ::madvise(bytes, whole, MADV_HUGEPAGE);
  return {bytes, [](Byte* p) { std::free(p); }};
}

}  // namespace

bool open_png(const Source& source, PixelRows& rows) {
  if (!source.file->bytes().starts_with("\x89PNG\r\n\x1a\n")) return false;
  const Png png = read_chunks(source);
  if (png.channels == 0 || png.is_transparent) return false;
  const std::size_t row = png.width * png.channels, size = (row + 1) * png.height;
  const std::shared_ptr<Byte[]> bytes = large_pages(size);
  inflate(source, png, bytes.get(), size);
  if (!undo_filters(bytes.get(), row, png.height, png.channels))
    refuse_damaged(source.path, "found a row with an unknown filter, expected one of 0 to 4");
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
