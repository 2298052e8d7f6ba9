// Converts samples of a TIFF, of any type, to components.
#pragma once

#include "tracer/image/codecs/tiff_file.hpp"

namespace plumb::codecs {

enum class TiffMeaning { as_is, white_is_zero, palette };

struct TiffLayout {
  unsigned bits = 8;  ///< number of bits of a sample
  std::uint16_t format = SAMPLEFORMAT_UINT;
  std::size_t samples = 1;  ///< number per pixel in the file
  TiffMeaning meaning = TiffMeaning::as_is;
  std::vector<double> palette;  ///< r g b of each index, as components
  bool is_planar = false;       ///< each sample has strips or tiles of its own
  Shape shape;
};

/// Describes the current page. Throws std::runtime_error naming the file for what is not supported or too
/// large.
TiffLayout tiff_layout(const Source& source, const TiffFile& file);

/// Returns sample i of the decoded bytes as a component. Unsigned integers of at most 16 bits become 0..1;
/// all others stay as they are.
double tiff_sample(const TiffLayout& layout, const std::byte* bytes, std::size_t i);

}  // namespace plumb::codecs
