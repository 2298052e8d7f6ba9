// What `plumb compare` says of the files' contents: what was compared, and what was not.
#pragma once

#include <string>

#include "references/cli/report.hpp"
#include "tracer/image/pixel_rows.hpp"

namespace plumb::cli {

struct NamedRows {
  const std::string& path;
  const PixelRows& rows;
};

/// {"compared": {"channels": [...], "part": ..., "window": [x, y, w, h]}, "not_compared": [...]}
Json contents_json(const NamedRows& reference, const NamedRows& test);

/// The same for people, in lines; empty when both files hold one picture of the usual channels and nothing
/// else.
std::string contents_text(const NamedRows& reference, const NamedRows& test);

}  // namespace plumb::cli
