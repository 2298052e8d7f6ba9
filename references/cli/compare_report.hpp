// The report of two image files.
#pragma once

#include <string>

#include "references/cli/report.hpp"
#include "tracer/image/pixel_rows.hpp"

namespace plumb::cli {

/// An image and the path that it was read from.
struct NamedImage {
  std::string path;
  PixelRows rows;
};

/// Writes DIRECTORY/index.html and gives the rows back before; `result` is what --json says. One channel is
/// shown as grey, alpha is dropped and that is said. Throws std::runtime_error when the directory cannot be
/// written.
void write_compare_report(const std::string& directory, NamedImage reference, NamedImage test,
                          double tolerance, const Json& result);

}  // namespace plumb::cli
