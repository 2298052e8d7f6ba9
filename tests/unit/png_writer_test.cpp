// The PNG that we write, read by others: its chunks by hand and zlib, its pixels by oiiotool.
#include "tracer/image/codecs/png_writer.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "tests/support/other_readers.hpp"
#include "tests/support/run.hpp"
#include "tracer/image/codecs/codecs.hpp"
#include "tracer/image/io.hpp"
#include "tracer/system/module.hpp"

namespace plumb::tests {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Size = std::pair<int, int>;

/// A file in memory.
class Written final : public ByteSink {
 public:
  void write(std::string_view written) override { bytes += written; }
  void seek(std::uint64_t) override { FAIL() << "a PNG is written from start to end"; }

  std::string bytes;
};

std::string png_of(Size size, const Bytes& rgb) {
  void* const write = module_symbol(codecs::module_name, codecs::write_png_symbol);
  Written file;
  const auto writer = reinterpret_cast<codecs::WritePng>(write)(file, size.first, size.second);
  writer->write(rgb);
  writer->finish();
  return file.bytes;
}

/// Levels 0 .. `levels` - 1.
Bytes random_pixels(std::mt19937& random, Size size, unsigned levels) {
  Bytes rgb(3 * static_cast<std::size_t>(size.first) * static_cast<std::size_t>(size.second));
  for (std::uint8_t& byte : rgb) byte = static_cast<std::uint8_t>(random() % levels);
  return rgb;
}

void expect_pixels(const ImageFile& file, Size size, const Bytes& rgb) {
  ASSERT_EQ(Size(file.width, file.height), size);
  ASSERT_EQ(file.channels, 3);
  EXPECT_EQ(file.sample, Sample::bits8);
  ASSERT_EQ(file.values.size(), rgb.size());
  for (std::size_t i = 0; i < rgb.size(); ++i) ASSERT_EQ(std::lround(255 * file.values[i]), rgb[i]) << i;
}

void expect_read_back(const Workplace& workplace, Size size, const Bytes& rgb) {
  SCOPED_TRACE(std::to_string(size.first) + "x" + std::to_string(size.second));
  const std::string path = workplace.file("image.png", png_of(size, rgb));
  expect_pixels(as_oiiotool_reads(path), size, rgb);
  expect_pixels(read_image(path), size, rgb);
}

struct Chunk {
  std::string name;
  std::string data;
};

std::size_t number_at(const std::string& bytes, std::size_t at) {
  std::size_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = 256 * value + static_cast<std::uint8_t>(bytes.at(at + i));
  return value;
}

std::vector<Chunk> chunks_of(const std::string& png) {
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
  std::vector<Chunk> chunks;
  for (std::size_t at = 8; at < png.size();) {
    const std::size_t size = number_at(png, at);
    const auto* const named = reinterpret_cast<const Bytef*>(png.data()) + at + 4;
    EXPECT_EQ(number_at(png, at + 8 + size), crc32(0, named, static_cast<uInt>(size + 4)));
    chunks.push_back({png.substr(at + 4, 4), png.substr(at + 8, size)});
    at += size + 12;
  }
  return chunks;
}

TEST(PngWriter, OthersReadTheSamePixels) {
  const Workplace workplace;
  std::mt19937 random(4);
  for (const Size& size : {Size(1, 1), Size(1, 37), Size(37, 1), Size(2, 2), Size(3, 5), Size(17, 16),
                           Size(255, 3), Size(641, 479)}) {
    for (const unsigned levels : {1U, 3U, 256U})
      expect_read_back(workplace, size, random_pixels(random, size, levels));
  }
}

TEST(PngWriter, APictureOfSeveralChunksIsReadBack) {
  const Workplace workplace;
  std::mt19937 random(5);
  const Size size(1001, 700);
  const Bytes noise = random_pixels(random, size, 256);
  expect_read_back(workplace, size, noise);
  const auto chunks = chunks_of(png_of(size, noise));
  EXPECT_EQ(std::count_if(chunks.begin(), chunks.end(), [](const Chunk& c) { return c.name == "IDAT"; }), 3);
}

/// The specification: sections 5.6 on their order, 11.2.2 and 11.3.3 on what they hold.
TEST(PngWriter, ItsChunksSayEightBitsOfSrgb) {
  const auto chunks = chunks_of(png_of({3, 2}, Bytes(18, 7)));
  std::vector<std::string> names;
  for (const Chunk& chunk : chunks) names.push_back(chunk.name);
  ASSERT_EQ(names, (std::vector<std::string>{"IHDR", "gAMA", "sRGB", "cHRM", "IDAT", "IEND"}));
  EXPECT_EQ(chunks[0].data, std::string("\0\0\0\x03\0\0\0\x02\x08\x02\0\0\0", 13));
  EXPECT_EQ(number_at(chunks[1].data, 0), 45455U);
  EXPECT_EQ(chunks[2].data, "\x03");
  std::vector<std::size_t> places;
  for (std::size_t at = 0; at < chunks[3].data.size(); at += 4)
    places.push_back(number_at(chunks[3].data, at));
  EXPECT_EQ(places, (std::vector<std::size_t>{31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000}));
  EXPECT_EQ(chunks[5].data, "");
}

}  // namespace
}  // namespace plumb::tests
