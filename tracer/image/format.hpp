// What the name of an image file says about it.
#pragma once

#include <optional>
#include <string>

#include "tracer/image/encode.hpp"

namespace plumb {

/// Returns the extension with its dot, in lower case.
std::string extension_of(const std::string& path);

/// True if we write floats into files of that extension.
bool is_float_format(const std::string& extension);

/// Returns the encoding when nobody chose one: linear for floats, the course's for PPM, sRGB for others.
Encoding default_encoding(const std::string& path);

/// Returns why a path cannot be written as an image in that encoding, or nothing when it can.
std::optional<std::string> complaint_about(const std::string& path, Encoding encoding);

}  // namespace plumb
