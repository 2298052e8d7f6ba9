// Pictures to and from files, the format chosen by the extension.
#pragma once

#include <string>

#include "tracer/image/encode.hpp"
#include "tracer/image/format.hpp"
#include "tracer/image/image.hpp"
#include "tracer/image/netpbm.hpp"
#include "tracer/image/read_request.hpp"

namespace plumb {

/// As ImageWriter does it, whole. Throws std::runtime_error; then nothing half-written is left.
void write_image(const std::string& path, const Image& image, Encoding encoding);

/// Values as they stand in the file (no gamma removed). Throws std::runtime_error.
ImageFile read_image(const std::string& path);

/// The same for looking at row by row. The first bytes say what kind of file it is. Netpbm, PNG, and float
/// EXR and TIFF of the plain kinds are read here, uncompressed floats where they lie, mapped into memory; all
/// else is decoded by a confined process. Throws std::runtime_error naming the path, PictureTooLarge for one
/// of more pixels than `request` allows, and std::system_error when the confined process cannot be run.
PixelRows open_image(const std::string& path, const ReadRequest& request = {});

}  // namespace plumb
