// Tells which part of an EXR is read, its windows and channels, and what of the file is left out.
#pragma once

#include <openexr.h>

#include "tracer/image/codecs/codecs.hpp"

namespace plumb::codecs {

struct ExrChannel {
  exr_pixel_type_t type;
  std::size_t place;  ///< index among the components of a pixel in memory
};

/// Rows cover both the data window and the display window: what lies in only one is compared, too.
struct ExrLayout {
  int part = 0;
  exr_storage_t storage = EXR_STORAGE_SCANLINE;
  exr_compression_t compression = EXR_COMPRESSION_NONE;
  Window data;
  Shape shape;
  std::vector<ExrChannel> channels;  ///< in the order of the file
};

/// Throws std::runtime_error naming the file for what is not supported, absent or too large.
ExrLayout exr_layout(const Source& source, exr_const_context_t context);

}  // namespace plumb::codecs
