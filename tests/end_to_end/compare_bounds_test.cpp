// `plumb compare`: what may be over, what is left out, and the difference as an image.
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "references/gates/bounds.hpp"
#include "tests/support/end_to_end.hpp"
#include "tracer/image/io.hpp"

namespace plumb::tests {
namespace {

using Json = nlohmann::json;

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr float unbounded = std::numeric_limits<float>::infinity();

/// 10 x 8 pixels of a slope of greys.
Image slope() {
  Image image(10, 8);
  for (std::size_t i = 0; i < image.rgb.size(); ++i) image.rgb[i] = 0.1F + static_cast<float>(i) / 500;
  return image;
}

class CompareBounds : public testing::Test {
 protected:
  CompareBounds() { write("a.pfm", slope()); }

  void write(const std::string& name, const Image& image) const {
    write_image(workplace_.path(name), image, default_encoding(name));
  }
  /// The slope with these pixels off by 0.25.
  void off(const std::string& name, const std::vector<PixelPlace>& places) const {
    Image image = slope();
    for (const auto& p : places) image.pixel(p.x, p.y)[1] += 0.25F;
    write(name, image);
  }
  Outcome compare(const std::string& test, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"compare", "a.pfm", test});
    return run_plumb(more, workplace_.directory());
  }
  Json compare_json(const std::string& test, std::vector<std::string> more = {}) const {
    more.insert(more.end(), {"--json", "-"});
    const Outcome outcome = compare(test, more);
    EXPECT_TRUE(Json::accept(outcome.out)) << outcome.out << outcome.err;
    return Json::parse(outcome.out, nullptr, false);
  }

  Workplace workplace_;
};

TEST_F(CompareBounds, SoManyPixelsMayBeOver) {
  off("b.pfm", {{1, 1}, {2, 1}, {9, 7}, {0, 0}});
  EXPECT_EQ(compare("b.pfm").exit_code, 1);
  EXPECT_EQ(compare("b.pfm", {"--allow-over", "3"}).exit_code, 1);
  EXPECT_EQ(compare("b.pfm", {"--allow-over", "4.9%"}).exit_code, 1);
  for (const char* const enough : {"4", "5%", "100%"}) {
    const Outcome outcome = compare("b.pfm", {"--allow-over", enough});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.out;
    EXPECT_TRUE(contains(outcome.out, "pixels over  4 of 80\n")) << outcome.out;
    EXPECT_TRUE(contains(outcome.out, std::string("may be over (") + enough + ")")) << outcome.out;
    EXPECT_TRUE(outcome.out.ends_with("agree within the bounds\n")) << outcome.out;
  }
  const Json json = compare_json("b.pfm", {"--allow-over", "5%"});
  EXPECT_EQ(json.at("status"), "agree");
  EXPECT_EQ(json.at("pixels_over"), 4);
  EXPECT_EQ(json.at("bounds").at("allow_over"), "5%");
  EXPECT_EQ(json.at("bounds").at("allowed_over"), 4);
  EXPECT_FALSE(compare_json("b.pfm").contains("bounds"));
}

TEST_F(CompareBounds, RelativeAllowsAShareOfTheReference) {
  Image image = slope();
  for (float& v : image.rgb) v *= 1.01F;
  write("b.pfm", image);
  EXPECT_EQ(compare("b.pfm").exit_code, 1);
  EXPECT_EQ(compare("b.pfm", {"--relative", "0.0099"}).exit_code, 1);
  const Outcome outcome = compare("b.pfm", {"--relative", "0.0101"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "bounds       relative 0.0101\n")) << outcome.out;
  EXPECT_TRUE(outcome.out.ends_with("\nagree\n")) << outcome.out;
  EXPECT_EQ(compare_json("b.pfm", {"--relative", "0.0101"}).at("bounds").at("relative"), 0.0101);
}

TEST_F(CompareBounds, WhatIsIgnoredEntersNothingAndIsSaid) {
  off("b.pfm", {{1, 1}, {2, 1}});
  const Outcome outcome = compare("b.pfm", {"--ignore", "1,1,1,1", "--ignore", "2,1,3,2"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "max error    0\n")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "pixels over  0 of 73\n")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "7 pixels ignored, not compared: 1,1,1,1 2,1,3,2\n")) << outcome.out;
  const Json json = compare_json("b.pfm", {"--ignore", "1,1,1,1", "--only", "0,0,10,4"});
  EXPECT_EQ(json.at("status"), "differ");
  EXPECT_EQ(json.at("pixels_over"), 1);
  EXPECT_EQ(json.at("worst").at("x"), 2);
  EXPECT_EQ(json.at("bounds").at("pixels_compared"), 39);
  EXPECT_EQ(json.at("bounds").at("pixels_ignored"), 41);
  EXPECT_EQ(json.at("bounds").at("ignore"), Json::array({"1,1,1,1"}));
  EXPECT_EQ(json.at("bounds").at("only"), Json::array({"0,0,10,4"}));
}

TEST_F(CompareBounds, AMaskImageIsARegion) {
  off("b.pfm", {{1, 1}, {9, 7}});
  Image mask(10, 8);
  mask.pixel(1, 1)[0] = mask.pixel(9, 7)[2] = 1;
  write("mask.png", mask);
  EXPECT_EQ(compare("b.pfm", {"--ignore", "mask.png"}).exit_code, 0);
  const Json json = compare_json("b.pfm", {"--only", "mask.png"});
  EXPECT_EQ(json.at("pixels_over"), 2);
  EXPECT_EQ(json.at("bounds").at("pixels_compared"), 2);
  write("small.png", Image(9, 8));
  expect_trouble(compare("b.pfm", {"--ignore", "small.png"}), {"small.png", "9 x 8", "10 x 8"});
  expect_trouble(compare("b.pfm", {"--ignore", "gone.png"}), {"gone.png"});
}

TEST_F(CompareBounds, WhatIsNotFiniteNeverAgreesUnlessIgnored) {
  for (const float bad : {not_a_number, unbounded, -unbounded}) {
    Image image = slope();
    image.pixel(3, 2)[2] = bad;
    for (const char* const name : {"b.pfm", "b.exr"}) {
      write(name, image);
      EXPECT_EQ(compare(name).exit_code, 1);
      EXPECT_EQ(compare(name, {"--allow-over", "100%", "--relative", "1e9", "--tolerance", "1e9"}).exit_code,
                1);
      EXPECT_EQ(compare(name, {"--only", "3,2,1,1", "--allow-over", "100%"}).exit_code, 1);
      EXPECT_EQ(compare(name, {"--ignore", "0,0,3,8", "--allow-over", "100%"}).exit_code, 1);
      const Outcome ignored = compare(name, {"--ignore", "3,2,2,2"});
      EXPECT_EQ(ignored.exit_code, 0) << ignored.out;
      EXPECT_TRUE(contains(ignored.out, "; 1 of the ignored are not finite")) << ignored.out;
      EXPECT_EQ(compare_json(name, {"--ignore", "3,2,2,2"}).at("bounds").at("ignored_non_finite"), 1);
    }
  }
}

/// Flipping rows would also pair the one compared region with an ignored one: that explains nothing.
TEST_F(CompareBounds, TheLikelyCauseIsThatOfThePixelsCompared) {
  off("b.pfm", {{1, 1}, {2, 1}, {3, 1}});
  EXPECT_FALSE(compare_json("b.pfm", {"--only", "0,0,10,3"}).contains("likely_cause"));
  Image image = slope();
  for (int x = 0; x < 10; ++x) std::fill_n(image.pixel(x, 7), 3, 7.0F);
  for (int y = 0; y < 7; ++y)
    for (int x = 0; x < 10; ++x)
      for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] = slope().pixel(9 - x, y)[c];
  write("mirrored.pfm", image);
  EXPECT_FALSE(compare_json("mirrored.pfm").contains("likely_cause"));
  const Json json = compare_json("mirrored.pfm", {"--ignore", "0,7,10,1"});
  EXPECT_EQ(json.at("likely_cause").at("name"), "columns_mirrored") << json;
}

TEST_F(CompareBounds, BoundsThatMakeNoSenseAreRefused) {
  off("b.pfm", {});
  expect_trouble(compare("b.pfm", {"--allow-over", "-1"}), {"--allow-over", "'-1'", "0.5%"});
  expect_trouble(compare("b.pfm", {"--allow-over", "101%"}), {"--allow-over", "'101%'"});
  expect_trouble(compare("b.pfm", {"--relative", "-1"}), {"--relative", "'-1'"});
  expect_trouble(compare("b.pfm", {"--relative", "nan"}), {"--relative", "'nan'"});
  expect_trouble(compare("b.pfm", {"--ignore", "1,2,3"}), {"--ignore", "'1,2,3'", "X,Y,W,H"});
  expect_trouble(compare("b.pfm", {"--only", "10,0,4,4"}), {"10,0,4,4", "outside", "10 x 8"});
  expect_trouble(compare("b.pfm", {"--ignore", "0,0,10,8"}), {"no pixel"});
  expect_trouble(compare("b.pfm", {"--metrics", "--only", "0,0,4,4"}), {"--metrics", "--only"});
  expect_trouble(compare("b.pfm", {"--json", "-", "--junit", "-"}), {"--json and --junit"});
}

TEST_F(CompareBounds, JunitSaysThem) {
  off("b.pfm", {{1, 1}});
  EXPECT_EQ(compare("b.pfm", {"--allow-over", "1", "--junit", "j.xml"}).exit_code, 0);
  const std::string passed = read_file(workplace_.path("j.xml"));
  EXPECT_TRUE(contains(passed, "<system-out>1 of 80 pixels are over")) << passed;
  EXPECT_TRUE(contains(passed, "1 pixel may be over (1)")) << passed;
  EXPECT_EQ(compare("b.pfm", {"--ignore", "5,5,1,1", "--junit", "j.xml"}).exit_code, 1);
  const std::string failed = read_file(workplace_.path("j.xml"));
  EXPECT_TRUE(contains(failed, "failures=\"1\"")) << failed;
  EXPECT_TRUE(contains(failed, "1 of 79 pixels are over")) << failed;
  EXPECT_TRUE(contains(failed, "1 pixel ignored")) << failed;
  EXPECT_EQ(compare("gone.pfm", {"--junit", "j.xml"}).exit_code, 2);
  EXPECT_TRUE(contains(read_file(workplace_.path("j.xml")), "errors=\"1\""));
}

TEST_F(CompareBounds, TheReportShowsWhatWasIgnored) {
  off("b.pfm", {{1, 1}, {8, 7}});
  EXPECT_EQ(compare("b.pfm", {"--ignore", "0,0,4,4", "--report", "out"}).exit_code, 1);
  const std::string page = read_file(workplace_.path("out/index.html"));
  const std::string open = "id=\"report-data\">";
  const std::size_t begin = page.find(open) + open.size();
  const Json scene =
      Json::parse(page.substr(begin, page.find("</script>", begin) - begin)).at("scenes").at(0);
  EXPECT_EQ(scene.at("causes"), Json::array({"over", "ignored"}));
  EXPECT_EQ(scene.at("result").at("bounds").at("pixels_ignored"), 16);
  EXPECT_TRUE(contains(scene.at("result").at("message"), "16 pixels ignored, not compared: 0,0,4,4"));
}

// --- the difference as an image -------------------------------------------------------------------

TEST_F(CompareBounds, FloatFilesHoldTheDifferenceAsItIs) {
  Image image = slope();
  image.pixel(4, 3)[0] -= 0.0625F;
  image.pixel(5, 3)[2] += 2;
  image.pixel(6, 3)[1] = not_a_number;
  write("b.pfm", image);
  for (const char* const name : {"d.pfm", "d.exr"}) {
    const Outcome outcome = compare("b.pfm", {"--diff", name, "--ignore", "5,3,1,1"});
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_TRUE(contains(outcome.out, std::string(name) + " holds |test - reference|, linear"))
        << outcome.out;
    const ImageFile written = read_image(workplace_.path(name));
    ASSERT_EQ(written.values.size(), 240U);
    for (std::size_t i = 0; i < written.values.size(); ++i) {
      const double expected = i == 3 * 34 ? std::abs(double(image.rgb[i]) - double(slope().rgb[i])) : 0;
      if (i == 3 * 36 + 1) {
        EXPECT_TRUE(std::isnan(written.values[i]));
      } else {
        EXPECT_EQ(written.values[i], static_cast<float>(expected)) << i;
      }
    }
  }
}

TEST_F(CompareBounds, OtherFilesAreScaledToWhite) {
  Image image = slope();
  for (int c = 0; c < 3; ++c) image.pixel(4, 3)[c] += 0.125F;
  image.pixel(6, 3)[1] = not_a_number;
  write("b.pfm", image);
  const Outcome outcome = compare("b.pfm", {"--diff", "d.png"});
  EXPECT_TRUE(contains(outcome.out, "so that the largest is white; what is not finite is magenta"))
      << outcome.out;
  const ImageFile written = read_image(workplace_.path("d.png"));
  const auto pixel = [&](std::size_t at) {
    return std::vector<float>(&written.values[3 * at], &written.values[3 * at] + 3);
  };
  EXPECT_EQ(pixel(34), (std::vector<float>{1, 1, 1}));
  EXPECT_EQ(pixel(36), (std::vector<float>{1, 0, 1}));
  EXPECT_EQ(pixel(0), (std::vector<float>{0, 0, 0}));
}

TEST_F(CompareBounds, TheDifferenceNeverReplacesAnInput) {
  off("b.pfm", {{1, 1}});
  write("mask.png", slope());
  std::filesystem::create_symlink("a.pfm", workplace_.path("link.pfm"));
  const std::string before = read_file(workplace_.path("a.pfm"));
  for (const char* const name : {"a.pfm", "./b.pfm", "link.pfm"})
    expect_trouble(compare("b.pfm", {"--diff", name}), {"--diff", name, "input"});
  expect_trouble(compare("b.pfm", {"--only", "mask.png", "--diff", "mask.png"}), {"--diff", "mask.png"});
  expect_trouble(compare("b.pfm", {"--diff", "-"}), {"--diff", "-"});
  expect_trouble(compare("b.pfm", {"--diff", "d.bmp"}), {"d.bmp", ".exr"});
  EXPECT_EQ(read_file(workplace_.path("a.pfm")), before);
}

}  // namespace
}  // namespace plumb::tests
