// Uncompressed float TIFF (TIFF 6.0): libtiff says where the pixels are; they are looked at in place.
#include <cstdint>
#include <string_view>

#include "tracer/image/channel_names.hpp"
#include "tracer/image/codecs/codecs.hpp"
#include "tracer/image/codecs/tiff_file.hpp"
#include "tracer/image/codecs/tiff_layout.hpp"

namespace plumb::codecs {
namespace {

/// True for floats without alpha, of which 0 is black.
bool is_plain_float(const TiffFile& file) {
  const auto meaning = file.field<std::uint16_t>(TIFFTAG_PHOTOMETRIC);
  const auto channels = file.field<std::uint16_t>(TIFFTAG_SAMPLESPERPIXEL);
  const bool is_known =
      (meaning == PHOTOMETRIC_RGB && channels == 3) || (meaning == PHOTOMETRIC_MINISBLACK && channels == 1);
  return is_known && !TIFFIsTiled(file.get()) && file.field<std::uint16_t>(TIFFTAG_BITSPERSAMPLE) == 32 &&
         file.field<std::uint16_t>(TIFFTAG_SAMPLEFORMAT) == SAMPLEFORMAT_IEEEFP &&
         file.field<std::uint16_t>(TIFFTAG_COMPRESSION) == COMPRESSION_NONE &&
         file.field<std::uint16_t>(TIFFTAG_PLANARCONFIG) == PLANARCONFIG_CONTIG &&
         file.field<std::uint16_t>(TIFFTAG_ORIENTATION) == ORIENTATION_TOPLEFT;
}

/// The offset of the first pixel when all strips follow one another, else 0.
std::uint64_t first_pixel(const TiffFile& file, std::uint64_t row_bytes, std::uint32_t height) {
  const std::uint64_t rows = file.field<std::uint32_t>(TIFFTAG_ROWSPERSTRIP);
  const std::uint64_t first = TIFFGetStrileOffset(file.get(), 0);
  for (std::uint32_t strip = 1; strip < TIFFNumberOfStrips(file.get()); ++strip) {
    if (TIFFGetStrileOffset(file.get(), strip) != first + strip * rows * row_bytes) return 0;
  }
  return height == 0 ? 0 : first;
}

}  // namespace

bool open_tiff(const Source& source, PixelRows& rows) {
  expect_whole_tiff(source);
  const TiffFile file(source.file->bytes());
  if (file.get() == nullptr) return false;
  choose_page(source, file, rows.contents);
  if (!is_plain_float(file)) return false;
  const auto width = file.field<std::uint32_t>(TIFFTAG_IMAGEWIDTH);
  const auto height = file.field<std::uint32_t>(TIFFTAG_IMAGELENGTH);
  const auto channels = file.field<std::uint16_t>(TIFFTAG_SAMPLESPERPIXEL);
  source.limits.check(source.path, width, height, 0);
  const std::uint64_t row_bytes = std::uint64_t{width} * channels * sizeof(float);
  const std::uint64_t first = first_pixel(file, row_bytes, height);
  const std::uint64_t size = source.file->bytes().size();
  if (first == 0 || row_bytes * height > size || first > size - row_bytes * height) return false;
  rows.width = static_cast<int>(width);
  rows.height = static_cast<int>(height);
  rows.channels = channels;
  rows.contents.channels = usual_channels(channels);
  rows.is_big_endian = TIFFIsBigEndian(file.get()) != 0;
  rows.stride = static_cast<std::ptrdiff_t>(row_bytes);
  rows.top = reinterpret_cast<const std::byte*>(source.file->bytes().data()) + first;
  rows.owner = source.file;
  return true;
}

}  // namespace plumb::codecs
