// Tells the kind of a file by its first bytes. Neither the name nor a library decides.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace plumb {

enum class Kind { netpbm, pfm, png, exr, tiff, bmp, tga, jpeg, hdr };

/// Returns nothing for what is not opened. TGA begins with no magic number: a file without its footer needs
/// the extension and a header that makes sense.
std::optional<Kind> kind_of(std::string_view bytes, const std::string& extension);

/// Returns what the bytes seem to be instead, for a message: "an ICO file (Windows icons)", "text that begins
/// ...".
std::string seeming(std::string_view bytes);

/// Returns what to do about them, as the end of a message; empty when nothing is known.
std::string remedy(std::string_view bytes);

}  // namespace plumb
