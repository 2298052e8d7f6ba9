#include "tracer/image/codecs/png_writer.hpp"

#include <libdeflate.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>
#include <string>
#include <string_view>

#include "tracer/image/codecs/deflater.hpp"

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

/// Appends what OpenImageIO says of such a picture: sRGB, absolute colorimetric. For readers that do not know
/// sRGB it adds gamma, white and primaries, times 100000.
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

/// Puts filter 0, none, before each row. On rendered pictures other filters save at most a sixth of the file,
/// and take longer to deflate.
Buffer filtered(std::span<const Byte> rgb, std::size_t row) {
  const std::size_t height = rgb.size() / row;
  Buffer rows(rgb.size() + height);
  for (std::size_t y = 0; y < height; ++y) {
    Byte* const out = rows.bytes.get() + y * (row + 1);
    *out = 0;
    std::copy_n(rgb.data() + y * row, row, out + 1);
  }
  return rows;
}

struct FreeCompressor {
  void operator()(libdeflate_compressor* c) const { libdeflate_free_compressor(c); }
};

/// At the quickest level.
Buffer deflated(const Buffer& data) {
  const std::unique_ptr<libdeflate_compressor, FreeCompressor> deflater(libdeflate_alloc_compressor(1));
  if (!deflater) throw std::bad_alloc();
  Buffer packed(libdeflate_zlib_compress_bound(deflater.get(), data.size));
  packed.size =
      libdeflate_zlib_compress(deflater.get(), data.bytes.get(), data.size, packed.bytes.get(), packed.size);
  return packed;
}

/// Deflates a picture that comes at once with libdeflate, one in bands with zlib.
class PngWriter final : public RowWriter<Byte> {
 public:
  PngWriter(ByteSink& file, int width, int height)
      : file_(file), row_(3 * static_cast<std::size_t>(width)), height_(static_cast<std::size_t>(height)) {
    chunks_ = "\x89PNG\r\n\x1a\n";
    append_chunk(chunks_, "IHDR", header(width, height));
    append_colour_space(chunks_);
  }
  void write(std::span<const Byte> rows) override {
    const Buffer data = filtered(rows, row_);
    if (rows.size() == row_ * height_) {
      const Buffer packed = deflated(data);
      append_data({reinterpret_cast<const char*>(packed.bytes.get()), packed.size});
    } else {
      if (!deflater_) deflater_ = std::make_unique<Deflater>();
      deflater_->add({data.bytes.get(), data.size}, packed_);
      const std::size_t whole_chunks = packed_.size() - packed_.size() % chunk_size;
      append_data(std::string_view(packed_).substr(0, whole_chunks));
      packed_.erase(0, whole_chunks);
    }
    pass_on();
  }
  void finish() override {
    if (deflater_) deflater_->finish(packed_);
    append_data(packed_);
    append_chunk(chunks_, "IEND", "");
    pass_on();
  }

 private:
  static constexpr std::size_t chunk_size = std::size_t{1} << 20;  // readers hold a whole chunk

  void append_data(std::string_view packed) {
    constexpr std::size_t room_for_the_others = 1024;
    chunks_.reserve(chunks_.size() + packed.size() + packed.size() / 1024 + room_for_the_others);
    for (; !packed.empty(); packed.remove_prefix(std::min(chunk_size, packed.size())))
      append_chunk(chunks_, "IDAT", packed.substr(0, chunk_size));
  }
  void pass_on() {
    file_.write(chunks_);
    chunks_.clear();
  }

  ByteSink& file_;
  std::size_t row_, height_;  ///< bytes, rows
  std::string chunks_;        ///< to be written
  std::unique_ptr<Deflater> deflater_;
  std::string packed_;  ///< deflated, but no chunk yet
};

}  // namespace
}  // namespace plumb::codecs

#pragma GCC diagnostic push
#ifdef __clang__
#pragma GCC diagnostic ignored "-Wreturn-type-c-linkage"  // only called through the type in the header
#endif

extern "C" std::unique_ptr<plumb::RowWriter<std::uint8_t>> plumb_codecs_write_png(plumb::ByteSink& file,
                                                                                  int width, int height) {
  return std::make_unique<plumb::codecs::PngWriter>(file, width, height);
}

#pragma GCC diagnostic pop
