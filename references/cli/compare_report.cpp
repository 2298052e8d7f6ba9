#include "references/cli/compare_report.hpp"

#include <memory>
#include <utility>

#include "references/cli/options.hpp"
#include "references/report/report_writer.hpp"

namespace plumb::cli {
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

void write_compare_report(const std::string& directory, NamedImage reference, NamedImage test,
                          double tolerance, const Json& result) {
  references::ReportEntry entry;
  entry.name = test.path;
  entry.result = result;
  const std::string said = remark(test.rows.channels);
  entry.reference = shown(std::move(reference.rows));
  entry.test = shown(std::move(test.rows));
  if (!said.empty()) {
    entry.result["message"] = said;
    warn("report: " + said);
  }
  entry.tolerance = tolerance;
  references::ReportWriter writer(directory, "plumb compare: " + test.path, "against " + reference.path);
  writer.add(entry);
  writer.finish();
}

}  // namespace plumb::cli
