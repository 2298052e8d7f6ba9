// Samples of a TIFF, whatever their kind, as components.
#pragma once

#include "tracer/image/codecs/tiff_file.hpp"

namespace plumb::codecs {

enum class TiffMeaning { as_is, white_is_zero, palette };

struct TiffLayout {
  unsigned bits = 8;  ///< of a sample
  std::uint16_t format = SAMPLEFORMAT_UINT;
  std::size_t samples = 1;  ///< of a pixel in the file
  TiffMeaning meaning = TiffMeaning::as_is;
  std::vector<double> palette;  ///< r g b of each index, as components
  bool is_planar = false;       ///< each sample has pieces of its own
  Shape shape;
};

/// Of the page that is current. Throws naming the file for what isn't supported or too large.
TiffLayout tiff_layout(const Source& source, const TiffFile& file);

/// Sample i of decoded bytes, as a component: whole numbers of up to 16 bits without a sign from 0 to 1, all
/// others as they are.
double tiff_sample(const TiffLayout& layout, const std::byte* bytes, std::size_t i);

}  // namespace plumb::codecs
