// Uncompressed float TIFF (TIFF 6.0): libtiff says where the pixels are; they are looked at in place.
#include <libdeflate.h>
#include <tiffio.h>

#include <cstdint>
#include <string_view>

#include "tracer/image/codecs/codecs.hpp"
#include "tracer/image/codecs/damage.hpp"
#include "tracer/image/codecs/tiff_layout.hpp"

namespace plumb::codecs {
namespace {

struct Close {
  void operator()(TIFF* file) const { TIFFClose(file); }
};
using File = std::unique_ptr<TIFF, Close>;

template <class Value>
Value field(TIFF* file, std::uint32_t tag) {
  Value value = 0;
  TIFFGetFieldDefaulted(file, tag, &value);
  return value;
}

/// Without alpha, which OpenImageIO may multiply by, and not from white to black.
bool is_plain_float(TIFF* file) {
  const auto meaning = field<std::uint16_t>(file, TIFFTAG_PHOTOMETRIC);
  const auto channels = field<std::uint16_t>(file, TIFFTAG_SAMPLESPERPIXEL);
  const bool is_known =
      (meaning == PHOTOMETRIC_RGB && channels == 3) || (meaning == PHOTOMETRIC_MINISBLACK && channels == 1);
  return is_known && !TIFFIsTiled(file) && field<std::uint16_t>(file, TIFFTAG_BITSPERSAMPLE) == 32 &&
         field<std::uint16_t>(file, TIFFTAG_SAMPLEFORMAT) == SAMPLEFORMAT_IEEEFP &&
         field<std::uint16_t>(file, TIFFTAG_COMPRESSION) == COMPRESSION_NONE &&
         field<std::uint16_t>(file, TIFFTAG_PLANARCONFIG) == PLANARCONFIG_CONTIG &&
         field<std::uint16_t>(file, TIFFTAG_ORIENTATION) == ORIENTATION_TOPLEFT;
}

/// Strips and tiles, which libtiff numbers alike.
struct Pieces {
  bool is_tiled;
  std::uint32_t count;
  tmsize_t size;  ///< decoded
};

Pieces pieces_of(TIFF* file) {
  if (TIFFIsTiled(file)) return {true, TIFFNumberOfTiles(file), TIFFTileSize(file)};
  return {false, TIFFNumberOfStrips(file), TIFFStripSize(file)};
}

bool is_deflated(TIFF* file) {
  const auto compression = field<std::uint16_t>(file, TIFFTAG_COMPRESSION);
  return (compression == COMPRESSION_ADOBE_DEFLATE || compression == COMPRESSION_DEFLATE) &&
         field<std::uint16_t>(file, TIFFTAG_FILLORDER) == FILLORDER_MSB2LSB;
}

/// libtiff stops when it has all pixels, before the check sum.
bool has_right_sum(TIFF* file, std::uint32_t piece, const Source& source, std::byte* pixels, tmsize_t size) {
  const std::string_view bytes = source.file->bytes();
  const std::uint64_t at = TIFFGetStrileOffset(file, piece), count = TIFFGetStrileByteCount(file, piece);
  if (at > bytes.size() || count > bytes.size() - at) return false;
  libdeflate_decompressor* const inflater = libdeflate_alloc_decompressor();
  std::size_t written = 0;
  const auto result = libdeflate_zlib_decompress(inflater, bytes.data() + at, count, pixels,
                                                 static_cast<std::size_t>(size), &written);
  libdeflate_free_decompressor(inflater);
  return result == LIBDEFLATE_SUCCESS;
}

/// Decodes all pixels and forgets them: OpenImageIO takes what a decoder could make of a broken piece.
void expect_decodable(TIFF* file, const Source& source) {
  const Pieces pieces = pieces_of(file);
  constexpr tmsize_t most = tmsize_t{1} << 32;
  if (pieces.size <= 0 || pieces.size > most) return;  // OpenImageIO says what is wrong
  const auto pixels = std::make_unique_for_overwrite<std::byte[]>(static_cast<std::size_t>(pieces.size));
  const bool has_sums = is_deflated(file);
  for (std::uint32_t i = 0; i < pieces.count; ++i) {
    const tmsize_t decoded = pieces.is_tiled ? TIFFReadEncodedTile(file, i, pixels.get(), pieces.size)
                                             : TIFFReadEncodedStrip(file, i, pixels.get(), pieces.size);
    if (decoded >= 0 && (!has_sums || has_right_sum(file, i, source, pixels.get(), pieces.size))) continue;
    refuse_damaged(source.path, std::string("found a ") + (pieces.is_tiled ? "tile" : "strip") + " (number " +
                                    std::to_string(i) + ") that cannot be decoded");
  }
}

/// The offset of the first pixel when all strips follow one another, else 0.
std::uint64_t first_pixel(TIFF* file, std::uint64_t row_bytes, std::uint32_t height) {
  const std::uint64_t rows = field<std::uint32_t>(file, TIFFTAG_ROWSPERSTRIP);
  const std::uint64_t first = TIFFGetStrileOffset(file, 0);
  for (std::uint32_t strip = 1; strip < TIFFNumberOfStrips(file); ++strip) {
    if (TIFFGetStrileOffset(file, strip) != first + strip * rows * row_bytes) return 0;
  }
  return height == 0 ? 0 : first;
}

}  // namespace

bool open_tiff(const Source& source, PixelRows& rows) {
  if (!is_tiff(source)) return false;
  expect_whole_tiff(source);
  TIFFSetErrorHandler(nullptr);
  TIFFSetWarningHandler(nullptr);
  const File file(TIFFOpen(source.path.c_str(), "r"));
  if (!file) return false;
  const auto compression = field<std::uint16_t>(file.get(), TIFFTAG_COMPRESSION);
  if (compression != COMPRESSION_NONE && TIFFIsCODECConfigured(compression))
    expect_decodable(file.get(), source);
  if (!is_plain_float(file.get())) return false;
  const auto width = field<std::uint32_t>(file.get(), TIFFTAG_IMAGEWIDTH);
  const auto height = field<std::uint32_t>(file.get(), TIFFTAG_IMAGELENGTH);
  const auto channels = field<std::uint16_t>(file.get(), TIFFTAG_SAMPLESPERPIXEL);
  constexpr std::uint32_t most = 1 << 20;
  if (width > most || height > most) return false;
  const std::uint64_t row_bytes = std::uint64_t{width} * channels * sizeof(float);
  const std::uint64_t first = first_pixel(file.get(), row_bytes, height);
  const std::uint64_t size = source.file->bytes().size();
  if (first == 0 || row_bytes * height > size || first > size - row_bytes * height) return false;
  rows.width = static_cast<int>(width);
  rows.height = static_cast<int>(height);
  rows.channels = channels;
  rows.is_big_endian = TIFFIsBigEndian(file.get()) != 0;
  rows.stride = static_cast<std::ptrdiff_t>(row_bytes);
  rows.top = reinterpret_cast<const std::byte*>(source.file->bytes().data()) + first;
  rows.owner = source.file;
  return true;
}

}  // namespace plumb::codecs
