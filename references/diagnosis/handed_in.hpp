// Tells whether a file that was handed in holds a picture that can be diagnosed, and what is not looked at.
#pragma once

#include <optional>
#include <string>

#include "tracer/image/pixel_rows.hpp"

namespace plumb::diagnosis {

/// Returns why the file is no picture of a scene, for people, or nothing when it is one. It expects the
/// complete picture, in R G B or grey, with or without alpha, in integers of at most 16 bits or in floats.
std::optional<std::string> complaint_about_contents(const PixelRows& rows);

/// Returns what a verdict does not speak of, e.g. "channel A, part 'depth' (2 of 2)", or an empty text. An
/// alpha of 1 everywhere is not mentioned.
std::string not_looked_at(const PixelRows& rows);

}  // namespace plumb::diagnosis
