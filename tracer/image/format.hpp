// What an image file's name says of it.
#pragma once

#include <optional>
#include <string>

#include "tracer/image/encode.hpp"

namespace plumb {

/// With the dot, in lower case.
std::string extension_of(const std::string& path);

/// Whether files of that extension hold floats when we write them.
bool is_float_format(const std::string& extension);

/// The encoding for a file that nobody chose one for: floats linear, PPM as the course, others sRGB.
Encoding default_encoding(const std::string& path);

/// Why a path cannot be written as an image in that encoding; nothing when it can.
std::optional<std::string> complaint_about(const std::string& path, Encoding encoding);

}  // namespace plumb
