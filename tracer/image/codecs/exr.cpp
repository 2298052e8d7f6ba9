// Float scanline OpenEXR, uncompressed or ZIP: OpenEXRCore reads the header and finds the chunks.
// Uncompressed ones are looked at in place; the others go through libdeflate, which is faster than zlib.
#include <libdeflate.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "tracer/image/codecs/codecs.hpp"
#include "tracer/image/codecs/damage.hpp"
#include "tracer/image/codecs/exr_file.hpp"

namespace plumb::codecs {
namespace {

class Exr {
 public:
  explicit Exr(const Source& source) : file_(source.file->bytes()), context_(file_.get()) {}

  /// Describes one part of scanlines, all channels float at full resolution; false for anything else.
  bool describe(const Source& source, PixelRows& rows) {
    int parts = 0;
    exr_storage_t storage{};
    exr_attr_box2i_t window{}, display{};
    const exr_attr_chlist_t* channels = nullptr;
    if (context_ == nullptr || exr_get_count(context_, &parts) != 0 || parts != 1) return false;
    if (exr_get_storage(context_, 0, &storage) != 0 || storage != EXR_STORAGE_SCANLINE) return false;
    if (exr_get_data_window(context_, 0, &window) != 0 ||
        exr_get_display_window(context_, 0, &display) != 0 || exr_get_channels(context_, 0, &channels) != 0 ||
        exr_get_compression(context_, 0, &compression_) != 0 ||
        exr_get_scanlines_per_chunk(context_, 0, &lines_) != 0)
      return false;
    const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
    const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
    if (std::memcmp(&window, &display, sizeof window) != 0) return false;
    const bool is_in_place = compression_ == EXR_COMPRESSION_NONE;
    source.limits.check(source.path, width, height,
                        is_in_place ? 0 : std::int64_t{channels->num_channels} * std::int64_t{sizeof(float)});
    rows.width = static_cast<int>(width);
    rows.height = static_cast<int>(height);
    first_line_ = window.min.y;
    rows.contents.window = rows.contents.display =
        Window{window.min.x, window.min.y, rows.width, rows.height};
    return order_channels(*channels, rows);
  }

  bool chunk(int y, exr_chunk_info_t& info) const {
    return exr_read_scanline_chunk_info(context_, 0, first_line_ + y, &info) == EXR_ERR_SUCCESS;
  }
  bool read(const exr_chunk_info_t& info, std::vector<std::byte>& packed) const {
    packed.resize(info.packed_size);
    return exr_read_chunk(context_, 0, &info, packed.data()) == EXR_ERR_SUCCESS;
  }
  int lines() const { return lines_; }
  exr_compression_t compression() const { return compression_; }

 private:
  /// A row holds complete channels in alphabetic order, while people expect R G B A, or Y.
  static bool order_channels(const exr_attr_chlist_t& channels, PixelRows& rows) {
    std::string names;
    for (int c = 0; c < channels.num_channels; ++c) {
      const exr_attr_chlist_entry_t& e = channels.entries[c];
      if (e.pixel_type != EXR_PIXEL_FLOAT || e.x_sampling != 1 || e.y_sampling != 1 || e.name.length != 1)
        return false;
      names += e.name.str[0];
    }
    const std::string wanted = names == "BGR" ? "RGB" : names == "ABGR" ? "RGBA" : names == "Y" ? "Y" : "";
    for (const char name : wanted) {
      rows.contents.channels.emplace_back(1, name);
      rows.planes.push_back(names.find(name) * static_cast<std::size_t>(rows.width) * sizeof(float));
    }
    rows.channels = static_cast<int>(wanted.size());
    rows.stride = static_cast<std::ptrdiff_t>(rows.row_values() * sizeof(float));
    return !wanted.empty();
  }

  ExrFile file_;
  exr_context_t context_;
  exr_compression_t compression_{};
  int lines_ = 1;
  int first_line_ = 0;
};

/// True if the lines lie in the file at equal distances, and so can stay there.
bool in_place(const Exr& exr, const Source& source, PixelRows& rows) {
  exr_chunk_info_t first{}, other{};
  if (!exr.chunk(0, first)) return false;
  const auto line = static_cast<std::uint64_t>(rows.stride);
  constexpr std::uint64_t chunk_head = 8;
  for (int y = 0; y < rows.height; ++y) {
    if (!exr.chunk(y, other) || other.packed_size != line ||
        other.data_offset != first.data_offset + static_cast<std::uint64_t>(y) * (line + chunk_head))
      return false;
  }
  const std::uint64_t size = source.file->bytes().size();
  if (line > size || first.data_offset > other.data_offset || other.data_offset > size - line) return false;
  rows.top = reinterpret_cast<const std::byte*>(source.file->bytes().data()) + first.data_offset;
  rows.stride = static_cast<std::ptrdiff_t>(line + chunk_head);
  rows.owner = source.file;
  return true;
}

/// Undoes what ZIP compression does before deflating: it takes differences of neighbouring bytes, and puts
/// even bytes before odd ones.
void undo_prediction(std::vector<std::uint8_t>& bytes, std::byte* out) {
  for (std::size_t i = 1; i < bytes.size(); ++i)
    bytes[i] = static_cast<std::uint8_t>(bytes[i - 1] + bytes[i] - 128);
  const std::size_t half = (bytes.size() + 1) / 2;
  for (std::size_t i = 0; i < bytes.size() / 2; ++i) {
    out[2 * i] = std::byte{bytes[i]};
    out[2 * i + 1] = std::byte{bytes[half + i]};
  }
}

struct FreeDecompressor {
  void operator()(libdeflate_decompressor* d) const { libdeflate_free_decompressor(d); }
};

[[noreturn]] void refuse(const Source& source, int y) {
  refuse_damaged(source.path, "found no whole picture row " + std::to_string(y) + " where the header says");
}

void inflate(const Exr& exr, const Source& source, PixelRows& rows) {
  const auto line = static_cast<std::size_t>(rows.stride);
  const std::shared_ptr<std::byte[]> pixels(new std::byte[line * static_cast<std::size_t>(rows.height)]);
  const std::unique_ptr<libdeflate_decompressor, FreeDecompressor> inflater(libdeflate_alloc_decompressor());
  std::vector<std::byte> packed;
  std::vector<std::uint8_t> bytes;
  for (int y = 0; y < rows.height; y += exr.lines()) {
    exr_chunk_info_t info{};
    if (!exr.chunk(y, info) || !exr.read(info, packed)) refuse(source, y);
    const auto size = line * static_cast<std::size_t>(std::min(exr.lines(), rows.height - y));
    std::byte* const out = pixels.get() + line * static_cast<std::size_t>(y);
    bytes.resize(size);
    if (packed.size() == size) {  // what would have grown was stored
      std::copy(packed.begin(), packed.end(), out);
      continue;
    }
    if (libdeflate_zlib_decompress(inflater.get(), packed.data(), packed.size(), bytes.data(), size,
                                   nullptr) != LIBDEFLATE_SUCCESS)
      refuse(source, y);
    undo_prediction(bytes, out);
  }
  rows.top = pixels.get();
  rows.owner = pixels;
}

}  // namespace

bool open_exr(const Source& source, PixelRows& rows) {
  if (!source.part.empty()) return false;
  Exr exr(source);
  PixelRows found;
  if (!exr.describe(source, found)) return false;
  const exr_compression_t kind = exr.compression();
  if (kind == EXR_COMPRESSION_ZIP || kind == EXR_COMPRESSION_ZIPS)
    inflate(exr, source, found);
  else if (kind != EXR_COMPRESSION_NONE || !in_place(exr, source, found))
    return false;
  rows = std::move(found);
  return true;
}

}  // namespace plumb::codecs
