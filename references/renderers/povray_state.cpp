#include "references/renderers/povray_state.hpp"

#include <bit>
#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace plumb::renderers {
namespace {

constexpr std::size_t header_size = 512;
constexpr std::string_view header_magic = "POV-Ray Render State File";
constexpr std::string_view message_magic = "POVRAYMS";
constexpr std::uint32_t known_version = 0x370;
constexpr std::size_t floats_a_pixel = 5;

class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}

  bool at_end() const { return rest_.empty(); }
  std::string_view take(std::size_t n) {
    if (n > rest_.size()) throw std::runtime_error("POV-Ray's state file is truncated");
    const std::string_view taken = rest_.substr(0, n);
    rest_.remove_prefix(n);
    return taken;
  }
  std::uint32_t u32() {
    std::uint32_t value = 0;
    std::memcpy(&value, take(4).data(), 4);
    return __builtin_bswap32(value);
  }
  void expect(std::string_view magic) {
    if (take(magic.size()) != magic) throw std::runtime_error("POV-Ray's state file has an unknown format");
  }

 private:
  std::string_view rest_;
};

struct Block {
  std::map<std::string_view, int> ints;
  std::string_view pixels;  // big-endian floats
};

std::size_t size_of_value(std::string_view type, std::uint32_t n) {
  return type == "VFL4" ? std::size_t{4} * n : std::size_t{n};
}

Block read_message(std::string_view body) {
  Reader reader(body);
  reader.expect("OBJE");
  Block block;
  const std::uint32_t count = reader.u32();
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::string_view key = reader.take(4);
    const std::string_view type = reader.take(4);
    const std::string_view data = [&] {
      const std::uint32_t n = reader.u32();
      return reader.take(size_of_value(type, n));
    }();
    if (key == "PBlo" && type == "VFL4") block.pixels = data;
    if (type == "INT4" && data.size() == 4) block.ints[key] = static_cast<int>(Reader(data).u32());
  }
  return block;
}

float big_endian_float(const char* at) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, at, 4);
  return std::bit_cast<float>(__builtin_bswap32(bits));
}

void place(const Block& block, Image& image, std::vector<bool>& is_covered) {
  const int left = block.ints.at("Left");
  const int top = block.ints.at("Top ");
  const int right = block.ints.at("Righ");
  const int bottom = block.ints.at("Bott");
  if (left < 0 || top < 0 || right < left || bottom < top || right >= image.width || bottom >= image.height) {
    throw std::runtime_error("a block of POV-Ray's state file lies outside the picture");
  }
  const auto columns = static_cast<std::size_t>(right - left) + 1;
  const auto rows = static_cast<std::size_t>(bottom - top) + 1;
  if (block.pixels.size() != columns * rows * floats_a_pixel * sizeof(float)) {
    throw std::runtime_error("a block of POV-Ray's state file has another size than its place");
  }
  const char* at = block.pixels.data();
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x, at += floats_a_pixel * sizeof(float)) {
      for (std::size_t channel = 0; channel < 3; ++channel) {
        image.pixel(x, y)[channel] = big_endian_float(at + channel * sizeof(float));
      }
      is_covered[image.offset(x, y) / 3] = true;
    }
  }
}

}  // namespace

Image read_povray_state(std::string_view bytes, int width, int height) {
  Reader reader(bytes);
  const std::string_view header = reader.take(header_size);
  if (!header.starts_with(header_magic))
    throw std::runtime_error("POV-Ray's state file has an unknown header");
  Image image(width, height);
  std::vector<bool> is_covered(image.rgb.size() / 3, false);
  while (!reader.at_end()) {
    reader.expect(message_magic);
    if (reader.u32() != known_version)
      throw std::runtime_error("POV-Ray's state file has an unknown version");
    const std::uint32_t size = reader.u32();
    reader.expect("RAWS");
    const Block block = read_message(reader.take(size));
    if (block.pixels.empty()) continue;
    const bool has_place = block.ints.contains("Left") && block.ints.contains("Top ") &&
                           block.ints.contains("Righ") && block.ints.contains("Bott");
    if (!has_place) throw std::runtime_error("a block of POV-Ray's state file has no place");
    place(block, image, is_covered);
  }
  for (const bool covered : is_covered) {
    if (!covered) throw std::runtime_error("POV-Ray's state file leaves out pixels");
  }
  return image;
}

}  // namespace plumb::renderers
