#include "references/report/findings_table.hpp"

#include <vector>

#include "references/report/compared_contents.hpp"
#include "references/report/formatted.hpp"
#include "references/report/metrics_table.hpp"
#include "references/report/sentences.hpp"

namespace plumb::report {
namespace {

std::string nine_digits_of_each(const std::vector<float>& values) {
  std::string text;
  for (const float v : values) text += (text.empty() ? "" : " ") + nine_digits(static_cast<double>(v));
  return text;
}

}  // namespace

std::string contents_of(const gates::Findings& f) {
  return contents_text({f.reference_path, f.reference}, {f.test_path, f.test});
}

std::string verdict_of(const gates::Findings& f) {
  if (!f.agrees()) return "differ";
  return f.result.comparison.pixels_over > 0 ? "agree within the bounds" : "agree";
}

std::string table_of(const gates::Findings& f) {
  std::string text;
  const comparison::Comparison& c = f.result.comparison;
  if (c.non_finite > 0) text += formatted("not finite   %zu pixels\n", c.non_finite);
  text += formatted("max error    %.9g\nmean error   %.9g\nRMS error    %.9g\npixels over  %zu of %zu\n",
                    c.max_error, c.mean_error, c.rms_error, c.pixels_over, c.pixels);
  text +=
      formatted("worst pixel  (%d, %d): test %s, reference %s\n", c.worst.x, c.worst.y,
                nine_digits_of_each(c.worst.test).c_str(), nine_digits_of_each(c.worst.reference).c_str());
  const std::string allowed = bounds_text(f.bounds, f.result);
  if (!allowed.empty()) text += formatted("bounds       %s\n", allowed.c_str());
  if (f.metrics) text += metrics_table(*f.metrics);
  if (!f.no_metrics.empty()) text += formatted("no metrics: %s\n", f.no_metrics.c_str());
  if (f.cause) text += formatted("likely cause: %s\n", cause_text(*f.cause).c_str());
  return text + contents_of(f) + verdict_of(f) + "\n";
}

std::string details_of(const gates::Findings& f) {
  const comparison::Comparison& c = f.result.comparison;
  std::string text = std::to_string(c.pixels_over) + " of " + std::to_string(c.pixels) + " pixels are over";
  if (c.non_finite > 0) text += ", " + std::to_string(c.non_finite) + " of them are not finite";
  text += "; worst pixel (" + std::to_string(c.worst.x) + ", " + std::to_string(c.worst.y) + "): test " +
          nine_digits_of_each(c.worst.test) + ", reference " + nine_digits_of_each(c.worst.reference);
  const std::string allowed = bounds_text(f.bounds, f.result);
  if (!allowed.empty()) text += "\nbounds: " + allowed;
  if (f.cause) text += "\nlikely cause: " + cause_text(*f.cause);
  const std::string contents = contents_of(f);
  return contents.empty() ? text : text + "\n" + contents.substr(0, contents.size() - 1);
}

std::string output_of(const gates::Findings& f) {
  const bool is_plain = f.bounds.are_plain() && contents_of(f).empty();
  return is_plain ? "" : details_of(f);
}

}  // namespace plumb::report
