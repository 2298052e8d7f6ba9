// Plain PNG (W3C, second edition): 8 bits, grey or RGB, not interlaced, no palette and no
// transparent colour. libdeflate inflates; libpng with zlib takes three times as long.
#include <libdeflate.h>
#include <sys/mman.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string_view>

#include "tracer/image/codecs/codecs.hpp"
#include "tracer/image/codecs/png_filters.hpp"
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
  png.channels = kind == 0 ? 1 : kind == 2 ? 3 : 0;  // OpenImageIO multiplies by alpha
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

bool inflate(const Png& png, Byte* bytes, std::size_t size) {
  libdeflate_decompressor* const inflater = libdeflate_alloc_decompressor();
  const auto result =
      libdeflate_zlib_decompress(inflater, png.deflated.data(), png.deflated.size(), bytes, size, nullptr);
  libdeflate_free_decompressor(inflater);
  return result == LIBDEFLATE_SUCCESS;
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

bool open_png(const std::string& path, PixelRows& rows) {
  Png png;
  {
    const MappedFile file(path);
    if (!read_chunks(file.bytes(), png)) return false;
  }
  const std::size_t row = png.width * png.channels, size = (row + 1) * png.height;
  const std::shared_ptr<Byte[]> bytes = large_pages(size);
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
