// Makes bytes small, and turns them into text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace plumb::report {

/// Compresses to zlib format (RFC 1950), which browsers call "deflate". Throws std::runtime_error.
std::string deflated(std::string_view bytes);

/// Encodes by RFC 4648, section 4, with padding.
std::string base64(std::string_view bytes);

/// Returns a PNG (ISO/IEC 15948) of 8-bit samples, interleaved: 1 channel is grey, 3 are sRGB.
std::string png(int width, int height, int channels, const std::vector<unsigned char>& samples);

}  // namespace plumb::report
