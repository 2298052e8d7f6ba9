#include "tracer/image/codecs/png_file.hpp"

#include <libdeflate.h>

#include <algorithm>
#include <cctype>
#include <cstring>

#include "tracer/image/codecs/damage.hpp"

namespace plumb::codecs {
namespace {

std::uint32_t number(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return __builtin_bswap32(value);
}

/// Table 11.1: which depths go with which colours.
bool is_known(unsigned colour, unsigned depth) {
  const bool is_deep = depth == 8 || depth == 16;
  if (colour == 0) return is_deep || depth == 1 || depth == 2 || depth == 4;
  if (colour == 3) return depth == 1 || depth == 2 || depth == 4 || depth == 8;
  return is_deep && (colour == 2 || colour == 4 || colour == 6);
}

void read_header(std::string_view data, const Source& source, Png& png) {
  constexpr std::size_t size = 13;
  if (data.size() != size)
    refuse_damaged(source.path,
                   "found a header (IHDR) of " + std::to_string(data.size()) + " bytes, expected 13");
  const auto at = [&](std::size_t i) { return static_cast<unsigned>(static_cast<unsigned char>(data[i])); };
  if (!is_known(at(9), at(8)) || at(10) != 0 || at(11) != 0 || at(12) > 1)
    refuse_damaged(source.path, "found a header (IHDR) of colour type " + std::to_string(at(9)) + " and " +
                                    std::to_string(at(8)) + " bits, which PNG does not have");
  png.width = number(data, 0);
  png.height = number(data, 4);
  png.depth = at(8);
  png.colour = static_cast<PngColour>(at(9));
  png.is_interlaced = at(12) == 1;
}

std::string place(std::string_view name, std::size_t at) {
  const bool is_word = std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalpha(c); });
  return "chunk " + (is_word ? std::string(name) + " " : "") + "at byte " + std::to_string(at);
}

void take_chunk(std::string_view name, std::string_view data, const Source& source, Png& png) {
  if (name == "IHDR") read_header(data, source, png);
  if (name == "PLTE") png.palette = data;
  if (name == "tRNS") png.transparency = data;
  if (name == "acTL") png.is_animated = true;
  if (name == "eXIf") png.has_exif = true;
  if (name == "IDAT") png.deflated += data;
}

void expect_sense(const Source& source, const Png& png) {
  if (png.width == 0 || png.height == 0)
    refuse_damaged(source.path, "found no header (IHDR) with a size of at least 1 x 1");
  if (png.colour == PngColour::palette && (png.palette.empty() || png.palette.size() % 3 != 0))
    refuse_damaged(source.path, "found no palette (PLTE), expected one of whole colours");
  const std::size_t key = 2 * png.samples();
  if (png.is_transparent() && png.colour != PngColour::palette && png.transparency.size() != key)
    refuse_damaged(source.path, "found a transparent colour (tRNS) of " +
                                    std::to_string(png.transparency.size()) + " bytes, expected " +
                                    std::to_string(key));
}

}  // namespace

std::size_t Png::samples() const {
  switch (colour) {
    case PngColour::rgb:
      return 3;
    case PngColour::grey_alpha:
      return 2;
    case PngColour::rgb_alpha:
      return 4;
    default:
      return 1;
  }
}

std::size_t Png::channels() const {
  const std::size_t colours = colour == PngColour::palette ? 3 : samples();
  return colours + (is_transparent() && colours % 2 == 1 ? 1 : 0);
}

Png read_png_chunks(const Source& source) {
  constexpr std::size_t around = 12;  // length, name, CRC
  const std::string_view file = source.file->bytes();
  Png png;
  for (std::size_t at = 8; file.size() - at >= around;) {
    const std::string_view rest = file.substr(at), name = rest.substr(4, 4);
    const std::size_t size = number(rest, 0);
    if (size > rest.size() - around)
      refuse_damaged(source.path, "found " + place(name, at) + " with " + std::to_string(size) +
                                      " bytes, expected at most the " + std::to_string(rest.size() - around) +
                                      " that are left");
    const std::string_view data = rest.substr(8, size);
    if (libdeflate_crc32(0, name.data(), size + 4) != number(rest, 8 + size))
      refuse_damaged(source.path,
                     "found " + place(name, at) + ", whose check sum (CRC) is not that of its data");
    take_chunk(name, data, source, png);
    if (name == "IEND") {
      expect_sense(source, png);
      png.bytes_after = file.size() - at - around;
      return png;
    }
    at += size + around;
  }
  refuse_damaged(source.path, "found no chunk IEND, expected it at the end");
}

}  // namespace plumb::codecs
