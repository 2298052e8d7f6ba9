// Metrics as lines of text.
#pragma once

#include <string>

#include "references/comparison/metrics/metrics.hpp"

namespace plumb::cli {

/// One line each; what does not exist says why.
std::string metrics_table(const references::Metrics& metrics);

/// For --help: what each metric is.
inline constexpr const char* metrics_help =
    "--metrics adds: peak (largest component, at least 1), PSNR in dB (20 log10(peak / RMS)), percentiles of "
    "each "
    "pixel's largest difference, bias (mean of test - reference) per channel, SSIM (Wang et al. 2004, "
    "luminance), "
    "FLIP (0 to 1). Float and 16-bit files count as linear light and get HDR-FLIP (Andersson et al. 2021); "
    "when "
    "both files hold 8 bits, they count as sRGB and get LDR-FLIP (2020).";

}  // namespace plumb::cli
