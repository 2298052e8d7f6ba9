// The boundary of the module that reads the commonest files quickly: OpenImageIO's start alone costs 0.3 s.
#pragma once

#include <string>

#include "tracer/image/pixel_rows.hpp"

namespace plumb::codecs {

/// False when the file is not of the plain kind that is known here, or is damaged: OpenImageIO then reads it,
/// or says what is wrong with it.
using Open = bool (*)(const std::string& path, PixelRows& rows);

inline constexpr const char* module_name = "plumb_codecs.so";
inline constexpr const char* open_symbol = "plumb_codecs_open";

bool open_exr(const std::string& path, PixelRows& rows);
bool open_png(const std::string& path, PixelRows& rows);
bool open_tiff(const std::string& path, PixelRows& rows);

}  // namespace plumb::codecs
