#include "references/cli/metrics.hpp"

#include <cstdio>

namespace plumb::cli {
namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

std::string line(const std::string& name, const std::string& value) {
  return name + std::string(13 - name.size(), ' ') + value + "\n";
}

std::string flip_text(const references::Flip& flip) {
  std::string text = "mean " + number(flip.mean) + ", max " + number(flip.max);
  if (const auto& e = flip.exposures) {
    text += ", HDR, " + std::to_string(e->count) + " exposures from " + number(e->start) + " to " +
            number(e->stop) + " stops";
  }
  return text;
}

}  // namespace

std::string metrics_table(const references::Metrics& m) {
  std::string percentiles;
  for (std::size_t i = 0; i < m.percentiles.size(); ++i) {
    percentiles += (i == 0 ? "" : ", ") + number(static_cast<double>(references::permilles[i]) / 10) +
                   " %: " + number(m.percentiles[i]);
  }
  std::string bias;
  for (const double b : m.bias) bias += (bias.empty() ? "" : " ") + number(b);
  return line("peak", number(m.peak)) +
         line("PSNR", m.psnr_db ? number(*m.psnr_db) + " dB" : "none: nothing differs") +
         line("percentiles", percentiles) + line("bias", bias) +
         line("SSIM", m.ssim ? number(*m.ssim) : "none: smaller than 11 x 11, or not finite") +
         line("FLIP", m.flip ? flip_text(*m.flip) : "none: not finite");
}

}  // namespace plumb::cli
