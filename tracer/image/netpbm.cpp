#include "tracer/image/netpbm.hpp"

#include <cmath>
#include <cstdint>

#include "tracer/image/netpbm_tokens.hpp"

namespace plumb {
namespace {

std::size_t value_count(const ImageFile& file) {
  return static_cast<std::size_t>(file.width) * static_cast<std::size_t>(file.height) *
         static_cast<std::size_t>(file.channels);
}

/// Checks the size. A compressed picture has its own limit; here the file itself must hold what it promises.
ImageFile sized(NetpbmTokens& tokens, int channels, const std::string& name, const ReadLimits& limits) {
  ImageFile file;
  file.width = tokens.number<int>();
  file.height = tokens.number<int>();
  file.channels = channels;
  limits.check(name, file.width, file.height, 0);
  return file;
}

/// Throws when the text is too short: a value takes at least a digit and a space, a bit only a digit.
void expect_text_for(const NetpbmTokens& tokens, std::size_t values, std::size_t each) {
  if (tokens.rest().size() + 1 < values * each) tokens.fail("it ends too early: the file is truncated");
}

void expect_at_most(const NetpbmTokens& tokens, unsigned value, unsigned most) {
  if (value > most)
    tokens.fail("found value " + std::to_string(value) + ", expected 0 to " + std::to_string(most));
}

/// Reads bits, of which 1 is black. In the binary form each row begins with a new byte.
void read_bits(NetpbmTokens& tokens, bool is_text, ImageFile& file) {
  if (is_text) {
    expect_text_for(tokens, value_count(file), 1);
    for (std::size_t i = 0; i < value_count(file); ++i) file.values.push_back(tokens.bit() ? 0.0F : 1.0F);
    return;
  }
  const auto width = static_cast<std::size_t>(file.width), row = (width + 7) / 8;
  const std::string_view data = tokens.data(row * static_cast<std::size_t>(file.height));
  for (std::size_t i = 0; i < value_count(file); ++i) {
    const auto byte = static_cast<unsigned char>(data[i / width * row + i % width / 8]);
    file.values.push_back((byte >> (7 - i % width % 8) & 1) != 0 ? 0.0F : 1.0F);
  }
}

void read_text(NetpbmTokens& tokens, int most, ImageFile& file) {
  expect_text_for(tokens, value_count(file), 2);
  file.values.reserve(value_count(file));
  for (std::size_t i = 0; i < value_count(file); ++i) {
    const int value = tokens.number<int>();
    if (value < 0)
      tokens.fail("found value " + std::to_string(value) + ", expected 0 to " + std::to_string(most));
    expect_at_most(tokens, static_cast<unsigned>(value), static_cast<unsigned>(most));
    file.values.push_back(static_cast<float>(value) / static_cast<float>(most));
  }
}

void read_bytes(NetpbmTokens& tokens, int most, ImageFile& file) {
  const std::size_t size = most > 255 ? 2 : 1;
  const std::string_view data = tokens.data(value_count(file) * size);
  file.values.reserve(value_count(file));
  for (std::size_t i = 0; i < value_count(file); ++i) {
    unsigned value = static_cast<unsigned char>(data[i * size]);
    if (size == 2) value = value << 8 | static_cast<unsigned char>(data[i * 2 + 1]);
    expect_at_most(tokens, value, static_cast<unsigned>(most));
    file.values.push_back(static_cast<float>(value) / static_cast<float>(most));
  }
}

/// Notes that further pictures follow the first, which Netpbm allows.
void note_rest(const NetpbmTokens& tokens, FileContents& contents) {
  const std::size_t size = tokens.rest().size();
  if (size != 0) contents.not_read.push_back(std::to_string(size) + " bytes after the picture");
}

}  // namespace

PixelRows pfm_rows(std::string_view bytes, const std::string& name, std::shared_ptr<const void> owner,
                   const ReadLimits& limits) {
  NetpbmTokens tokens(bytes, name);
  const std::string_view magic = tokens.word();
  if (magic != "PF" && magic != "Pf") tokens.fail("is no PFM file");
  const ImageFile file = sized(tokens, magic == "PF" ? 3 : 1, name, limits);
  const double scale = tokens.number<double>();
  if (scale == 0 || !std::isfinite(scale)) tokens.fail("its scale is 0 or not finite, expected -1 or 1");
  const std::string_view data = tokens.data(value_count(file) * sizeof(float));
  PixelRows rows;
  rows.width = file.width;
  rows.height = file.height;
  rows.channels = file.channels;
  rows.is_big_endian = scale > 0;
  rows.stride = -static_cast<std::ptrdiff_t>(rows.row_values() * sizeof(float));
  rows.top = reinterpret_cast<const std::byte*>(data.data()) - (file.height - 1) * rows.stride;
  rows.owner = std::move(owner);
  note_rest(tokens, rows.contents);
  return rows;
}

ImageFile from_netpbm(std::string_view bytes, const std::string& name, const ReadLimits& limits) {
  NetpbmTokens tokens(bytes, name);
  const std::string_view magic = tokens.word();
  if (magic.size() != 2 || magic[0] != 'P' || magic[1] < '1' || magic[1] > '6')
    tokens.fail("is no PPM file of type P1 to P6");
  const int type = magic[1] - '0';
  const bool is_text = type <= 3, is_colour = type % 3 == 0;
  ImageFile file = sized(tokens, is_colour ? 3 : 1, name, limits);
  file.contents.channels = usual_channels(file.channels);
  file.sample = Sample::bits8;
  if (type % 3 == 1) {
    read_bits(tokens, is_text, file);
  } else {
    const int most = tokens.number<int>();
    if (most < 1 || most > 65535) tokens.fail("its largest value is out of range");
    if (most > 255) file.sample = Sample::bits16;
    is_text ? read_text(tokens, most, file) : read_bytes(tokens, most, file);
  }
  note_rest(tokens, file.contents);
  return file;
}

}  // namespace plumb
