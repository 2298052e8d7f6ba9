// PFM and the Netpbm formats, read by our own code, so that no image library need be loaded for them.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "tracer/image/image_file.hpp"
#include "tracer/image/pixel_rows.hpp"
#include "tracer/image/read_request.hpp"

namespace plumb {

/// Both throw std::runtime_error saying what is wrong; `name` stands in the message.
/// Returns rows that lie in `bytes`, which `owner` keeps.
PixelRows pfm_rows(std::string_view bytes, const std::string& name, std::shared_ptr<const void> owner,
                   const ReadLimits& limits);
/// Reads P1 to P6 (bitmaps, grey and colour, as text or as bytes of 8 or 16 bits), with comments.
ImageFile from_netpbm(std::string_view bytes, const std::string& name, const ReadLimits& limits);

}  // namespace plumb
