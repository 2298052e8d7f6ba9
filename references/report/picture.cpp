#include "references/report/picture.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <stdexcept>

namespace plumb::references {
namespace {

using Bits = std::vector<std::uint32_t>;

void append_shuffled(std::string& bytes, const Bits& values) {
  std::size_t at = bytes.size();
  bytes.resize(at + 4 * values.size());
  for (std::size_t channel = 0; channel < 3; ++channel) {
    for (unsigned shift = 0; shift < 32; shift += 8) {
      for (std::size_t i = channel; i < values.size(); i += 3) {
        bytes[at++] = static_cast<char>(values[i] >> shift & 0xff);
      }
    }
  }
}

Bits bits_of(const Image& image) {
  Bits bits(image.rgb.size());
  std::transform(image.rgb.begin(), image.rgb.end(), bits.begin(),
                 [](float value) { return std::bit_cast<std::uint32_t>(value); });
  return bits;
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

void append_notes(std::string& bytes, const ReportEntry& entry) {
  const std::vector<std::string> causes = causes_of(entry.notes);
  if (causes.size() > 255) {
    throw std::invalid_argument(entry.name + ": found " + std::to_string(causes.size()) +
                                " causes, expected at most 255");
  }
  const std::size_t start = bytes.size();
  bytes.append(entry.test->rgb.size() / 3, '\0');
  nlohmann::json texts = nlohmann::json::object();  // sorted: an ordered one searches all its keys each time
  for (const PixelNote& note : entry.notes) {
    const std::size_t pixel = entry.test->offset(note.x, note.y) / 3;
    const auto place = std::find(causes.begin(), causes.end(), note.cause) - causes.begin();
    bytes[start + pixel] = static_cast<char>(place + 1);
    if (!note.text.empty()) texts[std::to_string(pixel)] = note.text;
  }
  bytes += texts.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

std::vector<std::string> causes_of(const std::vector<PixelNote>& notes) {
  std::vector<std::string> causes;
  for (const PixelNote& note : notes) {
    if (std::find(causes.begin(), causes.end(), note.cause) == causes.end()) causes.push_back(note.cause);
  }
  return causes;
}

std::string picture_bytes(const ReportEntry& entry) {
  check(entry);
  const Bits reference = bits_of(*entry.reference);
  Bits difference = bits_of(*entry.test);
  for (std::size_t i = 0; i < difference.size(); ++i) difference[i] ^= reference[i];
  std::string bytes;
  bytes.reserve(9 * reference.size());
  append_shuffled(bytes, reference);
  append_shuffled(bytes, difference);
  append_notes(bytes, entry);
  return bytes;
}

}  // namespace plumb::references
