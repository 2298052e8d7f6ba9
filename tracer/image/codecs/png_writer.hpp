// Writes PNG (W3C, second edition) of 8-bit sRGB. OpenImageIO's start alone takes longer than most renders.
#pragma once

#include <cstdint>
#include <memory>

#include "tracer/image/row_writer.hpp"
#include "tracer/system/byte_sink.hpp"

namespace plumb::codecs {

/// Makes a writer of width x height pixels of 8 bits, both at least 1. The file, which must outlive it, says
/// that they are sRGB. Throws std::bad_alloc.
using WritePng = std::unique_ptr<RowWriter<std::uint8_t>> (*)(ByteSink& file, int width, int height);

inline constexpr const char* write_png_symbol = "plumb_codecs_write_png";

}  // namespace plumb::codecs
