// Uncompressed float TIFF (TIFF 6.0): libtiff says where the pixels are; they are looked at in place.
#include <tiffio.h>

#include <cstdint>

#include "tracer/image/codecs/codecs.hpp"
#include "tracer/image/mapped_file.hpp"

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

bool open_tiff(const std::string& path, PixelRows& rows) {
  TIFFSetErrorHandler(nullptr);
  TIFFSetWarningHandler(nullptr);
  const File file(TIFFOpen(path.c_str(), "r"));
  if (!file || !is_plain_float(file.get())) return false;
  const auto width = field<std::uint32_t>(file.get(), TIFFTAG_IMAGEWIDTH);
  const auto height = field<std::uint32_t>(file.get(), TIFFTAG_IMAGELENGTH);
  const auto channels = field<std::uint16_t>(file.get(), TIFFTAG_SAMPLESPERPIXEL);
  constexpr std::uint32_t most = 1 << 20;
  if (width > most || height > most) return false;
  const std::uint64_t row_bytes = std::uint64_t{width} * channels * sizeof(float);
  const std::uint64_t first = first_pixel(file.get(), row_bytes, height);
  const auto mapped = std::make_shared<const MappedFile>(path);
  const std::uint64_t size = mapped->bytes().size();
  if (first == 0 || row_bytes * height > size || first > size - row_bytes * height) return false;
  rows.width = static_cast<int>(width);
  rows.height = static_cast<int>(height);
  rows.channels = channels;
  rows.is_big_endian = TIFFIsBigEndian(file.get()) != 0;
  rows.stride = static_cast<std::ptrdiff_t>(row_bytes);
  rows.top = reinterpret_cast<const std::byte*>(mapped->bytes().data()) + first;
  rows.owner = mapped;
  return true;
}

}  // namespace plumb::codecs
