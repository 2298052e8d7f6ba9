// Checks that all that a TIFF file (TIFF 6.0, section 2; BigTIFF of libtiff 4) points to lies in it. libtiff
// and OpenImageIO fill in what is missing.
#pragma once

#include "tracer/image/codecs/codecs.hpp"

namespace plumb::codecs {

/// Checks every directory of a TIFF: its entries, their values and all strips and tiles. Throws
/// std::runtime_error naming the file, what lies outside it and where.
void expect_whole_tiff(const Source& source);

}  // namespace plumb::codecs
