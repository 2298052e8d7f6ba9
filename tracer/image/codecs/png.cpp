// PNG of every kind. libdeflate inflates; libpng with zlib takes three times as long.
#include <libdeflate.h>
#include <sys/mman.h>

#include <cstdint>
#include <cstdlib>
#include <new>

#include "tracer/image/channel_names.hpp"
#include "tracer/image/codecs/codecs.hpp"
#include "tracer/image/codecs/damage.hpp"
#include "tracer/image/codecs/png_filters.hpp"
#include "tracer/image/codecs/png_unpack.hpp"

namespace plumb::codecs {
namespace {

using Byte = std::uint8_t;

void inflate(const Source& source, const Png& png, Byte* bytes, std::size_t size) {
  libdeflate_decompressor* const inflater = libdeflate_alloc_decompressor();
  const auto result =
      libdeflate_zlib_decompress(inflater, png.deflated.data(), png.deflated.size(), bytes, size, nullptr);
  libdeflate_free_decompressor(inflater);
  if (result != LIBDEFLATE_SUCCESS)
    refuse_damaged(source.path, "found pixels (IDAT) that are not the deflated " + std::to_string(size) +
                                    " bytes which the header announces");
}

/// Deflate makes at most 1032 bytes of one, so a lie in the header is seen before memory is asked for.
void expect_plausible(const Source& source, const Png& png, std::size_t size) {
  constexpr std::size_t most_of_one = 1032;
  if (size / most_of_one <= png.deflated.size()) return;
  refuse_damaged(source.path, "found " + std::to_string(png.deflated.size()) +
                                  " bytes of pixels (IDAT), too few for the " + std::to_string(size) +
                                  " bytes which the header announces");
}

/// Returns memory in pages of 2 MiB, if there are any: faults for pages of 4 KiB cost as much as inflating
/// them.
std::shared_ptr<Byte[]> large_pages(std::size_t size) {
  constexpr std::size_t page = std::size_t{1} << 21;
  const std::size_t whole = (size + page - 1) / page * page;
  auto* const bytes = static_cast<Byte*>(std::aligned_alloc(page, whole));
  if (bytes == nullptr) throw std::bad_alloc();
  ::madvise(bytes, whole, MADV_HUGEPAGE);
  return {bytes, [](Byte* p) { std::free(p); }};
}

/// True for components of 8 bits that lie in memory as they are in the file.
bool is_plain(const Png& png) {
  return png.depth == 8 && png.colour != PngColour::palette && !png.is_transparent() && !png.is_interlaced;
}

void look_at(const Source& source, const Png& png, const std::shared_ptr<Byte[]>& bytes, PixelRows& rows) {
  const std::size_t row = png.row_bytes(png.width);
  if (!undo_filters(bytes.get(), row, png.height, png.samples()))
    refuse_damaged(source.path, "found a row with an unknown filter, expected one of 0 to 4");
  rows.stride = static_cast<std::ptrdiff_t>(row + 1);
  rows.top = reinterpret_cast<const std::byte*>(bytes.get()) + 1;
  rows.owner = bytes;
}

}  // namespace

void open_png(const Source& source, PixelRows& rows) {
  const Png png = read_png_chunks(source);
  const std::size_t channels = png.channels();
  source.limits.check(source.path, png.width, png.height,
                      static_cast<std::int64_t>(channels * (png.depth == 16 ? sizeof(float) : 1)));
  const std::size_t size = inflated_bytes(png);
  expect_plausible(source, png, size);
  const std::shared_ptr<Byte[]> bytes = large_pages(size);
  inflate(source, png, bytes.get(), size);
  rows.width = static_cast<int>(png.width);
  rows.height = static_cast<int>(png.height);
  rows.channels = static_cast<int>(channels);
  rows.sample = png.depth == 16 ? Sample::bits16 : Sample::bits8;
  rows.is_bytes = png.depth != 16;
  is_plain(png) ? look_at(source, png, bytes, rows) : unpack_png(source, png, bytes.get(), rows);
  rows.contents.channels = usual_channels(rows.channels);
  if (png.is_animated) rows.contents.not_read.emplace_back("the further frames of an animation (APNG)");
  if (png.has_exif)
    rows.contents.not_read.emplace_back("its Exif data (eXIf), by which viewers may turn the picture");
  if (png.bytes_after != 0)
    rows.contents.not_read.push_back(std::to_string(png.bytes_after) + " bytes after the picture");
}

}  // namespace plumb::codecs
