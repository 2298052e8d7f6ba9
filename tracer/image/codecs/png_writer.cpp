#include "tracer/image/codecs/png_writer.hpp"

#include <libdeflate.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>
#include <string_view>

namespace plumb::codecs {
namespace {

using Byte = std::uint8_t;

std::string big_endian(std::uint32_t value) {
  value = __builtin_bswap32(value);
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

/// Length, name, data, CRC of name and data.
void append_chunk(std::string& file, std::string_view name, std::string_view data) {
  file += big_endian(static_cast<std::uint32_t>(data.size()));
  const std::size_t start = file.size();
  file += name;
  file += data;
  file += big_endian(libdeflate_crc32(0, file.data() + start, file.size() - start));
}

std::string header(int width, int height) {
  constexpr std::string_view rgb_of_8_bits("\x08\x02\0\0\0", 5);  // not interlaced
  std::string data = big_endian(static_cast<std::uint32_t>(width));
  data += big_endian(static_cast<std::uint32_t>(height));
  return data.append(rgb_of_8_bits);
}

/// What OpenImageIO says of such a picture: sRGB, absolute colorimetric; and, for readers that do not know
/// sRGB, its gamma and its white and primaries, times 100000.
void append_colour_space(std::string& file) {
  append_chunk(file, "gAMA", big_endian(45455));
  append_chunk(file, "sRGB", "\x03");
  std::string places;
  for (const std::uint32_t xy : {31270U, 32900U, 64000U, 33000U, 30000U, 60000U, 15000U, 6000U})
    places += big_endian(xy);
  append_chunk(file, "cHRM", places);
}

/// Uninitialised: most of it is overwritten at once, the rest is never touched.
struct Buffer {
  explicit Buffer(std::size_t room) : bytes(new Byte[room]), size(room) {}
  std::unique_ptr<Byte[]> bytes;
  std::size_t size;
};

/// Each row after filter 0, none: on rendered pictures the others save at most a sixth of the file, and take
/// longer to deflate.
Buffer filtered(std::size_t height, const std::vector<Byte>& rgb) {
  const std::size_t row = rgb.size() / height;
  Buffer rows(rgb.size() + height);
  for (std::size_t y = 0; y < height; ++y) {
    Byte* const out = rows.bytes.get() + y * (row + 1);
    *out = 0;
    std::copy_n(rgb.data() + y * row, row, out + 1);
  }
  return rows;
}

struct Free {
  void operator()(libdeflate_compressor* c) const { libdeflate_free_compressor(c); }
};

/// At the quickest level.
Buffer deflated(const Buffer& data) {
  const std::unique_ptr<libdeflate_compressor, Free> deflater(libdeflate_alloc_compressor(1));
  if (!deflater) throw std::bad_alloc();
  Buffer packed(libdeflate_zlib_compress_bound(deflater.get(), data.size));
  packed.size =
      libdeflate_zlib_compress(deflater.get(), data.bytes.get(), data.size, packed.bytes.get(), packed.size);
  return packed;
}

}  // namespace

std::string write_png(int width, int height, const std::vector<Byte>& rgb) {
  const Buffer packed = deflated(filtered(static_cast<std::size_t>(height), rgb));
  std::string_view rest(reinterpret_cast<const char*>(packed.bytes.get()), packed.size);
  constexpr std::size_t room_for_the_others = 1024,
                        most = std::size_t{1} << 20;  // readers hold a whole chunk
  std::string file = "\x89PNG\r\n\x1a\n";
  file.reserve(packed.size + room_for_the_others);
  append_chunk(file, "IHDR", header(width, height));
  append_colour_space(file);
  for (; !rest.empty(); rest.remove_prefix(std::min(most, rest.size())))
    append_chunk(file, "IDAT", rest.substr(0, most));
  append_chunk(file, "IEND", "");
  return file;
}

}  // namespace plumb::codecs

#pragma GCC diagnostic push
#ifdef __clang__
#pragma GCC diagnostic ignored "-Wreturn-type-c-linkage"  // only called through the type in the header
#endif

extern "C" std::string plumb_codecs_write_png(int width, int height, const std::vector<std::uint8_t>& rgb) {
  return plumb::codecs::write_png(width, height, rgb);
}

#pragma GCC diagnostic pop
