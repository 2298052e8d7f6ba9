// Small image files, byte by byte, that hold what the program's own writers do not: alpha, windows, parts.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace plumb::tests {

/// PNG (W3C). Rows of samples as they stand in the file, without filters.
struct PngFile {
  std::uint32_t width = 1;
  std::uint32_t height = 1;
  int depth = 8;
  int colour = 6;  ///< 0 grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGBA
  bool is_interlaced = false;
  std::vector<std::string> rows;  ///< of each pass, one after the other
  std::string palette = {};
  std::string transparency = {};

  std::string bytes() const;
};

/// TIFF (6.0) of one strip a page, little-endian and uncompressed.
struct TiffPage {
  std::uint32_t width = 1;
  std::uint32_t height = 1;
  std::uint16_t bits = 8;
  std::uint16_t format = 1;       ///< 1 whole numbers, 2 with a sign, 3 floats
  std::uint16_t photometric = 2;  ///< 0 white is 0, 1 black is 0, 2 RGB
  std::uint16_t samples = 3;
  int extra = -1;  ///< kind of the extra sample: 0 unspecified, 1 associated, 2 unassociated alpha
  std::string pixels = {};
};
std::string tiff_bytes(const std::vector<TiffPage>& pages);

/// OpenEXR, uncompressed scanlines. Channels in alphabetic order.
struct ExrPart {
  struct Channel {
    std::string name;
    int type = 2;                ///< 0 uint, 2 float
    std::vector<double> values;  ///< of the data window, row by row
  };
  struct Box {
    int left, top, right, bottom;
  };
  std::vector<Channel> channels;
  Box data{0, 0, 0, 0};
  Box display{0, 0, 0, 0};
  std::string name = {};
};
/// Several parts need names.
std::string exr_bytes(const std::vector<ExrPart>& parts);

/// `value` as little-endian bytes.
template <class Value>
std::string little(Value value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

}  // namespace plumb::tests
