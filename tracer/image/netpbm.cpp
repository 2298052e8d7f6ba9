#include "tracer/image/netpbm.hpp"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace plumb {
namespace {

constexpr double most_values = 3.0 * (1 << 28);

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f'; }

/// Header and ASCII values: tokens between white space, with # comments.
class Tokens {
 public:
  Tokens(std::string_view bytes, const std::string& name) : rest_(bytes), name_(name) {}

  std::string_view word() {
    while (!rest_.empty() && (is_space(rest_.front()) || rest_.front() == '#')) {
      if (rest_.front() == '#') {
        rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size()));
      } else {
        rest_.remove_prefix(1);
      }
    }
    std::size_t end = 0;
    while (end < rest_.size() && !is_space(rest_[end]) && rest_[end] != '#') ++end;
    const std::string_view found = rest_.substr(0, end);
    rest_.remove_prefix(end);
    if (found.empty()) fail("it ends too early: the file is truncated");
    return found;
  }
  template <class Number>
  Number number() {
    const std::string_view text = word();
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) {
      std::string shown(text.substr(0, 20));
      for (char& c : shown) c = c >= ' ' && c <= '~' ? c : '?';
      fail("found '" + shown + "', expected a number");
    }
    return value;
  }
  /// What follows the single white space after the header.
  std::string_view data() {
    if (!rest_.empty()) rest_.remove_prefix(1);
    return rest_;
  }
  [[noreturn]] void fail(const std::string& why) const { throw std::runtime_error(name_ + ": " + why); }

 private:
  std::string_view rest_;
  const std::string& name_;
};

ImageFile sized(Tokens& tokens, int channels) {
  ImageFile file;
  file.width = tokens.number<int>();
  file.height = tokens.number<int>();
  file.channels = channels;
  const double values = static_cast<double>(file.width) * file.height * channels;
  if (file.width < 1 || file.height < 1 || values > most_values) tokens.fail("its size is out of range");
  return file;
}

std::size_t value_count(const ImageFile& file) {
  return static_cast<std::size_t>(file.width) * static_cast<std::size_t>(file.height) *
         static_cast<std::size_t>(file.channels);
}

}  // namespace

PixelRows pfm_rows(std::string_view bytes, const std::string& name, std::shared_ptr<const void> owner) {
  Tokens tokens(bytes, name);
  const std::string_view magic = tokens.word();
  if (magic != "PF" && magic != "Pf") tokens.fail("is no PFM file");
  const ImageFile file = sized(tokens, magic == "PF" ? 3 : 1);
  const double scale = tokens.number<double>();
  if (scale == 0 || !std::isfinite(scale)) tokens.fail("its scale is 0 or not finite, expected -1 or 1");
  const std::string_view data = tokens.data();
  if (data.size() < value_count(file) * sizeof(float))
    tokens.fail("it ends too early: the file is truncated");
  PixelRows rows;
  rows.width = file.width;
  rows.height = file.height;
  rows.channels = file.channels;
  rows.is_big_endian = scale > 0;
  rows.stride = -static_cast<std::ptrdiff_t>(rows.row_values() * sizeof(float));
  rows.top = reinterpret_cast<const std::byte*>(data.data()) - (file.height - 1) * rows.stride;
  rows.owner = std::move(owner);
  return rows;
}

ImageFile from_pfm(std::string_view bytes, const std::string& name) {
  return image_of(pfm_rows(bytes, name, nullptr));
}

ImageFile from_ppm(std::string_view bytes, const std::string& name) {
  Tokens tokens(bytes, name);
  const std::string_view magic = tokens.word();
  if (magic != "P3" && magic != "P6") tokens.fail("is no PPM file of type P3 or P6");
  ImageFile file = sized(tokens, 3);
  const int most = tokens.number<int>();
  if (most < 1 || most > 65535) tokens.fail("its largest value is out of range");
  file.sample = most > 255 ? Sample::bits16 : Sample::bits8;
  file.values.reserve(value_count(file));
  if (magic == "P3") {
    for (std::size_t i = 0; i < value_count(file); ++i) {
      const int value = tokens.number<int>();
      if (value < 0 || value > most)
        tokens.fail("found value " + std::to_string(value) + ", expected 0 to " + std::to_string(most));
      file.values.push_back(static_cast<float>(value) / static_cast<float>(most));
    }
    return file;
  }
  const std::string_view data = tokens.data();
  const std::size_t width = most > 255 ? 2 : 1;
  if (data.size() < value_count(file) * width) tokens.fail("it ends too early: the file is truncated");
  for (std::size_t i = 0; i < value_count(file); ++i) {
    unsigned value = static_cast<unsigned char>(data[i * width]);
    if (width == 2) value = value << 8 | static_cast<unsigned char>(data[i * 2 + 1]);
    file.values.push_back(static_cast<float>(value) / static_cast<float>(most));
  }
  return file;
}

}  // namespace plumb
