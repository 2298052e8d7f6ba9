// Reads and writes pictures as files.
#pragma once

#include <string>

#include "tracer/image/encode.hpp"
#include "tracer/image/format.hpp"
#include "tracer/image/image.hpp"
#include "tracer/image/netpbm.hpp"
#include "tracer/image/read_request.hpp"

namespace plumb {

/// Writes a picture at once, as ImageWriter does. Throws std::runtime_error and then leaves nothing
/// half-written.
void write_image(const std::string& path, const Image& image, Encoding encoding);

/// Returns the values as they stand in the file (no gamma is removed). Throws what open_image() throws.
ImageFile read_image(const std::string& path);

/// Opens a picture to look at it row by row. The first bytes say what kind of file it is. Netpbm, PNG, and
/// the plain kinds of float EXR and TIFF are read here; uncompressed floats stay where they lie, mapped into
/// memory. A confined process decodes all else. Throws std::runtime_error naming the path, PictureTooLarge
/// for more pixels than `request` allows, and std::system_error when the confined process cannot be run.
PixelRows open_image(const std::string& path, const ReadRequest& request = {});

}  // namespace plumb
