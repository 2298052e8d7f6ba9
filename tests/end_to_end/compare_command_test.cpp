// `plumb compare`: figures that can be computed by hand, and files that are none.
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "tests/support/end_to_end.hpp"

namespace plumb::tests {
namespace {

using Json = nlohmann::json;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

std::string bytes_of(float value, bool big_endian) {
  auto bits = std::bit_cast<std::uint32_t>(value);
  if (big_endian) bits = __builtin_bswap32(bits);
  std::string bytes(sizeof bits, '\0');
  std::memcpy(bytes.data(), &bits, sizeof bits);
  return bytes;
}

/// Rows from the top in `values`, from the bottom in the file.
std::string pfm(int width, int height, const std::vector<float>& values, int channels = 3,
                bool big_endian = false) {
  std::string bytes = std::string(channels == 3 ? "PF" : "Pf") + "\n" + std::to_string(width) + " " +
                      std::to_string(height) + "\n" + (big_endian ? "1.0" : "-1.0") + "\n";
  const auto row = static_cast<std::size_t>(width * channels);
  for (std::size_t y = static_cast<std::size_t>(height); y-- > 0;) {
    for (std::size_t i = 0; i < row; ++i) bytes += bytes_of(values.at(y * row + i), big_endian);
  }
  return bytes;
}

class Compare : public testing::Test {
 protected:
  Outcome compare(const std::string& reference, const std::string& test,
                  std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"compare", reference, test});
    return run_plumb(more, workplace_.directory());
  }
  Json compare_json(const std::string& reference, const std::string& test,
                    std::vector<std::string> more = {}) const {
    more.insert(more.end(), {"--json", "-"});
    const Outcome outcome = compare(reference, test, more);
    EXPECT_TRUE(Json::accept(outcome.out)) << outcome.out << outcome.err;
    return Json::parse(outcome.out, nullptr, false);
  }
  void expect_equal(const std::string& reference, const std::string& test,
                    const std::string& tolerance = "0") const {
    const Outcome outcome = compare(reference, test, {"--tolerance", tolerance});
    EXPECT_EQ(outcome.exit_code, 0) << reference << " " << test << ": " << outcome.out << outcome.err;
  }
  void file(const std::string& name, const std::string& bytes) const { workplace_.file(name, bytes); }
  /// 3 x 2 pixels: the reference, and a test picture that differs by 0.5, 0.25 and -1.
  void two_pictures() const {
    file("reference.pfm", pfm(3, 2,
                              {0, 0, 0, 1, 1, 1, 2, 2, 2,  //
                               0, 0, 0, 0, 0, 0, 8, 8, 8}));
    file("test.pfm", pfm(3, 2,
                         {0, 0, 0.5, 1, 1, 1, 2, 2, 2,  //
                          0, 0.25, 0, 0, 0, 0, 8, 7, 8}));
  }

  Workplace workplace_;
};

// --- figures --------------------------------------------------------------------------------------

TEST_F(Compare, APictureAgreesWithItself) {
  two_pictures();
  const Outcome outcome = compare("reference.pfm", "reference.pfm", {"--tolerance", "0"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_TRUE(contains(outcome.out, "max error    0\n")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "pixels over  0 of 6\n")) << outcome.out;
  EXPECT_TRUE(outcome.out.ends_with("agree\n")) << outcome.out;
}

TEST_F(Compare, FiguresAreThoseComputedByHand) {
  two_pictures();
  const Json json = compare_json("reference.pfm", "test.pfm");
  EXPECT_EQ(json.at("width"), 3);
  EXPECT_EQ(json.at("height"), 2);
  EXPECT_EQ(json.at("max_error"), 1.0);
  EXPECT_DOUBLE_EQ(json.at("mean_error"), 1.75 / 18);
  EXPECT_DOUBLE_EQ(json.at("rms_error"), std::sqrt((0.25 + 0.0625 + 1) / 18));
  EXPECT_EQ(json.at("pixels_over"), 3);
  EXPECT_EQ(json.at("non_finite"), 0);
  EXPECT_EQ(json.at("status"), "differ");
}

/// Above 1 errors count relatively: 7 for 8 is off by 1/8, the 0.5 in the first row by more.
TEST_F(Compare, TheWorstPixelIsFarthestBeyondItsTolerance) {
  two_pictures();
  const Json worst = compare_json("reference.pfm", "test.pfm").at("worst");
  EXPECT_EQ(worst.at("x"), 0);
  EXPECT_EQ(worst.at("y"), 0);
  EXPECT_EQ(worst.at("test"), (std::vector<float>{0, 0, 0.5F}));
  EXPECT_EQ(worst.at("reference"), (std::vector<float>{0, 0, 0}));
}

TEST_F(Compare, RowsCountFromTheTop) {
  file("black.pfm", pfm(2, 3, std::vector<float>(18, 0)));
  std::vector<float> one(18, 0);
  one[3 * (2 * 2 + 1)] = 1;  // x = 1, y = 2
  file("one.pfm", pfm(2, 3, one));
  const Json worst = compare_json("black.pfm", "one.pfm").at("worst");
  EXPECT_EQ(worst.at("x"), 1);
  EXPECT_EQ(worst.at("y"), 2);
}

TEST_F(Compare, AnErrorOfExactlyTheToleranceAgrees) {
  two_pictures();
  EXPECT_EQ(compare_json("reference.pfm", "test.pfm", {"--tolerance", "0.5"}).at("pixels_over"), 0);
  EXPECT_EQ(compare("reference.pfm", "test.pfm", {"--tolerance", "0.5"}).exit_code, 0);
  EXPECT_EQ(compare_json("reference.pfm", "test.pfm", {"--tolerance", "0.25"}).at("pixels_over"), 1);
  EXPECT_EQ(compare_json("reference.pfm", "test.pfm", {"--tolerance", "0.125"}).at("pixels_over"), 2);
  EXPECT_EQ(compare_json("reference.pfm", "test.pfm", {"--tolerance", "0.1249"}).at("pixels_over"), 3);
  EXPECT_EQ(compare("reference.pfm", "test.pfm", {"--tolerance", "0.4999"}).exit_code, 1);
}

TEST_F(Compare, TextSaysWhatJsonSays) {
  two_pictures();
  const Outcome outcome = compare("reference.pfm", "test.pfm");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.out,
            "max error    1\n"
            "mean error   0.0972222222\n"
            "RMS error    0.270030862\n"
            "pixels over  3 of 6\n"
            "worst pixel  (0, 0): test 0 0 0.5, reference 0 0 0\n"
            "differ\n");
}

TEST_F(Compare, NonFinitePixelsAreCountedFirstAndAlwaysDiffer) {
  file("finite.pfm", pfm(3, 1, {0, 0, 0, 1, 1, 1, 2, 2, 2}));
  file("bad.pfm", pfm(3, 1, {0, 0, 0.5, nan, 1, 1, 2, -infinity, infinity}));
  const Json json = compare_json("finite.pfm", "bad.pfm", {"--tolerance", "1000"});
  EXPECT_EQ(json.at("status"), "differ");
  EXPECT_EQ(json.at("non_finite"), 2);
  EXPECT_EQ(json.at("pixels_over"), 2);
  EXPECT_EQ(json.at("max_error"), 0.5);
  EXPECT_EQ(json.at("worst").at("x"), 1);
  EXPECT_TRUE(json.at("worst").at("test").at(0).is_null()) << "JSON has no NaN";
  const Outcome outcome = compare("finite.pfm", "bad.pfm", {"--tolerance", "1000"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(outcome.out.starts_with("not finite   2 pixels\n")) << outcome.out;
}

TEST_F(Compare, TheSameNanOnBothSidesStillDiffers) {
  for (const float value : {nan, infinity}) {
    file("bad.pfm", pfm(1, 1, {0, value, 0}));
    const Json json = compare_json("bad.pfm", "bad.pfm");
    EXPECT_EQ(json.at("non_finite"), 1);
    EXPECT_EQ(compare("bad.pfm", "bad.pfm").exit_code, 1);
  }
}

TEST_F(Compare, AWrongReferenceIsFoundToo) {
  file("finite.pfm", pfm(1, 1, {0, 0, 0}));
  file("bad.pfm", pfm(1, 1, {0, 0, nan}));
  EXPECT_EQ(compare_json("bad.pfm", "finite.pfm").at("non_finite"), 1);
}

TEST_F(Compare, JsonHasTheKeysOfVerifyAndNamesTheFiles) {
  two_pictures();
  const Json json = compare_json("reference.pfm", "test.pfm", {"--tolerance", "0.001"});
  EXPECT_EQ(json.at("tool"), "plumb");
  EXPECT_EQ(json.at("version"), PLUMB_VERSION);
  EXPECT_EQ(json.at("reference"), "reference.pfm");
  EXPECT_EQ(json.at("test"), "test.pfm");
  EXPECT_EQ(json.at("tolerance"), 0.001);
  for (const char* const key :
       {"max_error", "mean_error", "rms_error", "pixels_over", "non_finite", "worst"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
}

TEST_F(Compare, JsonInAFileIsBesideTheText) {
  two_pictures();
  const Outcome outcome = compare("reference.pfm", "test.pfm", {"--json", "result.json"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(contains(outcome.out, "pixels over  3 of 6")) << outcome.out;
  EXPECT_EQ(Json::parse(read_file(workplace_.path("result.json"))).at("pixels_over"), 3);
}

// --- formats --------------------------------------------------------------------------------------

TEST_F(Compare, PfmIsReadInBothByteOrders) {
  const std::vector<float> values{0, 0.1F, 1e-30F, -5, 1e30F, 0.5F};
  file("little.pfm", pfm(2, 1, values));
  file("big.pfm", pfm(2, 1, values, 3, true));
  expect_equal("little.pfm", "big.pfm");
}

TEST_F(Compare, GreyPfmHasOneChannel) {
  file("a.pfm", pfm(2, 1, {0, 1}, 1));
  file("b.pfm", pfm(2, 1, {0, 0.75F}, 1));
  const Json json = compare_json("a.pfm", "b.pfm");
  EXPECT_EQ(json.at("max_error"), 0.25);
  EXPECT_EQ(json.at("mean_error"), 0.125);
  EXPECT_EQ(json.at("worst").at("test"), (std::vector<float>{0.75F}));
}

TEST_F(Compare, EveryKindOfPpmCountsFromZeroToOne) {
  file("float.pfm", pfm(2, 1, {0, 51 / 255.0F, 1, 1, 0, 102 / 255.0F}));
  file("ascii.ppm", "P3\n2 1\n255\n0 51 255\n255 0 102\n");
  file("comments.ppm", "P3 # made\n# by hand\n2 1 #size\n255\n0 51 255 # first\n255 0 102");
  file("fifths.ppm", "P3\n2 1\n5\n0 1 5 5 0 2\n");
  file("binary.ppm", std::string("P6\n2 1\n255\n\x00\x33\xff\xff\x00\x66", 17));
  file("wide.ppm", std::string("P6\n2 1\n65535\n\x00\x00\x33\x33\xff\xff\xff\xff\x00\x00\x66\x66", 25));
  for (const char* const name : {"ascii.ppm", "comments.ppm", "binary.ppm"}) expect_equal("float.pfm", name);
  for (const char* const name : {"fifths.ppm", "wide.ppm"}) expect_equal("float.pfm", name, "1e-7");
}

TEST_F(Compare, RenderedFilesOfAllFormatsCanBeCompared) {
  file("ball.sdf", std::string(ball_scene));
  for (const char* const name : {"ball.pfm", "ball.exr", "ball.ppm", "ball.png"}) {
    ASSERT_EQ(run_plumb({"render", "ball.sdf", "-o", name}, workplace_.directory()).exit_code, 0);
  }
  ASSERT_EQ(run_plumb({"render", "ball.sdf", "-o", "srgb.ppm", "--encode", "srgb"}, workplace_.directory())
                .exit_code,
            0);
  expect_equal("ball.pfm", "ball.exr");
  expect_equal("ball.exr", "ball.pfm");
  expect_equal("srgb.ppm", "ball.png", "1e-6");
  EXPECT_EQ(compare("ball.ppm", "ball.png").exit_code, 1) << "another encoding";
}

TEST_F(Compare, FiguresAreThoseOfIdiff) {
  const std::string idiff = system::find_program("idiff");
  if (idiff.empty()) GTEST_SKIP() << "idiff (openimageio-tools) is not installed";
  std::vector<float> reference;
  std::vector<float> test;
  for (int i = 0; i < 3 * 8 * 5; ++i) {
    reference.push_back(static_cast<float>(i % 7) / 8);
    test.push_back(reference.back() + static_cast<float>(i % 11) / 1024);
  }
  file("reference.pfm", pfm(8, 5, reference));
  file("test.pfm", pfm(8, 5, test));
  const auto theirs = run_shell("'" + idiff + "' reference.pfm test.pfm", workplace_.directory());
  const auto figure = [&](const std::string& name) {
    const std::size_t line = theirs.output.find(name);
    const std::size_t at = theirs.output.find('=', std::min(line, theirs.output.size()));
    EXPECT_NE(at, std::string::npos) << theirs.output;
    return at == std::string::npos ? 0 : std::stod(theirs.output.substr(at + 1));
  };
  const Json ours = compare_json("reference.pfm", "test.pfm");
  constexpr double as_printed = 1e-5;  // six digits
  EXPECT_NEAR(ours.at("mean_error").get<double>() / figure("Mean error"), 1, as_printed);
  EXPECT_NEAR(ours.at("rms_error").get<double>() / figure("RMS error"), 1, as_printed);
  EXPECT_NEAR(ours.at("max_error").get<double>() / figure("Max error"), 1, as_printed);
}

// --- accidents are caught and named ----------------------------------------------------------------

struct Accident {
  std::string name;  // of the test and, in snake case, of the cause
  std::string cause;
  std::string word;
  std::function<float(const std::vector<float>& picture, int x, int y, int c)> test;
};
void PrintTo(const Accident& accident, std::ostream* out) { *out << accident.name; }

constexpr int wide = 70;  // more than the 64 that causes are tried out on at once
constexpr int high = 18;

/// Linear colours below and above 1, no two pixels alike.
std::vector<float> colourful() {
  std::vector<float> values;
  for (int i = 0; i < 3 * wide * high; ++i) values.push_back(static_cast<float>(i * 7919 % 1297) / 1000.0F);
  return values;
}
float value_at(const std::vector<float>& picture, int x, int y, int c) {
  if (x < 0 || y < 0 || x >= wide || y >= high) return 0;
  return picture[static_cast<std::size_t>(3 * (y * wide + x) + c)];
}
float srgb(float v) { return v <= 0.0031308F ? 12.92F * v : 1.055F * std::pow(v, 1 / 2.4F) - 0.055F; }
float at_most_one(float v) { return std::min(v, 1.0F); }

class Named : public Compare, public testing::WithParamInterface<Accident> {};
INSTANTIATE_TEST_SUITE_P(
    Is, Named,
    testing::ValuesIn(std::vector<Accident>{
        {"FlippedRows", "rows_flipped", "rows are flipped",
         [](const auto& p, int x, int y, int c) { return value_at(p, x, high - 1 - y, c); }},
        {"MirroredColumns", "columns_mirrored", "columns are mirrored",
         [](const auto& p, int x, int y, int c) { return value_at(p, wide - 1 - x, y, c); }},
        {"ChannelSwap", "channels_swapped", "BGR",
         [](const auto& p, int x, int y, int c) { return value_at(p, x, y, 2 - c); }},
        {"ShiftRight", "shifted", "to the right (",
         [](const auto& p, int x, int y, int c) { return value_at(p, x - 1, y, c); }},
        {"ShiftUp", "shifted", "one pixel: up",
         [](const auto& p, int x, int y, int c) { return value_at(p, x, y + 1, c); }},
        {"ShiftLeftAndDown", "shifted", "to the left and down",
         [](const auto& p, int x, int y, int c) { return value_at(p, x + 1, y - 1, c); }},
        {"GammaEncoded", "srgb_encoded", "gamma-encoded",
         [](const auto& p, int x, int y, int c) { return srgb(value_at(p, x, y, c)); }},
        {"ToneMapped", "tone_mapped", "tone-mapped",
         [](const auto& p, int x, int y, int c) {
           return value_at(p, x, y, c) / (value_at(p, x, y, c) + 1);
         }},
        {"Half", "half", "half floats",
         [](const auto& p, int x, int y, int c) {
           // 11 bits, the nearest: the values are normal halves. Ties do not occur.
           const float v = value_at(p, x, y, c);
           const float step = std::ldexp(1.0F, v == 0 ? 0 : std::ilogb(v) - 10);
           return std::round(v / step) * step;
         }},
        {"RoundedTo8Bits", "rounded_to_8_bits", "because half a step",
         [](const auto& p, int x, int y, int c) {
           return std::round(at_most_one(value_at(p, x, y, c)) * 255) / 255;
         }},
        {"TruncatedTo8Bits", "truncated_to_8_bits", "because a step",
         [](const auto& p, int x, int y, int c) {
           return std::floor(at_most_one(value_at(p, x, y, c)) * 255) / 255;
         }},
        {"GammaEncodedAndRounded", "srgb_encoded_rounded_to_8_bits", "gamma-encoded (sRGB) and rounded",
         [](const auto& p, int x, int y, int c) {
           return std::round(srgb(at_most_one(value_at(p, x, y, c))) * 255) / 255;
         }},
    }),
    [](const auto& test) { return test.param.name; });

TEST_P(Named, AndFailsTheComparison) {
  const std::vector<float> reference = colourful();
  std::vector<float> test;
  for (int y = 0; y < high; ++y)
    for (int x = 0; x < wide; ++x)
      for (int c = 0; c < 3; ++c) test.push_back(GetParam().test(reference, x, y, c));
  file("reference.pfm", pfm(wide, high, reference));
  file("test.pfm", pfm(wide, high, test));
  const Json json = compare_json("reference.pfm", "test.pfm", {"--tolerance", "1e-5"});
  EXPECT_EQ(json.at("status"), "differ");
  ASSERT_TRUE(json.contains("likely_cause"));
  EXPECT_EQ(json.at("likely_cause").at("name"), GetParam().cause);
  EXPECT_EQ(json.at("likely_cause").at("pixels_over"), 0);
  const Outcome outcome = compare("reference.pfm", "test.pfm", {"--tolerance", "1e-5"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(contains(outcome.out, "likely cause: ")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, GetParam().word)) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "(then 0 pixels over")) << outcome.out;
}

TEST_F(Compare, SixteenBitFilesOfAFloatPictureAreNamed) {
  const std::string tool = system::find_program("oiiotool");
  if (tool.empty()) GTEST_SKIP() << "oiiotool (openimageio-tools) is not installed";
  file("a.pfm", pfm(wide, high, colourful()));
  for (const std::string name : {"a.png", "a.tif"}) {
    run_shell("'" + tool + "' a.pfm -d uint16 -o " + name, workplace_.directory());
    const Json json = compare_json("a.pfm", name);
    ASSERT_TRUE(json.contains("likely_cause")) << name;
    EXPECT_EQ(json.at("likely_cause").at("name"), "rounded_to_16_bits") << name;
    EXPECT_TRUE(contains(compare("a.pfm", name).out, "rounded to 16 bits (then 0 pixels over")) << name;
  }
}

TEST_F(Compare, MostOfTheErrorGoneIsSaidWithWhatIsLeft) {
  const std::vector<float> reference = colourful();
  std::vector<float> test;
  for (int y = 0; y < high; ++y)
    for (int x = 0; x < wide; ++x)
      for (int c = 0; c < 3; ++c) test.push_back(value_at(reference, x, high - 1 - y, c));
  test[5] += 0.25F;
  file("reference.pfm", pfm(wide, high, reference));
  file("test.pfm", pfm(wide, high, test));
  EXPECT_EQ(compare_json("reference.pfm", "test.pfm").at("likely_cause").at("pixels_over"), 1);
  EXPECT_TRUE(
      contains(compare("reference.pfm", "test.pfm").out, "rows are flipped (then 1 pixels over, 99.9"));
}

TEST_F(Compare, OtherDifferencesAreGivenNoCause) {
  const std::vector<float> reference = colourful();
  for (const int kind : {0, 1, 2, 3}) {
    std::vector<float> test = reference;
    for (std::size_t i = 0; i < test.size(); ++i) {
      if (kind == 0) test[i] *= 1.01F;
      if (kind == 1) test[i] += static_cast<float>(i % 5) / 1000;
      if (kind == 2 && i / 3 % wide == 0) test[i] += 0.5F;  // a column that a shift would lose
      if (kind == 3 && i == 100) test[i] += 1;
    }
    file("reference.pfm", pfm(wide, high, reference));
    file("test.pfm", pfm(wide, high, test));
    EXPECT_FALSE(compare_json("reference.pfm", "test.pfm").contains("likely_cause")) << kind;
  }
}

TEST_F(Compare, NothingIsNamedWhenThePicturesAgree) {
  file("a.pfm", pfm(wide, high, colourful()));
  EXPECT_FALSE(compare_json("a.pfm", "a.pfm").contains("likely_cause"));
}

TEST_F(Compare, EveryKindOfNonFiniteValueIsCounted) {
  for (const auto& [r, t] : {std::pair{0.5F, nan},
                             {nan, 0.5F},
                             {nan, nan},
                             {0.5F, infinity},
                             {0.5F, -infinity},
                             {infinity, infinity},
                             {infinity, -infinity},
                             {-infinity, nan}}) {
    std::vector<float> reference(3 * 16 * 2, 0.5F), test = reference;
    reference[43] = r;
    test[43] = t;
    file("reference.pfm", pfm(16, 2, reference));
    file("test.pfm", pfm(16, 2, test));
    const Json json = compare_json("reference.pfm", "test.pfm", {"--tolerance", "1e30"});
    EXPECT_EQ(json.at("non_finite"), 1) << r << " " << t;
    EXPECT_EQ(json.at("pixels_over"), 1) << r << " " << t;
    EXPECT_EQ(json.at("status"), "differ") << r << " " << t;
    EXPECT_EQ(json.at("worst").at("x"), 14);
  }
}

TEST_F(Compare, TransposedSizesAreNamed) {
  file("a.pfm", pfm(4, 3, std::vector<float>(36, 0)));
  file("b.pfm", pfm(3, 4, std::vector<float>(36, 0)));
  expect_trouble(compare("a.pfm", "b.pfm"), {"b.pfm", "3 x 4", "4 x 3", "likely cause", "transposed"});
}

TEST_F(Compare, AlphaIsNamed) {
  const std::string oiiotool = system::find_program("oiiotool");
  if (oiiotool.empty()) GTEST_SKIP() << "oiiotool (openimageio-tools) is not installed";
  run_shell("'" + oiiotool + "' --create 5x4 3 -d uint8 -o rgb.png && '" + oiiotool +
                "' --create 5x4 4 -d uint8 -o rgba.png",
            workplace_.directory());
  expect_trouble(compare("rgb.png", "rgba.png"), {"rgba.png", "4 channels", "the test picture has an alpha"});
  expect_trouble(compare("rgba.png", "rgb.png"), {"rgb.png", "3 channels", "the reference has an alpha"});
}

class EmptyFile : public Compare, public testing::WithParamInterface<Word> {};
INSTANTIATE_TEST_SUITE_P(Of, EmptyFile,
                         testing::Values(Word{"pfm"}, Word{"ppm"}, Word{"exr"}, Word{"png"}, Word{"tif"},
                                         Word{"jpg"}),
                         [](const auto& test) { return std::string(test.param.text); });

TEST_P(EmptyFile, IsNamedAndSoIsWhatWasExpected) {
  const std::string kind = GetParam().text, name = "empty." + kind;
  std::string upper = kind;
  std::transform(kind.begin(), kind.end(), upper.begin(),
                 [](char c) { return static_cast<char>(c - 'a' + 'A'); });
  file("a.pfm", pfm(1, 1, {0, 0, 0}));
  file(name, "");
  const Outcome outcome = compare("a.pfm", name);
  expect_trouble(outcome,
                 {name + ": cannot be read: the file is empty (0 bytes), expected an image (" + upper + ")"});
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  expect_trouble(compare(name, "a.pfm"), {name, "is empty"});
}

TEST_F(Compare, AnEmptyFileOfNoKindIsNamedToo) {
  file("empty", "");
  expect_trouble(compare("empty", "empty"),
                 {"empty: cannot be read: the file is empty (0 bytes), expected an image"});
}

// --- metrics ----------------------------------------------------------------------------------------

TEST_F(Compare, MetricsAreToldOnDemand) {
  file("a.pfm", pfm(wide, high, colourful()));
  std::vector<float> test = colourful();
  for (float& v : test) v += 0.125F;
  file("b.pfm", pfm(wide, high, test));
  EXPECT_FALSE(compare_json("a.pfm", "b.pfm").contains("metrics"));
  const Json metrics = compare_json("a.pfm", "b.pfm", {"--metrics"}).at("metrics");
  EXPECT_NEAR(metrics.at("bias").at(1).get<double>(), 0.125, 1e-6);
  EXPECT_NEAR(metrics.at("percentiles").at("p99.9").get<double>(), 0.125, 1e-6);
  EXPECT_EQ(metrics.at("flip").at("kind"), "HDR");
  const std::string text = compare("a.pfm", "b.pfm", {"--metrics"}).out;
  for (const char* const name : {"peak", "PSNR", "percentiles", "bias", "SSIM", "FLIP"})
    EXPECT_TRUE(contains(text, name)) << text;
}

TEST_F(Compare, EightBitFilesGetLdrFlip) {
  file("a.ppm", "P3\n1 1\n255\n0 0 0\n");
  file("b.ppm", "P3\n1 1\n255\n255 255 255\n");
  const Json flip = compare_json("a.ppm", "b.ppm", {"--metrics"}).at("metrics").at("flip");
  EXPECT_EQ(flip.at("kind"), "LDR");
  EXPECT_NEAR(flip.at("mean").get<double>(), 0.96739, 1e-5) << "of black and white, see flip_test.cpp";
}

// --- files read without OpenImageIO -------------------------------------------------------------------

TEST_F(Compare, QuickFilesAreThoseThatOpenImageIoWrites) {
  const std::string tool = system::find_program("oiiotool");
  if (tool.empty()) GTEST_SKIP() << "oiiotool (openimageio-tools) is not installed";
  file("a.pfm", pfm(wide, high, colourful()));
  for (const std::string to :
       {"--compression none -o none.exr", "--compression zip -o zip.exr", "--compression zips -o zips.exr",
        "--compression piz -o piz.exr", "--compression none -o none.tif", "--compression zip -o zip.tif",
        "--compression none --scanline --tile 16 16 -o tiled.exr"}) {
    const auto made = run_shell("'" + tool + "' a.pfm -d float " + to, workplace_.directory());
    ASSERT_EQ(made.exit_code, 0) << made.output;
    expect_equal("a.pfm", to.substr(to.rfind(' ') + 1));
  }
}

TEST_F(Compare, PngFiltersAreThoseOfOpenImageIo) {
  const std::string tool = system::find_program("oiiotool");
  if (tool.empty()) GTEST_SKIP() << "oiiotool (openimageio-tools) is not installed";
  // The same picture as PNG and as TIFF, which OpenImageIO reads; gradients bring out every filter.
  for (const std::string channels : {"1", "3"}) {
    const auto made = run_shell(
        "'" + tool +
            "' --pattern fill:topleft=0.1,0.9,0.3,1:topright=0.9,0.2,0.5,0.4:bottomleft=0.3,0.4,1,0.7:" +
            "bottomright=0,1,0,0.2 67x53 " + channels +
            " --noise:type=uniform:min=-0.02:max=0.02 -d uint8 -o a.png -o a.tif",
        workplace_.directory());
    ASSERT_EQ(made.exit_code, 0) << made.output;
    expect_equal("a.tif", "a.png", "1e-7");
  }
}

// --- what is refused ------------------------------------------------------------------------------

TEST_F(Compare, OtherSizesAreRefused) {
  file("a.pfm", pfm(2, 1, std::vector<float>(6, 0)));
  file("b.pfm", pfm(1, 2, std::vector<float>(6, 0)));
  const Outcome outcome = compare("a.pfm", "b.pfm");
  expect_trouble(outcome, {"a.pfm", "b.pfm", "2 x 1", "1 x 2"});
  EXPECT_EQ(outcome.out, "");
}

TEST_F(Compare, OtherChannelCountsAreRefused) {
  file("colour.pfm", pfm(2, 1, std::vector<float>(6, 0)));
  file("grey.pfm", pfm(2, 1, {0, 0}, 1));
  expect_trouble(compare("colour.pfm", "grey.pfm"), {"colour.pfm", "grey.pfm", "3 channels", "1 channel"});
}

TEST_F(Compare, RefusedPicturesLeaveNoJson) {
  file("a.pfm", pfm(2, 1, std::vector<float>(6, 0)));
  file("b.pfm", pfm(1, 2, std::vector<float>(6, 0)));
  EXPECT_EQ(compare("a.pfm", "b.pfm", {"--json", "result.json"}).exit_code, 2);
  EXPECT_EQ(listing(workplace_.directory()), (std::vector<std::string>{"a.pfm", "b.pfm"}));
}

struct BadImage {
  std::string name;
  std::string file;
  std::string bytes;
  std::string word;
};
void PrintTo(const BadImage& image, std::ostream* out) { *out << image.name; }

class NoImage : public Compare, public testing::WithParamInterface<BadImage> {};
INSTANTIATE_TEST_SUITE_P(Is, NoImage,
                         testing::ValuesIn(std::vector<BadImage>{
                             {"TextAsPng", "text.png", "hello\n", "text.png"},
                             {"TextAsExr", "text.exr", "hello\n", "text.exr"},
                             {"TextAsPpm", "text.ppm", "hello\n", "no PPM"},
                             {"TextAsPfm", "text.pfm", "hello\n", "no PFM"},
                             {"TextAsNothing", "text", "hello\n", "text"},
                             {"EmptyPng", "empty.png", "", "empty.png"},
                             {"EmptyExr", "empty.exr", "", "empty.exr"},
                             {"EmptyPpm", "empty.ppm", "", "is empty"},
                             {"EmptyPfm", "empty.pfm", "", "is empty"},
                             {"PfmWithoutPixels", "cut.pfm", "PF\n2 1\n-1\n", "truncated"},
                             {"PfmCutByAByte", "cut.pfm", pfm(2, 1, std::vector<float>(6, 0)).substr(0, 34),
                              "truncated"},
                             {"PfmWithoutSize", "cut.pfm", "PF\n2 ", "truncated"},
                             {"PfmOfNegativeSize", "bad.pfm", "PF\n-2 1\n-1\n", "size"},
                             {"PfmOfSizeZero", "bad.pfm", "PF\n0 1\n-1\n", "size"},
                             {"PfmOfBillions", "bad.pfm", "PF\n2000000000 2000000000\n-1\n", "size"},
                             {"PfmOverflowing", "bad.pfm", "PF\n99999999999 1\n-1\n", "99999999999"},
                             {"PfmOfScaleZero", "bad.pfm", "PF\n1 1\n0\n" + std::string(12, '\0'), "scale"},
                             {"PfmOfScaleNan", "bad.pfm", "PF\n1 1\nnan\n" + std::string(12, '\0'), "scale"},
                             {"PpmCutInAscii", "cut.ppm", "P3\n2 1\n255\n0 0 0 255\n", "truncated"},
                             {"PpmCutInBinary", "cut.ppm", "P6\n2 1\n255\n12345", "truncated"},
                             {"PpmValueTooLarge", "bad.ppm", "P3\n2 1\n255\n0 0 0 255 256 0\n", "256"},
                             {"PpmValueNegative", "bad.ppm", "P3\n2 1\n255\n0 0 0 255 -1 0\n", "-1"},
                             {"PpmValueNoNumber", "bad.ppm", "P3\n2 1\n255\n0 0 0 red 0 0\n", "red"},
                             {"PpmMaximumZero", "bad.ppm", "P3\n2 1\n0\n0 0 0 0 0 0\n", "largest value"},
                             {"PpmMaximumHuge", "bad.ppm", "P3\n2 1\n65536\n0 0 0 0 0 0\n", "largest value"},
                             {"PpmOfBillions", "bad.ppm", "P3\n2000000000 2000000000\n255\n0", "size"},
                             {"PpmOfNoType", "bad.ppm", "P8\n2 1\n0 1\n", "no PPM"},
                         }),
                         [](const auto& test) { return test.param.name; });

TEST_P(NoImage, ClearOnBothSides) {
  file("good.pfm", pfm(2, 1, std::vector<float>(6, 0)));
  file(GetParam().file, GetParam().bytes);
  const auto before = listing(workplace_.directory());
  expect_trouble(compare("good.pfm", GetParam().file), {GetParam().file, GetParam().word});
  expect_trouble(compare(GetParam().file, "good.pfm"), {GetParam().file, GetParam().word});
  EXPECT_EQ(listing(workplace_.directory()), before);
}

TEST_F(Compare, CutFilesOfRealFormatsAreRefused) {
  file("ball.sdf", std::string(ball_scene));
  for (const std::string name : {"ball.png", "ball.exr"}) {
    ASSERT_EQ(run_plumb({"render", "ball.sdf", "-o", name}, workplace_.directory()).exit_code, 0);
    const std::string whole = read_file(workplace_.path(name));
    for (const std::size_t length : {std::size_t{20}, whole.size() / 2}) {
      file("cut-" + name, whole.substr(0, length));
      SCOPED_TRACE(length);
      expect_trouble(compare(name, "cut-" + name), {"cut-" + name, "cannot be read"});
    }
  }
}

TEST_F(Compare, AMissingFileIsNamedOnBothSides) {
  two_pictures();
  for (const std::string name : {"missing.pfm", "missing.png", "missing.exr", "missing.ppm", "missing"}) {
    expect_trouble(compare("test.pfm", name), {name, "o such file"});
    expect_trouble(compare(name, "test.pfm"), {name, "o such file"});
  }
}

TEST_F(Compare, ADirectoryIsNamed) {
  two_pictures();
  for (const std::string name : {"directory.pfm", "directory.png", "directory"}) {
    std::filesystem::create_directory(workplace_.path(name));
    expect_trouble(compare("test.pfm", name), {name, "is a directory"});
  }
}

}  // namespace
}  // namespace plumb::tests
