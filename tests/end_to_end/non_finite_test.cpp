// A pixel that is no number is never right and never agrees, in any command that takes a picture and any
// format that holds floats.
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/support/end_to_end.hpp"

namespace plumb::tests {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

struct Format {
  const char* name;
  const char* extension;
  const char* arguments;  ///< of oiiotool
};
void PrintTo(const Format& format, std::ostream* out) { *out << format.name; }

/// The picture of a ball, 32 x 24 pixels, in which one pixel is not finite.
class NonFinite : public testing::TestWithParam<Format> {
 protected:
  NonFinite() {
    for (const char* directory : {"scenes", "pictures"}) fs::create_directory(workplace_.path(directory));
    workplace_.file("scenes/s.sdf", std::string(ball_scene));
    EXPECT_EQ(run({"render", "scenes/s.sdf", "-o", "a.pfm"}).exit_code, 0);
    right_ = read_file(workplace_.path("a.pfm"));
    convert("a.pfm", whole());
  }

  static std::string in_format(const std::string& name) { return name + GetParam().extension; }
  static std::string whole() { return in_format("whole"); }
  static std::string damaged() { return in_format("pictures/s"); }
  Outcome run(const std::vector<std::string>& arguments) const {
    return run_plumb(arguments, workplace_.directory());
  }
  /// OpenImageIO 2.4 writes no PFM, which the picture is already.
  void convert(const std::string& from, const std::string& to) const {
    const std::string command = to.ends_with(".pfm")
                                    ? "cp " + from + " " + to
                                    : "oiiotool " + from + " " + GetParam().arguments + " -o " + to;
    const auto done = run_shell(command, workplace_.directory());
    ASSERT_EQ(done.exit_code, 0) << done.output;
  }
  /// Writes the value into a component of the picture.
  void damage(float value, std::size_t component) const {
    std::string bytes = right_;
    const std::size_t begin = bytes.size() - sizeof value * 3 * 32 * 24;
    const auto raw = std::bit_cast<std::array<char, sizeof value>>(value);
    bytes.replace(begin + sizeof value * component, sizeof value, raw.data(), raw.size());
    workplace_.file("b.pfm", bytes);
    convert("b.pfm", damaged());
  }
  template <class Check>
  void with_each_damage(Check check) const {
    for (const float value : {std::nanf(""), INFINITY, -INFINITY}) {
      for (const std::size_t component : {0U, 1129U, 2303U}) {
        SCOPED_TRACE(std::to_string(value) + " in component " + std::to_string(component));
        damage(value, component);
        check();
      }
    }
  }

  Workplace workplace_;
  std::string right_;
};

TEST_P(NonFinite, NeverAgreesNotEvenWithItself) {
  ASSERT_EQ(run({"compare", whole(), whole()}).exit_code, 0);
  with_each_damage([&] {
    EXPECT_EQ(run({"compare", whole(), damaged()}).exit_code, 1);
    EXPECT_EQ(run({"compare", damaged(), whole()}).exit_code, 1);
    EXPECT_EQ(run({"compare", damaged(), damaged(), "--tolerance", "1e30"}).exit_code, 1);
  });
}

TEST_P(NonFinite, IsNeverRightAndIsCounted) {
  ASSERT_EQ(run({"diagnose", "scenes/s.sdf", whole()}).exit_code, 0);
  with_each_damage([&] {
    const Outcome outcome = run({"diagnose", "scenes/s.sdf", damaged(), "--tolerance", "1"});
    EXPECT_EQ(outcome.exit_code, 1) << outcome.out;
    EXPECT_TRUE(contains(outcome.out, "1 pixel is not finite")) << outcome.out;
    const Json json = Json::parse(run({"diagnose", "scenes/s.sdf", damaged(), "--json", "-"}).out);
    EXPECT_EQ(json.at("non_finite"), 1);
    EXPECT_NE(json.at("verdict"), "right");
  });
}

TEST_P(NonFinite, IsNeverJudgedRight) {
  with_each_damage([&] {
    const Outcome outcome = run({"judge", "--images", "pictures", "--scenes", "scenes", "--json", "-"});
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    const Json picture = Json::parse(outcome.out).at("pictures").at(0);
    EXPECT_EQ(picture.at("verdict"), "right-apart");
    EXPECT_TRUE(contains(picture.at("message"), "1 pixel is not finite")) << picture;
  });
}

TEST_P(NonFinite, IsNoBaseline) {
  ASSERT_EQ(run({"regress", "scenes", "--update", "s", "--because", "looked at"}).exit_code, 0);
  ASSERT_EQ(run({"regress", "scenes"}).exit_code, 0);
  with_each_damage([&] {
    convert(damaged(), "scenes/baselines/s.exr");
    EXPECT_NE(run({"regress", "scenes"}).exit_code, 0);
  });
}

INSTANTIATE_TEST_SUITE_P(Formats, NonFinite,
                         testing::Values(Format{"Pfm", ".pfm", ""}, Format{"FloatExr", ".exr", "-d float"},
                                         Format{"HalfExr", ".exr", "-d half"},
                                         Format{"FloatTiff", ".tif", "-d float"}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace plumb::tests
