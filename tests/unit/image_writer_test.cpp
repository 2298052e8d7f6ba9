// Pictures that are written in bands, against the same written whole.
#include "tracer/image/image_writer.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <random>
#include <stdexcept>

#include "tests/support/end_to_end.hpp"
#include "tests/support/other_readers.hpp"
#include "tracer/image/io.hpp"
#include "tracer/image/oiio_module.hpp"
#include "tracer/system/module.hpp"

namespace plumb::tests {
namespace {

Image random_image(int width, int height) {
  Image image(width, height);
  std::mt19937 random(7);
  std::uniform_real_distribution<float> colours(-0.5F, 1.5F);
  for (float& c : image.rgb) c = colours(random);
  return image;
}

Image rows_of(const Image& image, int first, int rows) {
  Image band(image.width, std::min(rows, image.height - first));
  std::copy_n(image.pixel(0, first), band.rgb.size(), band.rgb.data());
  return band;
}

void write_in_bands(const std::string& path, const Image& image, Encoding encoding, int rows) {
  ImageWriter writer(path, image.width, image.height, encoding);
  for (int y = 0; y < image.height; y += rows) writer.write(rows_of(image, y, rows));
  writer.finish();
}

/// OpenEXR files say when they were written.
std::string without_date(std::string bytes) {
  const std::size_t at = bytes.find(std::string("capDate\0string\0", 15));
  constexpr std::size_t before_the_date = 19, date = 19;
  if (at != std::string::npos) bytes.replace(at + before_the_date, date, date, '.');
  return bytes;
}

struct Kind {
  const char* name;
  Encoding encoding;
};
constexpr Kind byte_for_byte[] = {{"a.pfm", Encoding::linear}, {"a.exr", Encoding::linear},
                                  {"a.png", Encoding::linear}, {"a.ppm", Encoding::course},
                                  {"a.ppm", Encoding::srgb},   {"a.ppm", Encoding::linear}};
constexpr int heights[] = {1, 2, 7, 16, 17, 32, 49, 50, 1000};

TEST(ImageWriter, TheFileIsTheSameForAllBands) {
  const Workplace workplace;
  for (const auto& [width, height] : {std::pair(67, 50), std::pair(1, 37), std::pair(37, 1)}) {
    const Image image = random_image(width, height);
    for (const Kind& kind : byte_for_byte) {
      write_image(workplace.path(kind.name), image, kind.encoding);
      const std::string whole = without_date(read_file(workplace.path(kind.name)));
      ASSERT_GT(whole.size(), 50U);
      for (const int rows : heights) {
        write_in_bands(workplace.path("b-" + std::string(kind.name)), image, kind.encoding, rows);
        EXPECT_TRUE(without_date(read_file(workplace.path("b-" + std::string(kind.name)))) == whole)
            << kind.name << " " << width << "x" << height << " in bands of " << rows;
      }
    }
  }
}

/// Whole it is deflated by libdeflate, in bands by zlib.
TEST(ImageWriter, APngOfEightBitsHasTheSamePixelsForAllBands) {
  const Workplace workplace;
  const std::string path = workplace.path("a.png");
  for (const auto& [width, height] : {std::pair(67, 50), std::pair(1, 37), std::pair(1500, 400)}) {
    const Image image = random_image(width, height);  // the last of them: more than one chunk of 1 MiB
    for (const Encoding encoding : {Encoding::srgb, Encoding::course}) {
      write_image(path, image, encoding);
      const std::vector<float> ours = read_image(path).values, theirs = as_oiiotool_reads(path).values;
      for (const int rows : heights) {
        write_in_bands(path, image, encoding, rows);
        if (rows == 7 || rows == 49) {  // each start of oiiotool takes 0.4 s
          ASSERT_TRUE(as_oiiotool_reads(path).values == theirs) << width << "x" << height << " in " << rows;
        }
        ASSERT_TRUE(read_image(path).values == ours) << width << "x" << height << " in bands of " << rows;
      }
    }
  }
}

TEST(ImageWriter, WhatIsNotFinishedIsNotSeen) {
  const Image image = random_image(20, 40);
  for (const char* const name : {"a.pfm", "a.exr", "a.png", "a.ppm"}) {
    const Workplace workplace;
    workplace.file(name, "old");
    {
      ImageWriter writer(workplace.path(name), 20, 40, Encoding::linear);
      writer.write(rows_of(image, 0, 16));
      EXPECT_EQ(listing(workplace.directory()).size(), 2U) << "one is written aside";
      EXPECT_EQ(read_file(workplace.path(name)), "old");
    }
    EXPECT_EQ(listing(workplace.directory()), std::vector<std::string>{name});
    EXPECT_EQ(read_file(workplace.path(name)), "old");
  }
}

TEST(ImageWriter, ADeviceThatIsFullIsNamed) {
  const Workplace workplace;
  const Image image = random_image(20, 40);
  for (const char* const name : {"a.pfm", "a.exr", "a.png", "a.ppm"}) {
    std::filesystem::create_symlink("/dev/full", workplace.path(name));
    try {
      write_in_bands(workplace.path(name), image, Encoding::linear, 16);
      FAIL() << name;
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(error.what(), workplace.path(name) + ": cannot be written: No space left on device");
    }
  }
}

/// Takes so many bytes.
class FullSink final : public ByteSink {
 public:
  explicit FullSink(std::size_t room) : room_(room) {}
  void write(std::string_view bytes) override {
    if (bytes.size() > room_) throw std::runtime_error("full");
    room_ -= bytes.size();
  }
  void seek(std::uint64_t) override {}

 private:
  std::size_t room_;
};

/// OpenImageIO itself does not notice.
TEST(ImageWriter, AFullDiskIsNoticedThroughOpenImageIO) {
  const Image image = random_image(200, 100);  // 120 kB and 240 kB, hardly compressible
  const auto make = reinterpret_cast<oiio::Write>(module_symbol(oiio::module_name, oiio::write_symbol));
  const auto write = [&](const char* name, oiio::Depth depth, std::size_t room) {
    FullSink sink(room);
    const auto writer = make(sink, name, {image.width, image.height, depth, {"R", "G", "B"}});
    writer->write(image.rgb);
    writer->finish();
  };
  for (const std::size_t room : {0U, 100U, 2'000U, 50'000U, 80'000U}) {
    EXPECT_THROW(write("a.exr", oiio::Depth::float32, room), std::runtime_error) << room;
    EXPECT_THROW(write("a.png", oiio::Depth::bits16, room), std::runtime_error) << room;
  }
  EXPECT_NO_THROW(write("a.exr", oiio::Depth::float32, 1'000'000));
  EXPECT_NO_THROW(write("a.png", oiio::Depth::bits16, 1'000'000));
}

}  // namespace
}  // namespace plumb::tests
