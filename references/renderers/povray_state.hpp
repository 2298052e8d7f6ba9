// Reads the state file, in which POV-Ray 3.7 keeps its pixels as float32 while it renders.
#pragma once

#include <string_view>

#include "tracer/image/image.hpp"

namespace plumb::renderers {

/// Returns linear, unclamped colours from the bytes of a .pov-state file. It is an implementation detail of
/// 3.7, so magic, version, sizes and the coverage of every pixel are checked. Throws std::runtime_error when
/// anything is off.
/// The format (measured) is big-endian: a header of 512 bytes; messages "POVRAYMS", u32 0x370, u32 size,
/// "RAWS", size bytes; in each "OBJE", u32 count, then {key, type, u32 n, data}. PBlo of type VFL4 holds n
/// floats, five per pixel (r g b filter transmit). Left Top Righ Bott of type INT4 are the place of the
/// block, ends included.
Image read_povray_state(std::string_view bytes, int width, int height);

}  // namespace plumb::renderers
