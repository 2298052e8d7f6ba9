// TIFF of every kind that libtiff decodes to samples: strips and tiles, compressed or not, 1 to 64 bits.
#include <libdeflate.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "tracer/image/codecs/codecs.hpp"
#include "tracer/image/codecs/damage.hpp"
#include "tracer/image/codecs/tiff_layout.hpp"
#include "tracer/image/codecs/tiff_samples.hpp"

namespace plumb::codecs {
namespace {

/// A strip or a tile, which libtiff numbers alike.
struct Piece {
  std::uint32_t number;
  std::size_t x, y;           ///< its first pixel
  std::size_t width, height;  ///< as it is decoded
  std::size_t plane;          ///< the sample that it holds, if it does not hold all
};

class TiffDecoder {
 public:
  TiffDecoder(const Source& source, const TiffFile& file, const TiffLayout& layout, std::byte* pixels)
      : source_(source),
        file_(file),
        layout_(layout),
        pixels_(pixels),
        is_tiled_(TIFFIsTiled(file.get()) != 0) {
    const auto width = static_cast<std::uint32_t>(layout.shape.width);
    const auto height = static_cast<std::uint32_t>(layout.shape.height);
    width_ = is_tiled_ ? file.field<std::uint32_t>(TIFFTAG_TILEWIDTH) : width;
    height_ = is_tiled_ ? file.field<std::uint32_t>(TIFFTAG_TILELENGTH)
                        : std::min(height, file.field<std::uint32_t>(TIFFTAG_ROWSPERSTRIP));
    const auto compression = file.field<std::uint16_t>(TIFFTAG_COMPRESSION);
    has_sums_ = (compression == COMPRESSION_ADOBE_DEFLATE || compression == COMPRESSION_DEFLATE) &&
                file.field<std::uint16_t>(TIFFTAG_FILLORDER) == FILLORDER_MSB2LSB;
  }

  void decode() {
    const tmsize_t size = is_tiled_ ? TIFFTileSize(file_.get()) : TIFFStripSize(file_.get());
    if (width_ == 0 || height_ == 0 || size < 1 || size > source_.limits.bytes)
      refuse_damaged(source_.path, std::string("found ") + (is_tiled_ ? "tiles" : "strips") + " of " +
                                       std::to_string(size) + " bytes");
    decoded_.resize(static_cast<std::size_t>(size));
    const auto across = (static_cast<std::size_t>(layout_.shape.width) + width_ - 1) / width_;
    const auto down = (static_cast<std::size_t>(layout_.shape.height) + height_ - 1) / height_;
    const std::size_t planes = layout_.is_planar ? layout_.samples : 1;
    for (std::size_t i = 0; i < across * down * planes; ++i) {
      const std::size_t in_plane = i % (across * down);
      decode({static_cast<std::uint32_t>(i), in_plane % across * width_, in_plane / across * height_, width_,
              height_, i / (across * down)});
    }
  }

 private:
  void decode(const Piece& piece) {
    const auto rows = std::min(piece.height, static_cast<std::size_t>(layout_.shape.height) - piece.y);
    const std::size_t row = row_bytes();
    const std::size_t size = is_tiled_ ? decoded_.size() : std::min(decoded_.size(), rows * row);
    if (rows * row > decoded_.size() || !is_read(piece, size) || (has_sums_ && !has_right_sum(piece)))
      refuse_damaged(source_.path, std::string("found a ") + (is_tiled_ ? "tile" : "strip") + " (number " +
                                       std::to_string(piece.number) + ") that cannot be decoded");
    for (std::size_t y = 0; y < rows; ++y) put_row(piece, y, decoded_.data() + y * row);
  }

  std::size_t samples_in_piece() const { return layout_.is_planar ? 1 : layout_.samples; }
  std::size_t row_bytes() const { return (width_ * samples_in_piece() * layout_.bits + 7) / 8; }

  bool is_read(const Piece& piece, std::size_t size) {
    const auto wanted = static_cast<tmsize_t>(size);
    const tmsize_t got = is_tiled_ ? TIFFReadEncodedTile(file_.get(), piece.number, decoded_.data(), wanted)
                                   : TIFFReadEncodedStrip(file_.get(), piece.number, decoded_.data(), wanted);
    return got == wanted;
  }

  /// libtiff stops when it has all pixels, before the check sum.
  bool has_right_sum(const Piece& piece) {
    const std::string_view bytes = source_.file->bytes();
    const std::uint64_t at = TIFFGetStrileOffset(file_.get(), piece.number);
    const std::uint64_t count = TIFFGetStrileByteCount(file_.get(), piece.number);
    if (at > bytes.size() || count > bytes.size() - at) return false;
    inflated_.resize(decoded_.size());
    libdeflate_decompressor* const inflater = libdeflate_alloc_decompressor();
    std::size_t written = 0;
    const auto result = libdeflate_zlib_decompress(inflater, bytes.data() + at, count, inflated_.data(),
                                                   inflated_.size(), &written);
    libdeflate_free_decompressor(inflater);
    return result == LIBDEFLATE_SUCCESS;
  }

  void put_row(const Piece& piece, std::size_t y, const std::byte* row) {
    const auto width = static_cast<std::size_t>(layout_.shape.width);
    const std::size_t end = std::min(piece.width, width - piece.x), samples = samples_in_piece();
    const auto channels = static_cast<std::size_t>(layout_.shape.channels);
    for (std::size_t x = 0; x < end; ++x) {
      const std::size_t pixel = ((piece.y + y) * width + piece.x + x) * channels;
      for (std::size_t s = 0; s < samples; ++s) {
        const double value = tiff_sample(layout_, row, x * samples + s);
        if (layout_.meaning == TiffMeaning::palette) {
          for (std::size_t c = 0; c < 3; ++c)
            put(pixel + c, layout_.palette[3 * static_cast<std::size_t>(value) + c]);
        } else {
          put(pixel + (layout_.is_planar ? piece.plane : s), value);
        }
      }
    }
  }

  void put(std::size_t i, double value) {
    std::byte* const to = pixels_ + i * size_of(layout_.shape.component);
    if (layout_.shape.component == Component::byte) {
      *to = static_cast<std::byte>(std::lround(value * 255));
    } else if (layout_.shape.component == Component::float32) {
      const auto narrow = static_cast<float>(value);
      std::memcpy(to, &narrow, sizeof narrow);
    } else {
      std::memcpy(to, &value, sizeof value);
    }
  }

  const Source& source_;
  const TiffFile& file_;
  const TiffLayout& layout_;
  std::byte* pixels_;
  bool is_tiled_;
  bool has_sums_ = false;
  std::size_t width_ = 0;  ///< of a piece
  std::size_t height_ = 0;
  std::vector<std::byte> decoded_;
  std::vector<std::byte> inflated_;
};

}  // namespace

void decode_tiff(const Source& source, Canvas& canvas) {
  expect_whole_tiff(source);
  const TiffFile file(source.file->bytes());
  if (file.get() == nullptr) refuse_damaged(source.path, "found no valid TIFF header");
  FileContents contents;
  choose_page(source, file, contents);
  TiffLayout layout = tiff_layout(source, file);
  if (layout.bits == 32 && layout.format != SAMPLEFORMAT_IEEEFP)
    contents.are_whole.assign(layout.shape.contents.channels.size(), true);
  contents.channels = layout.shape.contents.channels;
  contents.not_read.insert(contents.not_read.end(), layout.shape.contents.not_read.begin(),
                           layout.shape.contents.not_read.end());
  layout.shape.contents = std::move(contents);
  TiffDecoder(source, file, layout, canvas.rows_for(layout.shape)).decode();
}

}  // namespace plumb::codecs
