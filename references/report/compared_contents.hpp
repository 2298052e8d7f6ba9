// What `plumb compare` says of the files' contents: what was compared, and what was not.
#pragma once

#include <string>
#include <vector>

#include "tracer/image/pixel_rows.hpp"

namespace plumb::report {

struct NamedRows {
  const std::string& path;
  const PixelRows& rows;
};

/// Names of the channels that were read, the usual ones where the file names none.
std::vector<std::string> channels_of(const PixelRows& rows);

/// Where the pixels lie; all of the picture where the file says nothing.
Window window_of(const PixelRows& rows);

/// What was not read, of each file, with its path.
std::vector<std::string> left_out(const NamedRows& reference, const NamedRows& test);

/// In lines, for people; empty when both files hold one picture of the usual channels and nothing else.
std::string contents_text(const NamedRows& reference, const NamedRows& test);

}  // namespace plumb::report
