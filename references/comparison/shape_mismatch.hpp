// Tells whether two files hold pictures that can be compared value by value: sizes, windows, channels.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tracer/image/pixel_rows.hpp"

namespace plumb::comparison {

/// Returns the names of its channels in their order; the usual ones where the file names none.
std::vector<std::string> names_of(const PixelRows& rows);

bool is_one_everywhere(const PixelRows& rows, int channel);

/// Leaves out the alpha of one picture when the other has none and it is 1 everywhere: nothing is lost then.
/// Its `not_read` says so.
void leave_out_opaque_alpha(PixelRows& reference, PixelRows& test);

/// Returns why pictures of these shapes cannot be compared, for people, or nothing when they can. Channels
/// are known by their roles: diffuse.R and LeR are R.
std::optional<std::string> shape_mismatch(const PixelRows& reference, const PixelRows& test);

}  // namespace plumb::comparison
