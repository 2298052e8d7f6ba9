#include "references/gates/bounds.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <stdexcept>

#include "tracer/image/io.hpp"
#include "tracer/text/numbers.hpp"
#include "tracer/text/words.hpp"

namespace plumb::gates {
namespace {

std::string size_text(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height) + " pixels";
}

/// Returns the whole numbers between the commas, or none when there is anything else.
std::vector<int> whole_numbers(const std::string& text) {
  std::vector<int> numbers;
  const char* const end = text.data() + text.size();
  for (const char* at = text.data();; ++at) {
    int number = 0;
    const auto [after, error] = std::from_chars(at, end, number);
    if (error != std::errc() || (after != end && *after != ',')) return {};
    numbers.push_back(number);
    if (after == end) return numbers;
    at = after;
  }
}

/// True for a text that can only be meant as numbers: nobody gives a picture such a name.
bool looks_like_numbers(const std::string& text) {
  return text.find_first_not_of("0123456789,;.+- xX") == std::string::npos;
}

bool is_outside(const Window& r, int width, int height) {
  return r.x >= width || r.y >= height || 0LL + r.x + r.width <= 0 || 0LL + r.y + r.height <= 0;
}

void set_rectangle(comparison::PixelMask& mask, const Region& region, int width, int height, bool counts) {
  if (is_outside(*region.rectangle, width, height)) {
    throw std::invalid_argument("region " + region.text +
                                ": found a rectangle that lies outside of the picture"
                                ", expected one inside its " +
                                size_text(width, height));
  }
  mask.set(*region.rectangle, counts);
}

/// Returns the number of colours. Alpha is none: with it, nothing in an opaque mask would be black.
int colour_channels(int channels) { return channels == 2 ? 1 : std::min(channels, 3); }

void set_row(comparison::PixelMask& mask, const Region& region, const PixelRows& rows, int y, bool counts) {
  std::vector<float> row(rows.row_values());
  rows.copy_row(y, row.data());
  for (int x = 0; x < rows.width; ++x) {
    const auto first = row.begin() + static_cast<std::ptrdiff_t>(x) * rows.channels;
    const auto last = first + colour_channels(rows.channels);
    if (std::any_of(first, last, [](float v) { return !std::isfinite(v); })) {
      throw std::invalid_argument(region.mask_path + ": pixel (" + std::to_string(x) + ", " +
                                  std::to_string(y) +
                                  ") is not finite, expected a mask of black and other colours");
    }
    if (std::any_of(first, last, [](float v) { return v != 0; })) mask.set(x, y, counts);
  }
}

void set_masked(comparison::PixelMask& mask, const Region& region, int width, int height, bool counts) {
  const PixelRows rows = open_image(region.mask_path);
  if (rows.width != width || rows.height != height) {
    throw std::invalid_argument(region.mask_path + ": found a mask of " + size_text(rows.width, rows.height) +
                                ", expected " + size_text(width, height) + " as of the pictures");
  }
  for (int y = 0; y < height; ++y) set_row(mask, region, rows, y, counts);
}

void set_region(comparison::PixelMask& mask, const Region& region, int width, int height, bool counts) {
  region.rectangle ? set_rectangle(mask, region, width, height, counts)
                   : set_masked(mask, region, width, height, counts);
}

std::size_t non_finite_outside(const PixelRows& rows, const PixelRows& other,
                               const comparison::PixelMask& mask) {
  std::size_t count = 0;
  std::vector<double> r(rows.row_values()), t(rows.row_values());
  const auto is_finite = [](double v) { return std::isfinite(v); };
  for (int y = 0; y < rows.height; ++y) {
    rows.copy_row(y, r.data());
    other.copy_row(y, t.data());
    for (int x = 0; x < rows.width; ++x) {
      const auto at = static_cast<std::ptrdiff_t>(x) * rows.channels;
      const auto all_finite = [&](const std::vector<double>& row) {
        return std::all_of(row.begin() + at, row.begin() + at + rows.channels, is_finite);
      };
      if (!mask.has(x, y) && !(all_finite(r) && all_finite(t))) ++count;
    }
  }
  return count;
}

}  // namespace

std::size_t AllowOver::of(std::size_t pixels) const {
  if (!is_percent) return static_cast<std::size_t>(amount);
  constexpr double rounding = 1e-12;  // because 0.07 % of 100,000 pixels are 70, not 69.99...
  return static_cast<std::size_t>(amount / 100 * static_cast<double>(pixels) * (1 + rounding));
}

std::string AllowOver::text() const {
  char number[32];
  return std::string(number, std::to_chars(number, number + sizeof number, amount).ptr) +
         (is_percent ? "%" : "");
}

std::vector<std::string> Bounds::mask_paths() const {
  std::vector<std::string> paths;
  for (const auto* const regions : {&ignore, &only})
    for (const Region& region : *regions)
      if (!region.rectangle) paths.push_back(region.mask_path);
  return paths;
}

bool Bounds::are_plain() const {
  return !has_regions() && !limit.is_relative() && allow_over.amount == 0 && because.empty();
}

AllowOver parse_allow_over(const std::string& text, const std::string& what) {
  const bool is_percent = text.ends_with('%');
  const Number number = parse_number(is_percent ? text.substr(0, text.size() - 1) : text);
  constexpr double most_pixels = 1e15;  // because a double counts that far one by one
  const double most = is_percent ? 100 : most_pixels;
  const bool is_whole = is_percent || number.value == std::floor(number.value);
  if (number.complaint.empty() && number.value >= 0 && number.value <= most && is_whole)
    return {number.value, is_percent};
  throw std::invalid_argument(what + ": found " + in_quotes(text) +
                              ", expected a number of pixels or a percentage of them, e.g. 12 or 0.5%");
}

Region parse_region(const std::string& text, const std::string& what, const std::string& directory) {
  const std::vector<int> n = whole_numbers(text);
  if (n.size() == 4 && n[2] >= 1 && n[3] >= 1) return {text, Window{n[0], n[1], n[2], n[3]}, {}};
  if (looks_like_numbers(text)) {
    throw std::invalid_argument(what + ": found " + in_quotes(text) +
                                ", expected a rectangle X,Y,W,H of whole numbers with W and H at least 1, or "
                                "the path of a mask image");
  }
  return {text, std::nullopt, (std::filesystem::path(directory) / text).string()};
}

comparison::PixelMask mask_of(const Bounds& bounds, int width, int height) {
  if (!bounds.has_regions()) return {};
  comparison::PixelMask mask(width, height, bounds.only.empty());
  for (const Region& region : bounds.only) set_region(mask, region, width, height, true);
  for (const Region& region : bounds.ignore) set_region(mask, region, width, height, false);
  if (mask.count() > 0) return mask;
  throw std::invalid_argument("the regions to ignore and to compare leave no pixel, expected at least one");
}

BoundedComparison compare_within(const PixelRows& reference, const PixelRows& test, const Bounds& bounds) {
  BoundedComparison result;
  result.mask = mask_of(bounds, reference.width, reference.height);
  result.comparison = comparison::compare(reference, test, bounds.limit, result.mask);
  result.allowed_over = bounds.allow_over.of(result.comparison.pixels);
  if (result.mask.has_all()) return result;
  const auto all = static_cast<std::size_t>(reference.width) * static_cast<std::size_t>(reference.height);
  result.ignored = all - result.comparison.pixels;
  result.ignored_non_finite = non_finite_outside(reference, test, result.mask);
  return result;
}

BoundedComparison compare_within(const Image& reference, const Image& test, const Bounds& bounds) {
  comparison::expect_one_size(reference, test);
  return compare_within(comparison::rows_over(reference), comparison::rows_over(test), bounds);
}

}  // namespace plumb::gates
