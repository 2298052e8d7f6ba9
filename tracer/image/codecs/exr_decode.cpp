// OpenEXR of every kind that is not deep: parts, tiles, half floats and whole numbers, all compressions.
#include <algorithm>
#include <cstring>

#include "tracer/image/codecs/codecs.hpp"
#include "tracer/image/codecs/damage.hpp"
#include "tracer/image/codecs/exr_file.hpp"
#include "tracer/image/codecs/exr_layout.hpp"
#include "tracer/image/codecs/half.hpp"

namespace plumb::codecs {
namespace {

struct Corner {
  int x, y;  ///< in the file's coordinates
};

const std::vector<float>& halves() {
  static const auto table = [] {
    std::vector<float> all(std::size_t{1} << 16);
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = float_of_half(static_cast<std::uint16_t>(i));
    return all;
  }();
  return table;
}

double value_at(const std::byte* from, exr_pixel_type_t type) {
  if (type == EXR_PIXEL_HALF) {
    std::uint16_t half = 0;
    std::memcpy(&half, from, sizeof half);
    return static_cast<double>(halves()[half]);
  }
  std::uint32_t bits = 0;
  std::memcpy(&bits, from, sizeof bits);
  return type == EXR_PIXEL_UINT ? static_cast<double>(bits) : static_cast<double>(std::bit_cast<float>(bits));
}

class ExrDecoder {
 public:
  ExrDecoder(const Source& source, exr_const_context_t context, ExrLayout layout, std::byte* pixels)
      : source_(source), context_(context), layout_(std::move(layout)), pixels_(pixels) {}

  void decode() {
    if (layout_.compression == EXR_COMPRESSION_DWAA || layout_.compression == EXR_COMPRESSION_DWAB)
      return decode_by_openexr();
    layout_.storage == EXR_STORAGE_TILED ? decode_tiles() : decode_lines();
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    refuse_damaged(source_.path, "found no whole " + what + " where the header says");
  }

  /// Decodes half floats and floats. It would scale whole numbers of 32 bits.
  void decode_by_openexr() {
    if (source_.read_openexr == nullptr) throw OtherDecoderNeeded{};
    if (layout_.shape.component != Component::float32)
      throw std::runtime_error(source_.path + ": cannot be read: whole numbers with DWA compression aren't " +
                               "supported; write it with ZIP compression");
    const auto channels = static_cast<std::size_t>(layout_.shape.channels);
    const auto width = static_cast<std::size_t>(layout_.data.width);
    std::vector<float> values(width * static_cast<std::size_t>(layout_.data.height) * channels);
    const std::string complaint = source_.read_openexr(source_.file->bytes(), layout_.part, layout_.data,
                                                       layout_.shape.contents.channels, values.data());
    if (!complaint.empty()) refuse_damaged(source_.path, "OpenEXR says: " + complaint);
    const Window& all = *layout_.shape.contents.window;
    for (int y = 0; y < layout_.data.height; ++y) {
      const auto line = static_cast<std::size_t>(layout_.data.y - all.y + y);
      const std::size_t to =
          line * static_cast<std::size_t>(all.width) + static_cast<std::size_t>(layout_.data.x - all.x);
      std::memcpy(pixels_ + to * channels * sizeof(float),
                  &values[static_cast<std::size_t>(y) * width * channels], width * channels * sizeof(float));
    }
  }

  void decode_lines() {
    std::int32_t lines = 0;
    if (exr_get_scanlines_per_chunk(context_, layout_.part, &lines) != EXR_ERR_SUCCESS || lines < 1)
      refuse("picture row");
    for (int y = 0; y < layout_.data.height; y += lines) {
      exr_chunk_info_t info{};
      const std::string name = "picture row " + std::to_string(y);
      const int line = layout_.data.y + y;
      if (exr_read_scanline_chunk_info(context_, layout_.part, line, &info) != EXR_ERR_SUCCESS) refuse(name);
      decode_chunk(info, {layout_.data.x, line}, name);
    }
  }

  void decode_tiles() {
    std::int32_t width = 0, height = 0;
    if (exr_get_tile_sizes(context_, layout_.part, 0, 0, &width, &height) != EXR_ERR_SUCCESS || width < 1 ||
        height < 1)
      refuse("tile");
    for (int y = 0; y * std::int64_t{height} < layout_.data.height; ++y) {
      for (int x = 0; x * std::int64_t{width} < layout_.data.width; ++x) {
        exr_chunk_info_t info{};
        const std::string name = "tile (" + std::to_string(x) + ", " + std::to_string(y) + ")";
        if (exr_read_tile_chunk_info(context_, layout_.part, x, y, 0, 0, &info) != EXR_ERR_SUCCESS)
          refuse(name);
        decode_chunk(info, {layout_.data.x + x * width, layout_.data.y + y * height}, name);
      }
    }
  }

  void decode_chunk(const exr_chunk_info_t& info, Corner corner, const std::string& name) {
    exr_decode_pipeline_t pipeline = EXR_DECODE_PIPELINE_INITIALIZER;
    const bool is_decoded =
        info.unpacked_size <= static_cast<std::uint64_t>(source_.limits.bytes) &&
        exr_decoding_initialize(context_, layout_.part, &info, &pipeline) == EXR_ERR_SUCCESS &&
        static_cast<std::size_t>(pipeline.channel_count) == layout_.channels.size() &&
        give_memory(pipeline) &&
        exr_decoding_choose_default_routines(context_, layout_.part, &pipeline) == EXR_ERR_SUCCESS &&
        exr_decoding_run(context_, layout_.part, &pipeline) == EXR_ERR_SUCCESS;
    for (std::size_t c = 0; is_decoded && c < layout_.channels.size(); ++c)
      put(layout_.channels[c], pipeline.channels[c], corner);
    exr_decoding_destroy(context_, &pipeline);
    if (!is_decoded) refuse(name);
  }

  /// Gives each channel its own memory, in the type of the file. False when the file lies about its size.
  bool give_memory(exr_decode_pipeline_t& pipeline) {
    std::size_t size = 0;
    const auto bytes_of = [](const exr_coding_channel_info_t& c) {
      return static_cast<std::size_t>(c.width) * static_cast<std::size_t>(c.height) *
             static_cast<std::size_t>(c.bytes_per_element);
    };
    for (std::int16_t c = 0; c < pipeline.channel_count; ++c) {
      const exr_coding_channel_info_t& channel = pipeline.channels[c];
      if (channel.width < 0 || channel.height < 0 || channel.bytes_per_element < 1) return false;
      size += bytes_of(channel);
    }
    if (size > static_cast<std::size_t>(source_.limits.bytes)) return false;
    chunk_.assign(size, std::byte{});
    std::byte* at = chunk_.data();
    for (std::int16_t c = 0; c < pipeline.channel_count; ++c) {
      exr_coding_channel_info_t& channel = pipeline.channels[c];
      channel.user_bytes_per_element = channel.bytes_per_element;
      channel.user_data_type = channel.data_type;
      channel.user_pixel_stride = channel.bytes_per_element;
      channel.user_line_stride = channel.bytes_per_element * channel.width;
      channel.decode_to_ptr = reinterpret_cast<std::uint8_t*>(at);
      at += bytes_of(channel);
    }
    return true;
  }

  void put(const ExrChannel& channel, const exr_coding_channel_info_t& decoded, Corner corner) {
    const Shape& shape = layout_.shape;
    const Window& all = *shape.contents.window;
    const std::size_t size = size_of(shape.component),
                      each = static_cast<std::size_t>(decoded.bytes_per_element);
    const auto* from = reinterpret_cast<const std::byte*>(decoded.decode_to_ptr);
    for (int y = 0; y < decoded.height; ++y) {
      for (int x = 0; x < decoded.width; ++x, from += each) {
        const std::int64_t column = std::int64_t{corner.x} + x - all.x,
                           line = std::int64_t{corner.y} + y - all.y;
        if (column < 0 || line < 0 || column >= shape.width || line >= shape.height) continue;
        const auto pixel = static_cast<std::size_t>(line) * static_cast<std::size_t>(shape.width) +
                           static_cast<std::size_t>(column);
        std::byte* const to =
            pixels_ + (pixel * static_cast<std::size_t>(shape.channels) + channel.place) * size;
        const double value = value_at(from, channel.type);
        if (shape.component == Component::float64) {
          std::memcpy(to, &value, sizeof value);
        } else {
          const auto narrow = static_cast<float>(value);
          std::memcpy(to, &narrow, sizeof narrow);
        }
      }
    }
  }

  const Source& source_;
  exr_const_context_t context_;
  ExrLayout layout_;
  std::byte* pixels_;
  std::vector<std::byte> chunk_;
};

}  // namespace

void decode_exr(const Source& source, Canvas& canvas) {
  const ExrFile file(source.file->bytes());
  if (file.get() == nullptr) refuse_damaged(source.path, "found no valid EXR header");
  ExrLayout layout = exr_layout(source, file.get());
  std::byte* const pixels = canvas.rows_for(layout.shape);
  ExrDecoder(source, file.get(), std::move(layout), pixels).decode();
}

}  // namespace plumb::codecs
