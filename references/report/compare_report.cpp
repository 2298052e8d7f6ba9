#include "references/report/compare_report.hpp"

#include <memory>
#include <utility>

#include "references/report/findings_table.hpp"
#include "references/report/sentences.hpp"

namespace plumb::report {
namespace {

/// r g b; grey thrice for one or two channels, and what follows the colours dropped.
/// The rows are given back: large files are not held twice.
std::shared_ptr<const Image> shown(PixelRows&& given) {
  const PixelRows rows(std::move(given));
  auto image = std::make_shared<Image>(rows.width, rows.height);
  const auto channels = static_cast<std::size_t>(rows.channels), width = static_cast<std::size_t>(rows.width);
  std::vector<float> row(rows.row_values());
  for (int y = 0; y < rows.height; ++y) {
    rows.copy_row(y, row.data());
    float* const to = image->pixel(0, y);
    for (std::size_t i = 0; i < 3 * width; ++i) to[i] = row[i / 3 * channels + (channels < 3 ? 0 : i % 3)];
  }
  return image;
}

/// What the page leaves out of such files; "" when nothing.
std::string remark(int channels) {
  if (channels == 1) return "one channel, shown as grey";
  if (channels == 2) return "one channel, shown as grey; its alpha was compared, but is not shown";
  if (channels == 4) return "alpha was compared, but is not shown";
  if (channels > 4) return std::to_string(channels) + " channels were compared, the first three are shown";
  return "";
}

}  // namespace

CompareReport::CompareReport(const std::string& directory, const std::string& title,
                             const std::string& subtitle)
    : writer_(directory, title, subtitle) {}

std::string CompareReport::add(const std::string& name, gates::Findings&& findings, const Json& result) {
  ReportEntry entry;
  entry.name = name;
  entry.result = result;
  // On the page it says why there are no figures; here it is a list of parts, which the message has.
  entry.result.erase("not_compared");
  const std::string left_out = remark(findings.test.channels);
  std::string said = left_out;
  const std::string allowed = bounds_text(findings.bounds, findings.result);
  if (!allowed.empty()) said += (said.empty() ? "bounds: " : "\nbounds: ") + allowed;
  const std::string contents = contents_of(findings);
  if (!contents.empty()) said += (said.empty() ? "" : "\n") + contents.substr(0, contents.size() - 1);
  if (findings.cause)
    said = "likely cause: " + cause_text(*findings.cause) + (said.empty() ? "" : "\n") + said;
  if (!said.empty()) entry.result["message"] = said;
  entry.tolerance = findings.bounds.limit;
  entry.mask = findings.result.mask;
  entry.reference_is_encoded = findings.reference.sample == Sample::bits8;
  entry.test_is_encoded = findings.test.sample == Sample::bits8;
  entry.reference = shown(std::move(findings.reference));
  entry.test = shown(std::move(findings.test));
  writer_.add(entry);
  return left_out;
}

void CompareReport::add_trouble(const std::string& name, const Json& result) {
  ReportEntry entry;
  entry.name = name;
  entry.result = result;
  writer_.add(entry);
}

}  // namespace plumb::report
