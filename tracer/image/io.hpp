// Pictures to and from files, the format chosen by the extension.
#pragma once

#include <optional>
#include <string>

#include "tracer/image/encode.hpp"
#include "tracer/image/image.hpp"
#include "tracer/image/netpbm.hpp"

namespace plumb {

/// The encoding for a file that nobody chose one for: floats linear, PPM as the course, others sRGB.
Encoding default_encoding(const std::string& path);

/// Writes PFM and PPM itself. PNG is 16 bits when linear, 8 otherwise; that of 16 bits and EXR (float, zip)
/// are written through OpenImageIO, which is loaded only then. `-` writes to standard output: PFM when
/// linear, else PPM. Throws std::runtime_error; then nothing half-written is left.
void write_image(const std::string& path, const Image& image, Encoding encoding);

/// Values as they stand in the file (no gamma removed). Throws std::runtime_error.
ImageFile read_image(const std::string& path);

/// The same for looking at row by row. Float PFM, uncompressed float EXR and TIFF stay where they are, mapped
/// into memory; zip EXR and PNG are read without OpenImageIO. Throws std::runtime_error.
PixelRows open_image(const std::string& path);

/// Why a path cannot be written as an image in that encoding; nothing when it can.
std::optional<std::string> complaint_about(const std::string& path, Encoding encoding);

}  // namespace plumb
