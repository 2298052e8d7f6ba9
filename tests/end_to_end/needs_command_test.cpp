// plumb needs and plumb render --error, as a user asks for them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/end_to_end.hpp"

namespace plumb::tests {
namespace {

class NeedsCommand : public testing::Test {
 protected:
  Outcome run(const std::vector<std::string>& arguments) {
    return run_plumb(arguments, workplace_.directory());
  }
  nlohmann::json json(const std::string& name) {
    return nlohmann::json::parse(read_file(workplace_.path(name)));
  }

  Workplace workplace_;
  std::string ball_ = workplace_.file("ball.sdf", std::string(ball_scene));
};

TEST_F(NeedsCommand, IsAPageThatSaysWhatIsAndWhatIsNot) {
  const Outcome outcome =
      run({"needs", source_path("tests/scenes/ray-behind-the-eye.sdf"), "--size", "40x30"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* part :
       {"40 x 30, depth 8", "Kugel", "not seen", "Not in the scene: highlights", "Real type: ",
        "Measured against 113 bits on all 1200 pixels", "From depth 1 on it is the picture of depth 8",
        "Touch no ray (not met, and no blocker): behind, also_behind", "the same, bit for bit",
        "for this camera, this size and one sample a pixel", "What it costs", "double instead of float"}) {
    EXPECT_TRUE(contains(outcome.out, part)) << part << " is missing in\n" << outcome.out;
  }
  std::istringstream lines(outcome.out);
  for (std::string line; std::getline(lines, line);) EXPECT_LT(line.size(), 120U) << line;
}

TEST_F(NeedsCommand, AsJsonSaysTheSame) {
  EXPECT_EQ(run({"needs", source_path("tests/scenes/total-reflection.sdf"), "--size", "40x30", "--error",
                 "0.01", "--json", "needs.json"})
                .exit_code,
            0);
  const auto needs = json("needs.json");
  EXPECT_EQ(needs["error"], 0.01);
  EXPECT_EQ(needs["observed"]["looked_at"], 1200);
  EXPECT_EQ(needs["real"]["oracle_pixels"], 1200);
  EXPECT_EQ(needs["real"]["sufficient"], "float");
  EXPECT_EQ(needs["depth"]["asked"], 8);
  EXPECT_EQ(needs["depth"]["steps"].back()["error"], 0);
  for (const auto& feature : needs["features"]) {
    if (feature["id"] == "total-reflection") {
      EXPECT_GT(feature["seen"], 0);
    } else if (feature["id"] == "mirror") {
      EXPECT_EQ(feature["in_scene"], 0);
    }
  }
  EXPECT_TRUE(needs["untouched"]["same_picture_without"]);
  EXPECT_GT(needs["costs"]["cpu_seconds"], 0);
}

TEST_F(NeedsCommand, OnStandardOutputJsonIsAlone) {
  const Outcome outcome = run({"needs", ball_, "--json", "-"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(nlohmann::json::parse(outcome.out)["width"], 32);
}

TEST_F(NeedsCommand, OfAnEmptySceneIsNothing) {
  const std::string empty = workplace_.file("empty.sdf", "define camera eye 60\nrender eye a.ppm 8 6\n");
  const Outcome outcome = run({"needs", empty});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "48 rays meet nothing")) << outcome.out;
}

TEST_F(NeedsCommand, APictureTooLargeToBeRenderedManyTimesIsRefused) {
  expect_trouble(run({"needs", ball_, "--size", "4000x4000"}), {"16000000", "4194304", "--size"});
}

TEST_F(NeedsCommand, RenderWithinAnErrorTakesWhatIsEnoughAndSaysWhy) {
  const std::string scene = source_path("tests/scenes/recursion-depth.sdf");
  const auto render = [&](const char* error) {
    return run(
        {"render", scene, "--size", "40x30", "--error", error, "-o", "a.pfm", "--stats-json", "a.json"});
  };
  const Outcome tolerant = render("0.05");
  EXPECT_EQ(tolerant.exit_code, 0) << tolerant.err;
  EXPECT_TRUE(contains(tolerant.err, "0.05 was asked for")) << tolerant.err;
  const auto cheap = json("a.json");
  EXPECT_EQ(cheap["real"], "float");
  EXPECT_EQ(cheap["error"]["chosen"]["real"], "float");
  EXPECT_LT(cheap["error"]["chosen"]["depth"], 8);
  EXPECT_LE(cheap["error"]["chosen"]["error"], 0.05);
  EXPECT_EQ(cheap["error"]["oracle_pixels"], 1200);
  EXPECT_EQ(render("1e-7").exit_code, 0);
  EXPECT_EQ(json("a.json")["error"]["chosen"]["real"], "double");
}

TEST_F(NeedsCommand, ThePictureWrittenWithinAnErrorIsThatOfTheConfigurationNamed) {
  EXPECT_EQ(run({"render", ball_, "--error", "0.01", "-o", "a.pfm", "--stats-json", "a.json"}).exit_code, 0);
  const auto chosen = json("a.json")["error"]["chosen"];
  EXPECT_EQ(run({"render", ball_, "--real", chosen["real"].get<std::string>(), "--depth",
                 chosen["depth"].dump(), "-o", "b.pfm"})
                .exit_code,
            0);
  EXPECT_EQ(read_file(workplace_.path("a.pfm")), read_file(workplace_.path("b.pfm")));
}

TEST_F(NeedsCommand, AnErrorThatCannotBeReachedIsTroubleAndLeavesNoPicture) {
  expect_trouble(run({"render", ball_, "--error", "1e-15", "-o", "a.pfm"}),
                 {"ball.sdf", "1e-15", "double, depth 8", "--real quad"});
  EXPECT_FALSE(std::filesystem::exists(workplace_.path("a.pfm")));
}

TEST_F(NeedsCommand, AnErrorDoesNotGoWithARealTypeOrAHugePicture) {
  expect_trouble(run({"render", ball_, "--error", "0.1", "--real", "double"}), {"--error", "--real"});
  expect_trouble(run({"render", ball_, "--error", "0.1", "--engine", "textbook"}), {"--error", "--engine"});
  expect_trouble(run({"render", ball_, "--error", "0.1", "--size", "8000x8000"}), {"--error", "64000000"});
  expect_trouble(run({"render", ball_, "--error", "0.1", "--samples", "3"}), {"3 samples", "square"});
}

}  // namespace
}  // namespace plumb::tests
