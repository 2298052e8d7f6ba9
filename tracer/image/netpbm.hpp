// PFM and PPM, read here so that no image library need be loaded for them.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "tracer/image/image_file.hpp"
#include "tracer/image/pixel_rows.hpp"

namespace plumb {

/// Throw std::runtime_error saying what is wrong; `name` stands in the message.
ImageFile from_pfm(std::string_view bytes, const std::string& name);
/// Rows that lie in `bytes`, which `owner` keeps.
PixelRows pfm_rows(std::string_view bytes, const std::string& name, std::shared_ptr<const void> owner);
/// P3 and P6, 8 or 16 bits, with comments.
ImageFile from_ppm(std::string_view bytes, const std::string& name);

}  // namespace plumb
