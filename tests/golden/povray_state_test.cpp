// POV-Ray's state file, on bytes made here after the format that was measured.
#include "references/renderers/povray_state.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>

namespace plumb::tests {
namespace {

using renderers::read_povray_state;

constexpr int width = 5;
constexpr int height = 4;
constexpr std::size_t header_size = 512;

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>((value >> shift) & 0xFFU);
  return bytes;
}

std::string field(const std::string& key, const std::string& type, std::uint32_t n, const std::string& data) {
  return key + type + big_endian(n) + data;
}

std::string integer(const std::string& key, int value) {
  return field(key, "INT4", 4, big_endian(static_cast<std::uint32_t>(value)));
}

std::string object(const std::vector<std::string>& fields) {
  std::string body = "OBJE" + big_endian(static_cast<std::uint32_t>(fields.size()));
  for (const std::string& f : fields) body += f;
  return body;
}

std::string message(const std::string& body, std::uint32_t version = 0x370) {
  return "POVRAYMS" + big_endian(version) + big_endian(static_cast<std::uint32_t>(body.size())) + "RAWS" +
         body;
}

std::string header(const std::string& magic = "POV-Ray Render State File") {
  return magic + std::string(header_size - magic.size(), '\0');
}

/// Different for every component, with values that are no byte picture.
float value_at(int x, int y, int channel) {
  return std::ldexp(static_cast<float>(1 + x + 10 * y + 100 * channel), -5) - (channel == 2 ? 9.0F : 0.0F);
}

std::string pixels(int left, int top, int right, int bottom) {
  std::string floats;
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      for (int channel = 0; channel < 5; ++channel) {
        floats += big_endian(std::bit_cast<std::uint32_t>(value_at(x, y, channel)));
      }
    }
  }
  return field("PBlo", "VFL4", static_cast<std::uint32_t>(floats.size() / 4), floats);
}

std::vector<std::string> place(int left, int top, int right, int bottom) {
  return {integer("Left", left), integer("Top ", top), integer("Righ", right), integer("Bott", bottom)};
}

std::string block(int left, int top, int right, int bottom) {
  std::vector<std::string> fields = place(left, top, right, bottom);
  fields.insert(fields.begin() + 2, pixels(left, top, right, bottom));
  return message(object(fields));
}

/// A message as POV-Ray writes them besides the blocks: of other keys and types.
std::string other_message() {
  return message(
      object({field("Clas", "TYPE", 4, "PCla"), field("Name", "CSTR", 3, "abc"), integer("Widt", 7)}));
}

std::string good_file() {
  return header() + other_message() + block(0, 0, 2, 3) + block(3, 0, 4, 1) + other_message() +
         block(3, 2, 4, 3);
}

void expect_refused(const std::string& bytes, const std::string& what) {
  try {
    read_povray_state(bytes, width, height);
    ADD_FAILURE() << what << " was accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("POV-Ray's state file"), std::string::npos)
        << what << ": " << error.what();
  } catch (const std::exception& error) {
    ADD_FAILURE() << what << ": not a runtime_error but " << error.what();
  }
}

std::string with_byte(std::string bytes, std::size_t at, char value) {
  bytes.at(at) = value;
  return bytes;
}

TEST(PovrayState, EveryPixelOfEveryBlockComesToItsPlace) {
  const Image image = read_povray_state(good_file(), width, height);
  ASSERT_EQ(image.width, width);
  ASSERT_EQ(image.height, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int channel = 0; channel < 3; ++channel) {
        EXPECT_EQ(image.pixel(x, y)[channel], value_at(x, y, channel)) << x << " " << y << " " << channel;
      }
    }
  }
}

TEST(PovrayState, TheOrderOfBlocksAndFieldsIsFree) {
  std::vector<std::string> fields{integer("Bott", 3), pixels(0, 0, 2, 3), integer("Righ", 2),
                                  integer("Top ", 0), integer("Left", 0)};
  const std::string bytes = header() + block(3, 2, 4, 3) + message(object(fields)) + block(3, 0, 4, 1);
  EXPECT_EQ(read_povray_state(bytes, width, height).rgb, read_povray_state(good_file(), width, height).rgb);
}

TEST(PovrayState, ValuesAreNeitherClampedNorRounded) {
  const std::array<float, 3> colour{1e30F, -0.25F, std::numeric_limits<float>::denorm_min()};
  std::string floats;
  for (const float f : colour) floats += big_endian(std::bit_cast<std::uint32_t>(f));
  floats += big_endian(0) + big_endian(0);
  std::vector<std::string> fields = place(0, 0, 0, 0);
  fields.push_back(field("PBlo", "VFL4", 5, floats));
  const Image image = read_povray_state(header() + message(object(fields)), 1, 1);
  EXPECT_EQ(image.rgb, std::vector<float>(colour.begin(), colour.end()));
}

TEST(PovrayState, AnotherMagicIsRefused) {
  const std::string rest = good_file().substr(header_size);
  expect_refused(header("POV-Ray Render State Fill") + rest, "another header");
  expect_refused(header("") + rest, "an empty header");
  expect_refused(std::string(good_file().size(), '\0'), "zeros");
  expect_refused(header() + with_byte(rest, 3, 'X'), "another magic of a message");
  expect_refused(header() + with_byte(rest, 16, 'X'), "another magic of the body");
  expect_refused(header() + with_byte(rest, 20, 'X'), "another magic of the object");
  expect_refused(good_file() + "trailing bytes", "trailing bytes");
  expect_refused("", "nothing");
}

TEST(PovrayState, AnotherVersionIsRefused) {
  for (const std::uint32_t version : {0U, 0x371U, 0x380U, 0x70030000U, 0xFFFFFFFFU}) {
    expect_refused(header() + message(object({pixels(0, 0, 4, 3)}), version),
                   "version " + std::to_string(version));
  }
}

TEST(PovrayState, AFileThatEndsAnywhereEarlierIsRefused) {
  const std::string good = good_file();
  for (std::size_t length = 0; length < good.size(); ++length) {
    expect_refused(good.substr(0, length), "the first " + std::to_string(length) + " bytes");
  }
}

TEST(PovrayState, ABlockOutsideThePictureIsRefused) {
  struct Place {
    int left, top, right, bottom;
  };
  for (const Place& p : {Place{-1, 0, 4, 3},
                         {0, -1, 4, 3},
                         {0, 0, 5, 3},
                         {0, 0, 4, 4},
                         {4, 0, 3, 3},
                         {0, 3, 4, 2},
                         {5, 4, 9, 7},
                         {0, 0, std::numeric_limits<int>::max(), 3},
                         {std::numeric_limits<int>::min(), 0, 4, 3}}) {
    std::vector<std::string> fields = place(p.left, p.top, p.right, p.bottom);
    fields.push_back(pixels(0, 0, 4, 3));
    try {
      read_povray_state(good_file() + message(object(fields)), width, height);
      ADD_FAILURE() << p.left << " " << p.top << " " << p.right << " " << p.bottom << " was accepted";
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find("outside the picture"), std::string::npos) << error.what();
    }
  }
}

TEST(PovrayState, APictureOfAnotherSizeIsRefused) {
  for (const auto& [w, h] : {std::pair{width + 1, height},
                             {width, height + 1},
                             {width - 1, height},
                             {width, height - 1},
                             {height, width},
                             {1, 1},
                             {1000, 1000}}) {
    EXPECT_THROW(read_povray_state(good_file(), w, h), std::runtime_error) << w << " x " << h;
  }
}

TEST(PovrayState, MissingPixelsAreRefused) {
  expect_refused(header(), "no block");
  expect_refused(header() + other_message(), "no block but other messages");
  expect_refused(header() + block(0, 0, 2, 3) + block(3, 0, 4, 1), "two of three blocks");
  expect_refused(header() + block(0, 0, 4, 2) + block(0, 3, 3, 3), "all but one pixel");
  expect_refused(header() + block(0, 0, 3, 3) + block(0, 0, 3, 3), "one block twice");
}

TEST(PovrayState, ABlockOfAnotherSizeThanItsPlaceIsRefused) {
  const auto with = [](const std::string& block_of_pixels) {
    std::vector<std::string> fields = place(0, 0, 4, 3);
    fields.push_back(block_of_pixels);
    return header() + message(object(fields));
  };
  expect_refused(with(pixels(0, 0, 4, 2)), "a row too few");
  expect_refused(with(pixels(0, 0, 4, 4)), "a row too many");
  expect_refused(with(field("PBlo", "VFL4", 99, std::string(4 * 99, '\0'))), "a float too few");
  expect_refused(with(field("PBlo", "VFL4", 100, std::string(4 * 99, '\0'))), "data shorter than said");
  expect_refused(with(field("PBlo", "VFL4", 0xFFFFFFFFU, std::string(400, '\0'))), "the largest count");
  expect_refused(with(field("PBlo", "VFL8", 400, std::string(400, '\0'))), "another type");
  expect_refused(with(field("PBlo", "VFL4", 0, "")), "no floats");
}

TEST(PovrayState, ABlockWithoutItsWholePlaceIsRefused) {
  for (std::size_t missing = 0; missing < 4; ++missing) {
    std::vector<std::string> fields = place(0, 0, 4, 3);
    fields.push_back(pixels(0, 0, 4, 3));
    fields.erase(fields.begin() + static_cast<std::ptrdiff_t>(missing));
    expect_refused(header() + message(object(fields)), "without number " + std::to_string(missing));
    fields.push_back(integer("Else", 0));
    expect_refused(header() + message(object(fields)), "another key for number " + std::to_string(missing));
  }
}

TEST(PovrayState, APlaceThatIsNoIntegerOfFourBytesIsRefused) {
  std::vector<std::string> fields = place(0, 0, 4, 3);
  fields.push_back(pixels(0, 0, 4, 3));
  fields[2] = field("Righ", "INT4", 3, std::string("\0\0\4", 3));
  expect_refused(header() + message(object(fields)), "three bytes");
  fields[2] = field("Righ", "INT8", 8, std::string("\0\0\0\0\0\0\0\4", 8));
  expect_refused(header() + message(object(fields)), "eight bytes");
}

TEST(PovrayState, WrongCountsAndSizesOfMessagesAreRefused) {
  std::vector<std::string> fields = place(0, 0, 4, 3);
  fields.push_back(pixels(0, 0, 4, 3));
  std::string body = object(fields);
  body[7] = 6;
  expect_refused(header() + message(body), "a count one too large");
  body[7] = 4;
  expect_refused(header() + message(body), "a count one too small leaves out the pixels");
  body.replace(4, 4, "\xFF\xFF\xFF\xFF");
  expect_refused(header() + message(body), "the largest count");
  std::string bytes = header() + message(object(fields));
  bytes.replace(header_size + 12, 4, "\xFF\xFF\xFF\xFF");
  expect_refused(bytes, "the largest size");
}

TEST(PovrayState, RandomDamageIsRefusedOrLeavesTheShapeOfThePicture) {
  const std::string good = good_file();
  const Image whole = read_povray_state(good, width, height);
  std::mt19937 random(20260101);
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  int refused = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string bytes = good;
    for (std::size_t n = 1 + below(4); n > 0; --n) {
      // Mostly in the messages: the padding of the header is long and means nothing.
      const std::size_t at =
          below(8) == 0 ? below(bytes.size()) : header_size + below(bytes.size() - header_size);
      const std::size_t kind = below(5);
      if (kind == 0) bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
      if (kind == 1) bytes[at] = static_cast<char>(below(256));
      if (kind == 2) bytes.insert(at, below(9), static_cast<char>(below(256)));
      if (kind == 3 && bytes.size() > header_size + 20) bytes.erase(at, 1 + below(8));
      if (kind == 4) bytes.replace(at, 4, bytes.substr(header_size + below(bytes.size() - header_size), 4));
    }
    try {
      const Image image = read_povray_state(bytes, width, height);
      EXPECT_EQ(image.rgb.size(), whole.rgb.size());
    } catch (const std::runtime_error&) {
      ++refused;
    } catch (const std::exception& error) {
      ADD_FAILURE() << "input " << i << ": not a runtime_error but " << error.what();
    }
  }
  EXPECT_GT(refused, 5000);
  EXPECT_LT(refused, 20000) << "damage to a float cannot be noticed";
}

}  // namespace
}  // namespace plumb::tests
