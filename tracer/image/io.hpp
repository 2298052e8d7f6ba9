// Pictures to and from files, the format chosen by the extension.
#pragma once

#include <string>
#include <vector>

#include "tracer/image/encode.hpp"
#include "tracer/image/format.hpp"
#include "tracer/image/image.hpp"
#include "tracer/image/netpbm.hpp"

namespace plumb {

/// As ImageWriter does it, whole. Throws std::runtime_error; then nothing half-written is left.
void write_image(const std::string& path, const Image& image, Encoding encoding);

/// Values as they stand in the file (no gamma removed). Throws std::runtime_error.
ImageFile read_image(const std::string& path);

/// What to read of a file that holds more than one picture, or more channels than are wanted.
struct ReadRequest {
  std::string part;                   ///< its name, or its number from 1; empty: the first
  std::vector<std::string> channels;  ///< by name, in this order; empty: all
};

/// The same for looking at row by row. Float PFM, uncompressed float EXR and TIFF stay where they are, mapped
/// into memory; zip EXR and PNG are read without OpenImageIO. Throws std::runtime_error.
PixelRows open_image(const std::string& path, const ReadRequest& request = {});

}  // namespace plumb
