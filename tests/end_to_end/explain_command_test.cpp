// plumb explain as a user calls it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/end_to_end.hpp"
#include "tracer/system/files.hpp"

namespace plumb::tests {
namespace {

using Json = nlohmann::json;

class Explain : public testing::Test {
 protected:
  Outcome explain(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "explain");
    return run_plumb(arguments, workplace_.directory());
  }
  Workplace workplace_;
};

TEST_F(Explain, TellsEveryTermOfAHitAndTheReferenceBesideTheSum) {
  workplace_.file("ball.sdf", std::string(ball_scene));
  const Outcome outcome = explain({"ball.sdf", "16", "12"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* const part :
       {"camera ray", "meets 'ball'", "ambient", "[Ambient]", "light 'key' is seen", "[Lambert]", "[Phong]",
        "[Schatten]", "local", "ours", "reference", "difference"}) {
    EXPECT_TRUE(contains(outcome.out, part)) << part << "\n" << outcome.out;
  }
}

TEST_F(Explain, APixelOfTheBackgroundMeetsNothing) {
  workplace_.file("ball.sdf", std::string(ball_scene));
  EXPECT_TRUE(contains(explain({"ball.sdf", "0", "0"}).out, "meets nothing: background (0.1 0.15 3)"));
}

TEST_F(Explain, ThePictureOfAnotherTracerStandsBesideTheRightOne) {
  workplace_.file("ball.sdf", std::string(ball_scene));
  ASSERT_EQ(run_plumb({"render", "ball.sdf", "-o", "mine.ppm"}, workplace_.directory()).exit_code, 0);
  std::string text = read_file(workplace_.path("mine.ppm"));
  const std::size_t first = text.find('\n', text.find("255")) + 1;
  ASSERT_TRUE(text.substr(first).starts_with("23 33 191")) << text.substr(0, 60);
  text.replace(first, 9, "24 33 191");
  workplace_.file("mine.ppm", text);
  const Outcome outcome = explain({"ball.sdf", "0", "0", "--image", "mine.ppm", "--json", "out.json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "yours      24 33 191")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "expected   23 33 191   tone-mapped, truncated to 8 bits"))
      << outcome.out;
  const Json image = Json::parse(read_file(workplace_.path("out.json")))["image"];
  EXPECT_EQ(image["yours"], Json({24, 33, 191}));
  EXPECT_EQ(image["expected"], Json({23, 33, 191}));
}

TEST_F(Explain, APictureOfAnotherSizeIsRefusedAndOneOfTheSameViewTaken) {
  workplace_.file("ball.sdf", std::string(ball_scene));
  run_plumb({"render", "ball.sdf", "-o", "wide.pfm", "--size", "64x10"}, workplace_.directory());
  run_plumb({"render", "ball.sdf", "-o", "large.pfm", "--size", "64x48"}, workplace_.directory());
  EXPECT_EQ(explain({"ball.sdf", "0", "0", "--image", "wide.pfm"}).exit_code, 2);
  const Outcome large = explain({"ball.sdf", "60", "40", "--image", "large.pfm"});
  EXPECT_EQ(large.exit_code, 0) << large.err;
  EXPECT_TRUE(contains(large.out, "expected   0.1")) << large.out;
}

/// The colour is the sum of the terms that are told, for every ray of the tree.
void expect_sums(const Json& ray) {
  if (!ray.contains("met")) return;
  for (int c = 0; c < 3; ++c) {
    double local = ray["ambient"]["value"][c];
    for (const Json& light : ray["lights"]) {
      if (light.contains("diffuse"))
        local += light["diffuse"]["value"][c].get<double>() + light["specular"]["value"][c].get<double>();
    }
    EXPECT_NEAR(local, ray["local"][c].get<double>(), 1e-14) << "roundings of a sum of few terms";
  }
  for (const Json& child : ray["children"]) expect_sums(child);
}

TEST_F(Explain, JsonHoldsTheTreeAndItsSums) {
  workplace_.file("room.sdf",
                  std::string(ball_scene) +
                      "define material glass 0.1 0 0 0.1 0.1 0.1 0.2 0.2 0.2 9 mirror 0.2 0.2 0.2 transmit "
                      "0.6 0.6 0.6 eta 1.5\n"
                      "define shape box pane -2 -2 -2 2 2 -1.5 glass\n");
  const Outcome outcome = explain({"room.sdf", "16", "12", "--json", "-", "--depth", "4"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json json = Json::parse(outcome.out);
  EXPECT_EQ(json["x"], 16);
  EXPECT_EQ(json["width"], 32);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(json["ours"][c].get<double>(), json["engine"][c].get<double>(), 1e-6)
        << "verify compares the engine's";
    EXPECT_NEAR(json["ours"][c].get<double>(), json["reference"][c].get<double>(), 1e-6)
        << "as verify has it";
  }
  EXPECT_EQ(json["engine_note"], "");
  EXPECT_EQ(json["tree"]["children"].size(), 2U) << "mirrored and refracted";
  EXPECT_EQ(json["tree"]["colour"], json["ours"]);
  expect_sums(json["tree"]);
}

TEST_F(Explain, AShadowNamesWhatCastsIt) {
  workplace_.file("shadow.sdf", std::string(ball_scene) + "define shape box lid 0 1.5 -4 9 2 0 red\n");
  EXPECT_TRUE(contains(explain({"shadow.sdf", "16", "8"}).out, "light 'key' is hidden by 'lid' at t = "));
}

/// Every number that the text shows.
TEST_F(Explain, JsonHoldsWhatTheTextShows) {
  workplace_.file("room.sdf",
                  replaced(ball_scene, "red\n", "red\ndefine shape box lid 0 1.5 -4 9 2 0 red\n") +
                      "define material glass 0.1 0 0 0.1 0.1 0.1 0.2 0.2 0.2 9 mirror 0.2 0.3 0.4 transmit "
                      "0.6 0.5 0.7 eta 1.5\n"
                      "define shape box pane -2 -2 -2 2 2 -1.5 glass\n");
  const Outcome outcome = explain({"room.sdf", "16", "8", "--json", "-", "--stored"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json tree = Json::parse(outcome.out).at("tree");
  EXPECT_TRUE(tree.at("met").at("face").is_number()) << "of the pane";
  EXPECT_EQ(tree.at("ambient").at("ka"), Json({0.1, 0, 0}));
  const Json& light = tree.at("lights").at(0);
  EXPECT_EQ(light.at("Ip"), Json({1.0, 1.0, 1.0}));
  EXPECT_EQ(light.at("kd"), Json({0.1, 0.1, 0.1}));
  EXPECT_EQ(light.at("ks"), Json({0.2, 0.2, 0.2}));
  EXPECT_EQ(light.at("m"), 9.0);
  EXPECT_EQ(light.at("blocker").at("shape"), "lid");
  EXPECT_GT(light.at("blocker").at("t"), 0.0);
  for (const Json& child : tree.at("children")) {
    const bool is_mirrored = child.at("ray") == "mirrored ray";
    EXPECT_EQ(child.at("weight").at("name"), is_mirrored ? "kr" : "kt");
    EXPECT_EQ(child.at("weight").at("value"), is_mirrored ? Json({0.2, 0.3, 0.4}) : Json({0.6, 0.5, 0.7}));
  }
  EXPECT_FALSE(tree.contains("weight")) << "the camera ray is the whole";
}

/// Every ray has two that follow it: 2^D of them.
const std::string doubling_scene =
    "define material m 0.1 0.1 0.1 0 0 0 0 0 0 1 mirror 0.5 0.5 0.5 transmit 0.5 0.5 0.5 eta 1.1\n"
    "define shape sphere a 0 0 -5 2 m\ndefine shape sphere b 0 0 -5 1 m\n"
    "define camera eye 60\nrender eye out.ppm 32 24\nambient 1 1 1\n";

TEST_F(Explain, TooManyRaysAreNotTracedAndThatIsSaid) {
  workplace_.file("room.sdf", doubling_scene);
  for (const char* const depth : {"14", "256"}) {
    const Outcome outcome = explain({"room.sdf", "16", "12", "--depth", depth, "--stored"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(contains(outcome.out, "rays that were not traced"));
    EXPECT_TRUE(contains(outcome.out, "the sum covers only those that were traced"));
    EXPECT_TRUE(contains(outcome.out, "choose a smaller --depth"));
    EXPECT_FALSE(contains(outcome.out, "difference")) << "of a part of the sum it says nothing";
    EXPECT_LT(outcome.out.size(), 20000000U);
    EXPECT_LT(outcome.cpu_seconds, 60) << "2^256 rays are never traced";
  }
}

TEST_F(Explain, JsonSaysWhetherTheTreeIsCut) {
  workplace_.file("room.sdf", doubling_scene);
  const auto json = [&](const char* depth) {
    const Outcome outcome = explain({"room.sdf", "16", "12", "--depth", depth, "--stored", "--json", "-"});
    EXPECT_LT(outcome.out.size(), 20000000U) << "no blanks without end";
    return Json::parse(outcome.out);
  };
  EXPECT_EQ(json("4").at("is_cut"), false);
  EXPECT_EQ(json("4").at("note"), "");
  EXPECT_EQ(json("200").at("is_cut"), true);
  EXPECT_TRUE(contains(json("200").at("note"), "more than 3000 rays"));
}

/// Without the other, neither mirrors nor glass double the rays: each term is traced to the end.
TEST_F(Explain, TheTermsOfADeepSceneEnd) {
  workplace_.file("room.sdf", doubling_scene);
  for (const std::string without : {" mirror 0.5 0.5 0.5", " transmit 0.5 0.5 0.5"}) {
    workplace_.file("term.sdf", replaced(doubling_scene, without, ""));
    const Outcome outcome = explain({"term.sdf", "16", "12", "--depth", "256", "--stored", "--json", "-"});
    EXPECT_EQ(Json::parse(outcome.out).at("is_cut"), false) << without;
  }
}

TEST_F(Explain, BadInputIsTrouble) {
  workplace_.file("ball.sdf", std::string(ball_scene));
  expect_trouble(explain({"ball.sdf", "32", "0"}), {"32 0", "32 x 24"});
  expect_trouble(explain({"ball.sdf", "0", "24"}), {"0 24"});
  EXPECT_EQ(explain({"ball.sdf", "-1", "0"}).exit_code, 2);
  EXPECT_EQ(explain({"ball.sdf", "1"}).exit_code, 2);
  expect_trouble(explain({"missing.sdf", "1", "1"}), {"missing.sdf"});
}

}  // namespace
}  // namespace plumb::tests
