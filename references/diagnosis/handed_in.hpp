// Whether a file that was handed in holds a picture that can be diagnosed, and what of it isn't looked at.
#pragma once

#include <optional>
#include <string>

#include "tracer/image/pixel_rows.hpp"

namespace plumb::references {

/// Why the file is no picture of a scene, for people; nothing when it is one. The whole picture is expected,
/// in R G B or grey, with or without alpha, in integers of up to 16 bits or in floats.
std::optional<std::string> complaint_about_contents(const PixelRows& rows);

/// What a verdict about it doesn't speak of, e.g. "channel A, part 'depth' (2 of 2)"; empty when that is
/// nothing. Alpha that is 1 everywhere is nothing.
std::string not_looked_at(const PixelRows& rows);

}  // namespace plumb::references
