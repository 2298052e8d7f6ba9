#include "references/report/metrics_table.hpp"

#include "references/report/formatted.hpp"

namespace plumb::report {
namespace {

std::string line(const std::string& name, const std::string& value) {
  return name + std::string(13 - name.size(), ' ') + value + "\n";
}

std::string flip_text(const comparison::Flip& flip) {
  std::string text = "mean " + nine_digits(flip.mean) + ", max " + nine_digits(flip.max);
  if (const auto& e = flip.exposures) {
    text += ", HDR, " + std::to_string(e->count) + " exposures from " + nine_digits(e->start) + " to " +
            nine_digits(e->stop) + " stops";
  }
  return text;
}

std::string scalars_text(const comparison::Metrics& m) {
  std::string text;
  for (std::size_t i = 0; i < m.scalars.size(); ++i) {
    const comparison::ScalarMetric& metric = comparison::scalar_metrics()[i];
    const std::string none = "none: " + std::string(metric.none) + ", or not finite";
    text += line(metric.name, m.scalars[i] ? nine_digits(*m.scalars[i]) : none);
  }
  return text;
}

}  // namespace

std::string metrics_named() {
  std::string names = "PSNR, percentiles, bias";
  for (const comparison::ScalarMetric& metric : comparison::scalar_metrics())
    names += std::string(", ") + metric.name;
  return names + " and FLIP";
}

std::string metrics_help() {
  std::string text =
      "--metrics adds: peak (largest component, at least 1), PSNR in dB (20 log10(peak / RMS)), percentiles "
      "of "
      "each pixel's largest difference, bias (mean of test - reference) per channel, ";
  for (const comparison::ScalarMetric& metric : comparison::scalar_metrics())
    text += std::string(metric.what) + ", ";
  return text +
         "FLIP (0 to 1). Float and 16-bit files count as linear light and get HDR-FLIP (Andersson et al. "
         "2021); "
         "when both files hold 8 bits, they count as sRGB and get LDR-FLIP (2020).";
}

std::string metrics_table(const comparison::Metrics& m) {
  std::string percentiles;
  for (std::size_t i = 0; i < m.percentiles.size(); ++i) {
    percentiles += (i == 0 ? "" : ", ") + nine_digits(static_cast<double>(comparison::permilles[i]) / 10) +
                   " %: " + nine_digits(m.percentiles[i]);
  }
  std::string bias;
  for (const double b : m.bias) bias += (bias.empty() ? "" : " ") + nine_digits(b);
  return line("peak", nine_digits(m.peak)) +
         line("PSNR", m.psnr_db ? nine_digits(*m.psnr_db) + " dB" : "none: nothing differs") +
         line("percentiles", percentiles) + line("bias", bias) + scalars_text(m) +
         line("FLIP", m.flip ? flip_text(*m.flip) : "none: not finite");
}

}  // namespace plumb::report
