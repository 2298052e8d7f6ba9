#include "references/cli/compare_report.hpp"

#include <memory>

#include "references/cli/options.hpp"
#include "references/report/report_writer.hpp"

namespace plumb::cli {
namespace {

/// r g b; grey thrice for one or two channels, and what follows the colours dropped.
std::shared_ptr<const Image> shown(const ImageFile& file) {
  auto image = std::make_shared<Image>(file.width, file.height);
  const auto channels = static_cast<std::size_t>(file.channels);
  for (std::size_t i = 0; i < image->rgb.size(); ++i) {
    image->rgb[i] = file.values[i / 3 * channels + (channels < 3 ? 0 : i % 3)];
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

void write_compare_report(const std::string& directory, const NamedImage& reference, const NamedImage& test,
                          double tolerance, const Json& result) {
  references::ReportEntry entry;
  entry.name = test.path;
  entry.result = result;
  entry.reference = shown(reference.file);
  entry.test = shown(test.file);
  if (const std::string said = remark(test.file.channels); !said.empty()) {
    entry.result["message"] = said;
    warn("report: " + said);
  }
  for (const auto& place : references::pixels_over(*entry.reference, *entry.test, tolerance)) {
    entry.notes.push_back({place.x, place.y, "over", ""});
  }
  references::ReportWriter writer(directory, "plumb compare: " + test.path, "against " + reference.path);
  writer.add(entry);
  writer.finish();
}

}  // namespace plumb::cli
