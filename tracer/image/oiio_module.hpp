// The boundary of the module that links OpenImageIO (0.3 s of CPU and 129 MiB at every process start, so it
// is a shared object of its own that is loaded on demand).
#pragma once

#include <string>

#include "tracer/image/image_file.hpp"

namespace plumb::oiio {

enum class Depth { float32, bits16 };

/// Both return an empty string, or what went wrong. Writing, of linear colours, goes to memory, in the format
/// of the name: OpenImageIO does not notice a full disk.
using Write = std::string (*)(const std::string& name, const ImageFile& pixels, Depth depth,
                              std::string& bytes);
using Read = std::string (*)(const std::string& path, ImageFile& pixels);

inline constexpr const char* module_name = "plumb_openimageio.so";
inline constexpr const char* write_symbol = "plumb_oiio_write";
inline constexpr const char* read_symbol = "plumb_oiio_read";

}  // namespace plumb::oiio
