#include "references/report/picture.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <stdexcept>

#include "references/comparison/comparison.hpp"
#include "references/system/json.hpp"

namespace plumb::report {
namespace {

constexpr const char* over_cause = "over";
constexpr const char* ignored_cause = "ignored";

std::uint32_t bits(float value) { return std::bit_cast<std::uint32_t>(value); }

/// `bits_of` gives the bits of value i; a large picture is not held once more for them.
template <typename BitsOf>
void append_shuffled(std::string& bytes, std::size_t values, BitsOf bits_of) {
  std::size_t at = bytes.size();
  bytes.resize(at + 4 * values);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    for (unsigned shift = 0; shift < 32; shift += 8) {
      for (std::size_t i = channel; i < values; i += 3) {
        bytes[at++] = static_cast<char>(bits_of(i) >> shift & 0xff);
      }
    }
  }
}

bool is_ignored(const ReportEntry& entry, std::size_t pixel) {
  if (entry.mask.has_all()) return false;
  const auto width = static_cast<std::size_t>(entry.test->width);
  return !entry.mask.has(static_cast<int>(pixel % width), static_cast<int>(pixel / width));
}

bool is_over(const ReportEntry& entry, std::size_t pixel) {
  if (!entry.tolerance || is_ignored(entry, pixel)) return false;
  return !comparison::is_within(entry.reference->rgb.data() + 3 * pixel, entry.test->rgb.data() + 3 * pixel,
                                *entry.tolerance);
}

void check(const ReportEntry& entry) {
  const Image& reference = *entry.reference;
  const Image& test = *entry.test;
  const auto size = [](int w, int h) { return std::to_string(w) + " x " + std::to_string(h) + " pixels"; };
  if (reference.width != test.width || reference.height != test.height) {
    throw std::invalid_argument(entry.name + ": the test picture has " + size(test.width, test.height) +
                                ", expected " + size(reference.width, reference.height) +
                                " as in the reference");
  }
  for (const PixelNote& note : entry.notes) {
    if (note.x >= 0 && note.y >= 0 && note.x < test.width && note.y < test.height) continue;
    throw std::invalid_argument(entry.name + ": a note is at (" + std::to_string(note.x) + ", " +
                                std::to_string(note.y) + "), expected a pixel of " +
                                size(test.width, test.height));
  }
}

/// Counted from 1; past the end when it is not among them.
char place_of(const std::vector<std::string>& causes, const std::string& cause) {
  return static_cast<char>(std::find(causes.begin(), causes.end(), cause) - causes.begin() + 1);
}

void append_notes(std::string& bytes, const ReportEntry& entry) {
  const std::vector<std::string> causes = causes_of(entry);
  if (causes.size() > 255) {
    throw std::invalid_argument(entry.name + ": found " + std::to_string(causes.size()) +
                                " causes, expected at most 255");
  }
  const std::size_t start = bytes.size();
  const std::size_t pixels = entry.test->rgb.size() / 3;
  bytes.append(pixels, '\0');
  const char over = place_of(causes, over_cause), ignored = place_of(causes, ignored_cause);
  for (std::size_t i = 0; i < pixels; ++i)
    bytes[start + i] = is_over(entry, i) ? over : is_ignored(entry, i) ? ignored : '\0';
  nlohmann::json texts = nlohmann::json::object();  // sorted: an ordered one searches all its keys each time
  for (const PixelNote& note : entry.notes) {
    const std::size_t pixel = entry.test->offset(note.x, note.y) / 3;
    bytes[start + pixel] = place_of(causes, note.cause);
    if (!note.text.empty()) texts[std::to_string(pixel)] = note.text;
  }
  bytes += system::json_text_of_any_bytes(texts);
}

}  // namespace

std::vector<std::string> causes_of(const ReportEntry& entry) {
  std::vector<std::string> causes;
  const std::size_t pixels = entry.test ? entry.test->rgb.size() / 3 : 0;
  const auto add_if_any = [&](auto is_so, const char* cause) {
    std::size_t i = 0;
    while (i < pixels && !is_so(entry, i)) ++i;
    if (i < pixels) causes.emplace_back(cause);
  };
  if (entry.tolerance) add_if_any(is_over, over_cause);
  if (!entry.mask.has_all()) add_if_any(is_ignored, ignored_cause);
  for (const PixelNote& note : entry.notes) {
    if (std::find(causes.begin(), causes.end(), note.cause) == causes.end()) causes.push_back(note.cause);
  }
  return causes;
}

std::string picture_bytes(const ReportEntry& entry) {
  check(entry);
  const std::vector<float>&reference = entry.reference->rgb, &test = entry.test->rgb;
  std::string bytes;
  constexpr std::size_t bytes_of_pixel = sizeof(float) * 3 * 2 + 1;
  bytes.reserve(bytes_of_pixel * (reference.size() / 3) + 2);
  append_shuffled(bytes, reference.size(), [&](std::size_t i) { return bits(reference[i]); });
  append_shuffled(bytes, test.size(), [&](std::size_t i) { return bits(test[i]) ^ bits(reference[i]); });
  append_notes(bytes, entry);
  return bytes;
}

}  // namespace plumb::report
