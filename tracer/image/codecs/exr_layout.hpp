// Which part of an EXR is read, its windows and channels, and what of the file that leaves out.
#pragma once

#include <openexr.h>

#include "tracer/image/codecs/codecs.hpp"

namespace plumb::codecs {

struct ExrChannel {
  exr_pixel_type_t type;
  std::size_t place;  ///< among the components of a pixel in memory
};

/// Rows cover the data window and the display window alike: what lies in one alone is compared, too.
struct ExrLayout {
  int part = 0;
  exr_storage_t storage = EXR_STORAGE_SCANLINE;
  exr_compression_t compression = EXR_COMPRESSION_NONE;
  Window data;
  Shape shape;
  std::vector<ExrChannel> channels;  ///< in the order of the file
};

/// Throws naming the file for what isn't supported, isn't there, or is too large.
ExrLayout exr_layout(const Source& source, exr_const_context_t context);

}  // namespace plumb::codecs
