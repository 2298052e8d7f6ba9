// What is read of image files: values as they stand in them, and what else they hold.
#include <gtest/gtest.h>

#include <random>

#include "references/comparison/comparison.hpp"
#include "references/comparison/shape_mismatch.hpp"
#include "tests/support/image_bytes.hpp"
#include "tests/support/run.hpp"
#include "tracer/image/io.hpp"

namespace plumb::tests {
namespace {

using Names = std::vector<std::string>;

class ImageFiles : public testing::Test {
 protected:
  PixelRows opened(const std::string& name, const std::string& bytes, const ReadRequest& request = {}) const {
    return open_image(workplace_.file(name, bytes), request);
  }
  std::vector<float> values(const std::string& name, const std::string& bytes) const {
    return image_of(opened(name, bytes)).values;
  }
  std::string complaint(const std::string& name, const std::string& bytes,
                        const ReadRequest& request = {}) const {
    try {
      opened(name, bytes, request);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }
  void expect_refused(const std::string& name, const std::string& bytes, const Names& words) const {
    const std::string said = complaint(name, bytes);
    EXPECT_NE(said.find(name), std::string::npos) << said;
    for (const std::string& word : words)
      EXPECT_NE(said.find(word), std::string::npos) << word << ": " << said;
  }

  Workplace workplace_;
};

std::string png(int depth, int colour, const std::string& row, std::uint32_t width = 1) {
  return PngFile{width, 1, depth, colour, false, {row}}.bytes();
}

ExrPart::Channel channel(const std::string& name, const std::vector<double>& values, int type = 2) {
  return {name, type, values};
}

/// 2 x 1 pixels of these channels, whose values are 1, 2, 3, ...
std::string exr_of(const Names& names) {
  ExrPart part{{}, {0, 0, 1, 0}, {0, 0, 1, 0}};
  double value = 0;
  for (const std::string& name : names) {
    part.channels.push_back(channel(name, {value + 1, value + 2}));
    value += 2;
  }
  return exr_bytes({part});
}

// --- alpha ------------------------------------------------------------------------------------------

TEST_F(ImageFiles, ColourUnderAlphaStandsAsItIsInThePng) {
  EXPECT_EQ(values("a.png", png(8, 6, std::string("\xff\x33\x66\0", 4))),
            (std::vector<float>{1, 0.2F, 0.4F, 0}));
  EXPECT_EQ(values("b.png", png(16, 6, std::string("\xff\xff\x33\x33\x66\x66\0\1", 8))),
            (std::vector<float>{1, 0.2F, 0.4F, 1.0F / 65535}));
  EXPECT_EQ(values("c.png", png(8, 4, std::string("\x33\0", 2))), (std::vector<float>{0.2F, 0}));
}

TEST_F(ImageFiles, ColourUnderAlphaStandsAsItIsInTheTiff) {
  for (const int kind : {1, 2}) {
    TiffPage page;
    page.samples = 4;
    page.extra = kind;
    page.pixels = std::string("\xff\x33\x66\0", 4);
    const PixelRows rows = opened("a.tif", tiff_bytes({page}));
    EXPECT_EQ(image_of(rows).values, (std::vector<float>{1, 0.2F, 0.4F, 0}));
    EXPECT_EQ(rows.contents.channels, (Names{"R", "G", "B", "A"}));
  }
}

TEST_F(ImageFiles, ColourUnderAlphaStandsAsItIsInTheTga) {
  // One pixel of 32 bits, b g r a, of which 8 bits are alpha.
  const std::string tga =
      std::string("\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0\x20\x08", 18) + std::string("\x66\x33\xff\1", 4);
  EXPECT_EQ(values("a.tga", tga), (std::vector<float>{1, 0.2F, 0.4F, 1.0F / 255}));
}

// --- PNG of every kind --------------------------------------------------------------------------------

TEST_F(ImageFiles, PalettesAndBitsAreLookedUp) {
  EXPECT_EQ(values("bits.png", png(1, 0, "\xa0", 4)), (std::vector<float>{1, 0, 1, 0}));
  EXPECT_EQ(values("two.png", png(2, 0, "\x1b", 4)), (std::vector<float>{0, 1.0F / 3, 2.0F / 3, 1}));
  PngFile file{2, 1, 8, 3, false, {std::string("\1\0", 2)}, std::string("\xff\0\0\0\x33\0", 6), "\x33"};
  EXPECT_EQ(values("map.png", file.bytes()), (std::vector<float>{0, 0.2F, 0, 1, 1, 0, 0, 0.2F}));
  file.rows = {"\2\2"};
  expect_refused("map.png", file.bytes(), {"cannot be read", "palette of 2"});
}

TEST_F(ImageFiles, ATransparentColourBecomesAlpha) {
  PngFile file{2, 1, 8, 0, false, {"\x33\xff"}, {}, std::string("\0\x33", 2)};
  EXPECT_EQ(values("key.png", file.bytes()), (std::vector<float>{0.2F, 0, 1, 1}));
}

/// Pixel (x, y) of 5 x 5 has the value 5 y + x; the passes are those of the standard's figure 8.1.
TEST_F(ImageFiles, InterlacedRowsComeToTheirPlaces) {
  const auto row = [](const std::vector<int>& values) { return std::string(values.begin(), values.end()); };
  PngFile file{5, 5, 8, 0, true, {}};
  file.rows = {row({0}),
               row({4}),
               row({20, 24}),
               row({2}),
               row({22}),
               row({10, 12, 14}),
               row({1, 3}),
               row({11, 13}),
               row({21, 23}),
               row({5, 6, 7, 8, 9}),
               row({15, 16, 17, 18, 19})};
  const std::vector<float> found = values("adam.png", file.bytes());
  ASSERT_EQ(found.size(), 25U);
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i], static_cast<float>(i) / 255) << i;
}

// --- whole numbers -------------------------------------------------------------------------------------

TEST_F(ImageFiles, WholeNumbersOf32BitsAreExact) {
  const ExrPart::Box one{0, 0, 0, 0};
  const auto id = [&](double value) {
    return opened(std::to_string(value) + ".exr", exr_bytes({{{channel("id", {value}, 0)}, one, one}}));
  };
  for (const double value : {0.0, 1.0, 16777217.0, 4294967295.0}) {
    EXPECT_TRUE(comparison::compare(id(value), id(value), 0).agrees()) << value;
    const double next = value == 0 ? 1 : value - 1;
    const auto c = comparison::compare(id(value), id(next), 1e-6);
    EXPECT_FALSE(c.agrees()) << value;
    EXPECT_EQ(c.max_error, 1) << value;
  }
}

TEST_F(ImageFiles, WholeNumbersOfTiffAreExactToo) {
  const auto page = [](std::uint32_t value, std::uint16_t format) {
    return tiff_bytes({{1, 1, 32, format, 1, 1, -1, little(value)}});
  };
  const auto difference = [&](std::uint16_t format) {
    return comparison::compare(opened("a.tif", page(0xfffffff0U, format)),
                               opened("b.tif", page(0xffffffefU, format)), 1e-6);
  };
  EXPECT_EQ(difference(1).max_error, 1);
  EXPECT_FALSE(difference(1).agrees());
  EXPECT_EQ(difference(2).max_error, 1);
  EXPECT_EQ(values("minus.tif", page(0xfffffff0U, 2)), std::vector<float>{-16});
}

// --- windows, parts, pages -------------------------------------------------------------------------------

TEST_F(ImageFiles, OutsideOfTheDataWindowIsBlack) {
  const PixelRows rows = opened("a.exr", exr_bytes({{{channel("Y", {5})}, {1, 1, 1, 1}, {0, 0, 2, 1}}}));
  EXPECT_EQ(image_of(rows).values, (std::vector<float>{0, 0, 0, 0, 5, 0}));
  EXPECT_EQ(rows.contents.not_read,
            Names{"5 pixels outside its data window, which it does not hold: taken as 0"});
}

TEST_F(ImageFiles, WhatFollowsThePictureIsSaid) {
  const std::string file = png(8, 2, "abc");
  EXPECT_EQ(opened("a.png", file).contents.not_read, Names{});
  EXPECT_EQ(opened("b.png", file + file).contents.not_read,
            Names{std::to_string(file.size()) + " bytes after the picture"});
}

TEST_F(ImageFiles, PixelsBeyondTheDisplayWindowAreThereToo) {
  const PixelRows beyond =
      opened("a.exr", exr_bytes({{{channel("Y", {5, 6})}, {-1, 0, 0, 0}, {0, 0, 0, 0}}}));
  EXPECT_EQ(image_of(beyond).values, (std::vector<float>{5, 6}));
  const PixelRows after = opened("b.exr", exr_bytes({{{channel("Y", {5, 6})}, {0, 0, 1, 0}, {0, 0, 0, 0}}}));
  const auto mismatch = comparison::shape_mismatch(beyond, after);
  ASSERT_TRUE(mismatch);
  EXPECT_NE(mismatch->find("(-1,0)-(0,0)"), std::string::npos) << *mismatch;
  EXPECT_NE(mismatch->find("(0,0)-(1,0)"), std::string::npos) << *mismatch;
}

TEST_F(ImageFiles, FurtherPartsAreNamedAndCanBeChosen) {
  const ExrPart::Box one{0, 0, 0, 0};
  const std::string file =
      exr_bytes({{{channel("Y", {5})}, one, one, "beauty"}, {{channel("Z", {7})}, one, one, "depth"}});
  const PixelRows first = opened("a.exr", file);
  EXPECT_EQ(first.contents.part, "beauty");
  EXPECT_EQ(first.contents.not_read, Names{"part 'depth' (2 of 2)"});
  for (const std::string part : {"depth", "2"}) {
    const PixelRows second = opened("a.exr", file, {part, {}});
    EXPECT_EQ(image_of(second).values, std::vector<float>{7});
    EXPECT_EQ(second.contents.channels, Names{"Z"});
  }
  EXPECT_NE(complaint("a.exr", file, {"colour", {}}).find("expected one of 'beauty', 'depth'"),
            std::string::npos);
}

TEST_F(ImageFiles, FurtherPagesAreNamedAndCanBeChosen) {
  TiffPage first, second;
  first.pixels = std::string(3, '\0');
  second.pixels = std::string(3, '\xff');
  const std::string file = tiff_bytes({first, second});
  EXPECT_EQ(opened("a.tif", file).contents.not_read, Names{"page 2 of 2"});
  EXPECT_EQ(image_of(opened("a.tif", file, {"2", {}})).values, (std::vector<float>{1, 1, 1}));
  EXPECT_NE(complaint("a.tif", file, {"3", {}}).find("expected a page from 1 to 2"), std::string::npos);
}

// --- names of channels -----------------------------------------------------------------------------------

TEST_F(ImageFiles, ChannelsOfALayerComeInTheOrderOfColours) {
  EXPECT_EQ(opened("a.exr", exr_of({"LeB", "LeG", "LeR"})).contents.channels, (Names{"LeR", "LeG", "LeB"}));
  EXPECT_EQ(opened("b.exr", exr_of({"A", "B", "G", "R", "Z"})).contents.channels,
            (Names{"R", "G", "B", "A", "Z"}));
  EXPECT_EQ(opened("c.exr", exr_of({"B", "G", "R", "d.B", "d.G", "d.R"})).contents.channels,
            (Names{"R", "G", "B", "d.R", "d.G", "d.B"}));
  EXPECT_EQ(image_of(opened("d.exr", exr_of({"LeB", "LeG", "LeR"}))).values,
            (std::vector<float>{5, 3, 1, 6, 4, 2}));
}

TEST_F(ImageFiles, OtherChannelsAreRefusedByTheirNames) {
  const PixelRows alpha = opened("a.exr", exr_of({"A", "B", "G", "R"}));
  const PixelRows depth = opened("z.exr", exr_of({"B", "G", "R", "Z"}));
  const PixelRows colour = opened("c.exr", exr_of({"B", "G", "R"}));
  EXPECT_TRUE(comparison::shape_mismatch(alpha, depth));
  EXPECT_FALSE(comparison::shape_mismatch(colour, opened("l.exr", exr_of({"LeB", "LeG", "LeR"}))));
  EXPECT_NE(comparison::shape_mismatch(colour, depth)->find("a depth channel (Z)"), std::string::npos);
  EXPECT_NE(comparison::shape_mismatch(colour, alpha)->find("an alpha channel"), std::string::npos);
}

TEST_F(ImageFiles, AnOpaqueAlphaIsLeftOutOnEitherSideAndSaid) {
  PixelRows colour = opened("a.png", png(8, 2, "abc"));
  PixelRows opaque = opened("b.png", png(8, 6, "abc\xff"));
  comparison::leave_out_opaque_alpha(colour, opaque);
  EXPECT_FALSE(comparison::shape_mismatch(colour, opaque));
  EXPECT_TRUE(comparison::compare(colour, opaque, 0).agrees());
  EXPECT_EQ(opaque.contents.not_read.size(), 1U);
  PixelRows translucent = opened("c.png", png(8, 6, "abc\xfe"));
  comparison::leave_out_opaque_alpha(translucent, colour);
  EXPECT_TRUE(comparison::shape_mismatch(translucent, colour));
}

TEST_F(ImageFiles, ChannelsCanBeChosenByName) {
  const PixelRows rows = opened("a.exr", exr_of({"B", "G", "R", "Z"}), {"", {"Z", "R"}});
  EXPECT_EQ(image_of(rows).values, (std::vector<float>{7, 5, 8, 6}));
  EXPECT_EQ(rows.contents.not_read, (Names{"channel G", "channel B"}));
  EXPECT_NE(complaint("a.exr", exr_of({"B", "G", "R"}), {"", {"Z"}}).find("expected some of R, G, B"),
            std::string::npos);
}

// --- Netpbm ------------------------------------------------------------------------------------------------

TEST_F(ImageFiles, NetpbmOfAllSixTypesIsRead) {
  EXPECT_EQ(values("a.pbm", "P1\n4 1\n1010\n"), (std::vector<float>{0, 1, 0, 1}));
  EXPECT_EQ(values("a.pbm", "P1 4 1 1 0\n1 0"), (std::vector<float>{0, 1, 0, 1}));
  EXPECT_EQ(values("a.pbm", "P4\n4 1\n\xa0"), (std::vector<float>{0, 1, 0, 1}));
  EXPECT_EQ(values("a.pgm", "P2\n2 1\n5\n1 5\n"), (std::vector<float>{0.2F, 1}));
  EXPECT_EQ(values("a.pgm", "P5\n2 1\n5\n\1\5"), (std::vector<float>{0.2F, 1}));
  EXPECT_EQ(values("a.ppm", "P3\n1 1\n5\n1 5 +0\n"), (std::vector<float>{0.2F, 1, 0}));
  EXPECT_EQ(values("a.ppm", std::string("P6\n1 1\n5\n\1\5\0", 12)), (std::vector<float>{0.2F, 1, 0}));
}

TEST_F(ImageFiles, ValuesAboveTheLargestAreRefusedInBytesAsInText) {
  for (const std::string bytes : {"P6\n1 1\n100\naaz", "P3\n1 1\n100\n97 97 122", "P5\n1 1\n100\nz"})
    expect_refused("a.ppm", bytes, {"found value 122, expected 0 to 100"});
}

TEST_F(ImageFiles, ASignedScaleIsRead) {
  EXPECT_EQ(values("a.pfm", "Pf\n1 1\n+1.0\n" + std::string("\x3f\x80\0\0", 4)), std::vector<float>{1});
}

TEST_F(ImageFiles, WindowsLinesAndOtherEncodingsAreNamed) {
  expect_refused("a.pfm", "PF\r\n1 1\r\n-1\r\n" + std::string(12, '\0'), {"CR LF", "binary mode"});
  expect_refused("a.ppm", "P6\r\n1 1\r\n255\r\nabc", {"CR LF", "binary mode"});
  EXPECT_EQ(values("a.ppm", "P6\n1 1\n255\r\nab").size(), 3U) << "one white space ends the header";
  EXPECT_EQ(values("a.ppm", "P3\r\n1 1\r\n255\r\n0 0 255\r\n"), (std::vector<float>{0, 0, 1}));
  expect_refused("a.ppm", std::string("\xff\xfeP\0003\0\n\0", 8), {"UTF-16", "PowerShell"});
  expect_refused("a.ppm", "\xef\xbb\xbfP3\n1 1\n255\n0 0 0\n", {"UTF-8", "byte order mark"});
}

// --- what isn't opened
// --------------------------------------------------------------------------------------

/// The reader of icons in OpenImageIO aborted on such: it is not asked any more, whatever the name says.
TEST_F(ImageFiles, AnIconIsNamedWhateverItsNameSays) {
  const std::string icon = std::string("\0\0\1\0\1\0", 6) + std::string(136, '\xff');
  for (const std::string name : {"a.ico", "a.png", "a.tif", "a.exr", "a.bmp", "a"})
    expect_refused(name, icon, {"cannot be read", "an ICO file"});
}

TEST_F(ImageFiles, SizesAreCheckedBeforeAnythingIsDecoded) {
  const std::string row = std::string(100 * 3, 'x');
  ReadRequest request;
  request.most_pixels = 99;
  try {
    opened("a.png", png(8, 2, row, 100), request);
    FAIL() << "too large, but read";
  } catch (const PictureTooLarge& error) {
    EXPECT_EQ(error.width, 100);
    EXPECT_EQ(error.height, 1);
  }
  PngFile lie{16383, 16384, 8, 2, false, {row}};
  expect_refused("lie.png", lie.bytes(), {"16383 x 16384", "expected at most"});
  lie.width = lie.height = 10'000;
  expect_refused("lie.png", lie.bytes(), {"too few"});
}

// --- mutants
// -------------------------------------------------------------------------------------------------

/// A few bytes of a file changed, mostly near its beginning.
std::string mutant(std::string bytes, std::mt19937& random) {
  const auto below = [&](std::size_t end) { return random() % end; };
  for (std::size_t changes = 1 + below(6); changes > 0; --changes) {
    const std::size_t at =
        below(3) == 0 ? below(bytes.size()) : below(std::min<std::size_t>(bytes.size(), 300));
    if (below(8) == 0)
      bytes.erase(at, 1 + below(8));
    else
      bytes[at] = below(4) == 0 ? '\xff' : static_cast<char>(random());
    if (bytes.empty()) return "x";
  }
  return bytes;
}

TEST_F(ImageFiles, MutantsAreReadOrRefusedAndNothingElse) {
  TiffPage page{4, 4, 16, 1, 2, 3, -1, std::string(96, '\x42')};
  const ExrPart::Box box{0, 0, 1, 0};
  const std::vector<std::pair<std::string, std::string>> files{
      {"a.exr", exr_of({"B", "G", "R"})},
      {"b.exr", exr_bytes({{{channel("id", {1, 2}, 0)}, {0, 0, 1, 0}, {0, 0, 3, 3}, "a"},
                           {{channel("Y", {1, 2})}, box, box, "b"}})},
      {"a.tif", tiff_bytes({page, page})},
      {"a.png", PngFile{4, 2, 16, 6, false, {std::string(32, 'x'), std::string(32, 'y')}}.bytes()},
      {"a.pfm", "PF\n2 1\n-1\n" + std::string(24, '\x3e')},
      {"a.ppm", "P6\n2 1\n255\nabcdef"},
      {"b.ppm", "P3\n2 1\n255\n1 2 3 4 5 6\n"}};
  std::mt19937 random(15);
  constexpr int mutants = 210;
  for (int i = 0; i < mutants; ++i) {
    const auto& [name, bytes] = files[static_cast<std::size_t>(i) % files.size()];
    const std::string said = complaint(name, mutant(bytes, random));
    EXPECT_TRUE(said.empty() || said.find(name) != std::string::npos) << i << ": " << said;
  }
}

}  // namespace
}  // namespace plumb::tests
