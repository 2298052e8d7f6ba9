// What kind of file bytes are, by their first ones: the name is not asked, and no library guesses.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace plumb {

enum class Kind { netpbm, pfm, png, exr, tiff, bmp, tga, jpeg, hdr };

/// Nothing for what isn't opened. TGA begins with no magic number: a file without its footer needs the
/// extension as well as a header that makes sense.
std::optional<Kind> kind_of(std::string_view bytes, const std::string& extension);

/// What the bytes seem to be instead, for a message: "an ICO file (Windows icons)", "text that begins ...".
std::string seeming(std::string_view bytes);

/// What to do about them, as the end of a message; empty when nothing is known.
std::string remedy(std::string_view bytes);

}  // namespace plumb
