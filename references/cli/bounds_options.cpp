#include "references/cli/bounds_options.hpp"

#include <cstdio>

#include "references/cli/options.hpp"

namespace plumb::cli {
namespace {

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::vector<std::string> texts_of(const std::vector<references::Region>& regions) {
  std::vector<std::string> texts;
  for (const references::Region& region : regions) texts.push_back(region.text);
  return texts;
}

std::string list(const std::vector<references::Region>& regions) {
  std::string text;
  for (const references::Region& region : regions) text += (text.empty() ? "" : " ") + region.text;
  return text;
}

std::string pixels_text(std::size_t pixels) {
  return std::to_string(pixels) + (pixels == 1 ? " pixel" : " pixels");
}

std::string regions_text(const references::Bounds& bounds, const references::BoundedComparison& result) {
  std::string text = pixels_text(result.ignored) + " ignored";
  if (!bounds.only.empty()) text += ", only " + list(bounds.only) + " compared";
  if (!bounds.ignore.empty()) text += ", not compared: " + list(bounds.ignore);
  if (result.ignored_non_finite > 0)
    text += "; " + std::to_string(result.ignored_non_finite) + " of the ignored are not finite";
  return text;
}

}  // namespace

Table bounds_options(references::Bounds& bounds) {
  const auto reader = [](std::vector<references::Region>& regions, const char* name) {
    return [&regions, name](const std::string& text) {
      regions.push_back(references::parse_region(text, name));
    };
  };
  constexpr const char* region = "X,Y,W,H|MASK";
  const auto read_allowed = [&bounds](const std::string& text) {
    bounds.allow_over = references::parse_allow_over(text, "--allow-over");
  };
  return {{"--allow-over",
           read_allowed,
           "how many pixels may be over: a number, or a percentage of those compared; never one "
           "that is not finite",
           {.value = "N|P%", .default_text = bounds.allow_over.text()}},
          {"--relative",
           &bounds.limit.relative,
           "a component also agrees when it differs by at most T * |reference|",
           {.value = "T", .complaint = complaint_about_size}},
          {"--ignore",
           reader(bounds.ignore, "--ignore"),
           "leave out this rectangle, or the pixels of this mask image that are not black; repeatable",
           {.value = region, .is_repeatable = true}},
          {"--only",
           reader(bounds.only, "--only"),
           "compare nothing but this rectangle or mask; repeatable",
           {.value = region, .is_repeatable = true}}};
}

Json to_json(const references::Bounds& bounds, const references::BoundedComparison& result) {
  return {{"tolerance", bounds.limit.tolerance},
          {"relative", bounds.limit.relative},
          {"allow_over", bounds.allow_over.text()},
          {"allowed_over", result.allowed_over},
          {"ignore", texts_of(bounds.ignore)},
          {"only", texts_of(bounds.only)},
          {"pixels_compared", result.comparison.pixels},
          {"pixels_ignored", result.ignored},
          {"ignored_non_finite", result.ignored_non_finite},
          {"because", bounds.because}};
}

std::string bounds_text(const references::Bounds& bounds, const references::BoundedComparison& result) {
  if (bounds.are_plain()) return {};
  std::vector<std::string> parts;
  if (!bounds.because.empty()) parts.push_back("tolerance " + number_text(bounds.limit.tolerance));
  if (bounds.limit.is_relative()) parts.push_back("relative " + number_text(bounds.limit.relative));
  if (bounds.allow_over.amount > 0)
    parts.push_back(pixels_text(result.allowed_over) + " may be over (" + bounds.allow_over.text() + ")");
  if (bounds.has_regions()) parts.push_back(regions_text(bounds, result));
  if (!bounds.because.empty()) parts.push_back("because " + bounds.because);
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : "; ") + part;
  return text;
}

}  // namespace plumb::cli
