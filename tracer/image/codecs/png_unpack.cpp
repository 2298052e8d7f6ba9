#include "tracer/image/codecs/png_unpack.hpp"

#include <array>

#include "tracer/image/codecs/damage.hpp"
#include "tracer/image/codecs/png_filters.hpp"

namespace plumb::codecs {
namespace {

using Byte = std::uint8_t;

/// A row's samples as numbers, most significant bit first.
void read_samples(const Png& png, const Byte* row, std::vector<unsigned>& samples) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (png.depth == 16) {
      samples[i] = unsigned{row[2 * i]} << 8 | row[2 * i + 1];
    } else if (png.depth == 8) {
      samples[i] = row[i];
    } else {
      const std::size_t bit = i * png.depth;
      samples[i] = unsigned{row[bit / 8]} >> (8 - png.depth - bit % 8) & ((1U << png.depth) - 1);
    }
  }
}

/// Component values of 8 bits, or of 16 where the file has them.
class Pixels {
 public:
  Pixels(const Source& source, const Png& png) : source_(source), png_(png) {}

  std::array<unsigned, 4> pixel(const unsigned* samples) const {
    return png_.colour == PngColour::palette ? looked_up(samples[0]) : scaled(samples);
  }

 private:
  std::array<unsigned, 4> looked_up(std::size_t index) const {
    if (index >= png_.palette.size() / 3)
      refuse_damaged(source_.path, "found colour " + std::to_string(index) + " of a palette of " +
                                       std::to_string(png_.palette.size() / 3));
    const auto at = [](std::string_view bytes, std::size_t i) -> unsigned {
      return static_cast<unsigned char>(bytes[i]);
    };
    return {at(png_.palette, 3 * index), at(png_.palette, 3 * index + 1), at(png_.palette, 3 * index + 2),
            index < png_.transparency.size() ? at(png_.transparency, index) : 255U};
  }

  std::array<unsigned, 4> scaled(const unsigned* samples) const {
    const std::size_t count = png_.samples();
    // Levels of 1, 2 and 4 bits are multiples of 255, 85 and 17.
    const unsigned factor = png_.depth < 8 ? 255U / ((1U << png_.depth) - 1) : 1U;
    std::array<unsigned, 4> pixel{};
    bool is_key = png_.is_transparent();
    for (std::size_t c = 0; c < count; ++c) {
      pixel[c] = samples[c] * factor;
      is_key = is_key && samples[c] == key(c);
    }
    if (count % 2 == 1) pixel[count] = is_key ? 0U : png_.depth == 16 ? 65535U : 255U;
    return pixel;
  }

  unsigned key(std::size_t c) const {
    return unsigned{static_cast<unsigned char>(png_.transparency[2 * c])} << 8 |
           static_cast<unsigned char>(png_.transparency[2 * c + 1]);
  }

  const Source& source_;
  const Png& png_;
};

void put(unsigned value, Byte* to) { *to = static_cast<Byte>(value); }
void put(unsigned value, float* to) { *to = static_cast<float>(value) / 65535; }

template <class Value>
void unpack(const Source& source, const Png& png, Byte* inflated, Value* values) {
  const Pixels pixels(source, png);
  const std::size_t channels = png.channels();
  const std::size_t step = std::max<std::size_t>(1, png.samples() * png.depth / 8);
  for (const PngPass& pass : passes_of(png)) {
    const std::size_t bytes = png.row_bytes(pass.width);
    if (!undo_filters(inflated, bytes, pass.height, step))
      refuse_damaged(source.path, "found a row with an unknown filter, expected one of 0 to 4");
    std::vector<unsigned> samples(pass.width * png.samples());
    for (std::size_t y = 0; y < pass.height; ++y, inflated += bytes + 1) {
      read_samples(png, inflated + 1, samples);
      for (std::size_t x = 0; x < pass.width; ++x) {
        const auto pixel = pixels.pixel(&samples[x * png.samples()]);
        const std::size_t at = (pass.y + y * pass.step_y) * png.width + pass.x + x * pass.step_x;
        for (std::size_t c = 0; c < channels; ++c) put(pixel[c], values + at * channels + c);
      }
    }
  }
}

template <class Value>
void unpack_to(const Source& source, const Png& png, Byte* inflated, PixelRows& rows) {
  const std::size_t row = png.width * png.channels();
  const std::shared_ptr<Value[]> values(new Value[row * png.height]);
  unpack(source, png, inflated, values.get());
  rows.top = reinterpret_cast<const std::byte*>(values.get());
  rows.stride = static_cast<std::ptrdiff_t>(row * sizeof(Value));
  rows.owner = values;
}

}  // namespace

std::vector<PngPass> passes_of(const Png& png) {
  if (!png.is_interlaced) return {{0, 0, 1, 1, png.width, png.height}};
  // Adam7, section 8.2.
  std::vector<PngPass> passes{{0, 0, 8, 8, 0, 0}, {4, 0, 8, 8, 0, 0}, {0, 4, 4, 8, 0, 0}, {2, 0, 4, 4, 0, 0},
                              {0, 2, 2, 4, 0, 0}, {1, 0, 2, 2, 0, 0}, {0, 1, 1, 2, 0, 0}};
  for (PngPass& pass : passes) {
    pass.width = png.width > pass.x ? (png.width - pass.x + pass.step_x - 1) / pass.step_x : 0;
    pass.height = png.height > pass.y ? (png.height - pass.y + pass.step_y - 1) / pass.step_y : 0;
  }
  std::erase_if(passes, [](const PngPass& pass) { return pass.width == 0 || pass.height == 0; });
  return passes;
}

std::size_t inflated_bytes(const Png& png) {
  std::size_t size = 0;
  for (const PngPass& pass : passes_of(png)) size += (png.row_bytes(pass.width) + 1) * pass.height;
  return size;
}

void unpack_png(const Source& source, const Png& png, std::uint8_t* inflated, PixelRows& rows) {
  png.depth == 16 ? unpack_to<float>(source, png, inflated, rows)
                  : unpack_to<Byte>(source, png, inflated, rows);
}

}  // namespace plumb::codecs
