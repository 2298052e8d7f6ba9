// Packs the pixels of one scene as the page reads them.
#pragma once

#include <string>
#include <vector>

#include "references/report/report_entry.hpp"

namespace plumb::report {

/// Returns the causes in the order of their first pixel. Pixels name them by their place in this list,
/// counted from 1.
std::vector<std::string> causes_of(const ReportEntry& entry);

/// Every bit of both pictures, then the causes, then the texts:
/// - the reference, then the test picture XOR the reference (equal pixels become zeros); of each, for the
///   channels r g b the bytes 0 (lowest) to 3 of all its values, so that like stands by like;
/// - one byte a pixel, its cause or 0;
/// - JSON, the texts by number of the pixel, row by row.
/// Throws std::invalid_argument for pictures of two sizes, a note outside them, or more than 255 causes.
std::string picture_bytes(const ReportEntry& entry);

}  // namespace plumb::report
