// Metrics as lines of text.
#pragma once

#include <string>

#include "references/comparison/metrics/metrics.hpp"

namespace plumb::report {

/// One line each; what does not exist says why.
std::string metrics_table(const comparison::Metrics& metrics);

/// All in one list: "PSNR, ... and FLIP".
std::string metrics_named();
/// For --help: what each metric is.
std::string metrics_help();

}  // namespace plumb::report
