// Pictures to and from files, the format chosen by the extension.
#pragma once

#include <string>

#include "tracer/image/encode.hpp"
#include "tracer/image/format.hpp"
#include "tracer/image/image.hpp"
#include "tracer/image/netpbm.hpp"

namespace plumb {

/// As ImageWriter does it, whole. Throws std::runtime_error; then nothing half-written is left.
void write_image(const std::string& path, const Image& image, Encoding encoding);

/// Values as they stand in the file (no gamma removed). Throws std::runtime_error.
ImageFile read_image(const std::string& path);

/// The same for looking at row by row. Float PFM, uncompressed float EXR and TIFF stay where they are, mapped
/// into memory; zip EXR and PNG are read without OpenImageIO. Throws std::runtime_error.
PixelRows open_image(const std::string& path);

}  // namespace plumb
