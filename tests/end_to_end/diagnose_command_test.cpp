// `plumb faults`, `plumb render --fault` and `plumb diagnose`, from the scene to the exit code.
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/support/end_to_end.hpp"
#include "tests/support/room_scene.hpp"

namespace plumb::tests {
namespace {

using Json = nlohmann::json;

class DiagnoseCommand : public testing::Test {
 protected:
  DiagnoseCommand() { workplace_.file("s.sdf", std::string(ball_scene)); }

  Outcome run(const std::vector<std::string>& arguments) const {
    return run_plumb(arguments, workplace_.directory());
  }
  Json json_of(const std::vector<std::string>& arguments) const {
    const Outcome outcome = run(arguments);
    EXPECT_TRUE(Json::accept(outcome.out)) << outcome.out << outcome.err;
    return Json::parse(outcome.out, nullptr, false);
  }

  Workplace workplace_;
};

TEST_F(DiagnoseCommand, ARightPictureIsRight) {
  ASSERT_EQ(run({"render", "s.sdf", "-o", "a.ppm"}).exit_code, 0);
  const Outcome outcome = run({"diagnose", "s.sdf", "a.ppm"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_TRUE(contains(outcome.out, "a.ppm: right (tone-mapped, truncated to 8 bits)")) << outcome.out;
}

TEST_F(DiagnoseCommand, WhatARightPictureCannotShowIsSaid) {
  for (const char* name : {"a.ppm", "a.exr"}) {
    ASSERT_EQ(run({"render", "s.sdf", "-o", name}).exit_code, 0);
    const Json json = json_of({"diagnose", "s.sdf", name, "--json", "-"});
    const auto unseen = json["unseen"]["faults"].get<std::vector<std::string>>();
    const auto is_unseen = [&](const std::string& id) {
      return std::ranges::find(unseen, id) != unseen.end();
    };
    EXPECT_TRUE(is_unseen("mirror-missing")) << "nothing mirrors";
    EXPECT_TRUE(is_unseen("last-light-decides") || is_unseen("transforms-missing"));
    EXPECT_FALSE(is_unseen("ka-kd-swapped"));
    EXPECT_FALSE(is_unseen("pixel-corner"));
    EXPECT_FALSE(json["unseen"]["scenes"].empty());
    EXPECT_EQ(json["unseen"]["pixels"], 32 * 24);
    // Each that is said to be unseen is right when it is rendered, too.
    for (const std::string& id : unseen) {
      if (id != "mirror-missing" && id != "transforms-missing" && id != "eta-inverted") continue;
      ASSERT_EQ(run({"render", "s.sdf", "--fault", id, "-o", "b.ppm"}).exit_code, 0);
      EXPECT_EQ(run({"diagnose", "s.sdf", "b.ppm"}).exit_code, 0) << id;
    }
  }
  EXPECT_TRUE(
      contains(run({"diagnose", "s.sdf", "a.ppm"}).out, " known faults would change none of 768 pixels"));
}

TEST_F(DiagnoseCommand, AFaultIsNamedInTextAndJson) {
  ASSERT_EQ(run({"render", "s.sdf", "--fault", "ka-kd-swapped,pixel-corner", "-o", "a.ppm"}).exit_code, 0);
  const Outcome outcome = run({"diagnose", "s.sdf", "a.ppm"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(contains(outcome.out, "ka-kd-swapped")) << outcome.out;
  const Json json = json_of({"diagnose", "s.sdf", "a.ppm", "--json", "-"});
  EXPECT_EQ(json["verdict"], "faults");
  ASSERT_EQ(json["faults"].size(), 2U);
  EXPECT_EQ(json["faults"][0]["id"], "ka-kd-swapped");
  EXPECT_EQ(json["faults"][0]["catalogue"], 17);
  EXPECT_GT(json["faults"][0]["pixels"], json["faults"][1]["pixels"]);
  EXPECT_EQ(json["faults"][1]["id"], "pixel-corner");
  EXPECT_EQ(json["encoding"]["tone_map"], true);
  EXPECT_EQ(json["encoding"]["rounding"], "truncate");
  EXPECT_EQ(json["remaining"]["pixels_over_2_255"], 0);
}

TEST_F(DiagnoseCommand, ALayerThatRenderWroteIsRight) {
  const Outcome rendered = run({"render", "s.sdf", "-o", "a.exr", "--layers", "depth,normal,shadow"});
  ASSERT_EQ(rendered.exit_code, 0) << rendered.err;
  EXPECT_EQ(rendered.out, "a.exr\na.depth.png\na.normal.png\na.shadow.png\n");
  for (const char* layer : {"normal=a.normal.png", "normal=a.exr", "depth=a.depth.png", "depth=a.exr"}) {
    const Outcome outcome = run({"diagnose", "s.sdf", "--layer", layer});
    EXPECT_EQ(outcome.exit_code, 0) << layer << outcome.out << outcome.err;
  }
  const Json json = json_of({"diagnose", "s.sdf", "--layer", "normal=a.normal.png", "--json", "-"});
  EXPECT_EQ(json["layers"][0]["verdict"], "right");
  EXPECT_EQ(json["layers"][0]["encoding"], "n / 2 + 1/2");
  EXPECT_EQ(run({"diagnose", "s.sdf", "--layer", "normal=a.shadow.png"}).exit_code, 3);
}

TEST_F(DiagnoseCommand, ALayerStandsBesideAPicture) {
  ASSERT_EQ(run({"render", "s.sdf", "-o", "a.exr", "--layers", "normal"}).exit_code, 0);
  const std::string turned = run({"render", "s.sdf", "--fault", "ka-kd-swapped", "-o", "b.ppm"}).err;
  const Outcome outcome = run({"diagnose", "s.sdf", "b.ppm", "--layer", "normal=a.normal.png"});
  EXPECT_EQ(outcome.exit_code, 1) << turned;
  EXPECT_TRUE(contains(outcome.out, "ka-kd-swapped")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "a.normal.png: normal: right")) << outcome.out;
}

TEST_F(DiagnoseCommand, WhatIsNoLayerIsTrouble) {
  ASSERT_EQ(run({"render", "s.sdf", "-o", "a.exr", "--layers", "normal"}).exit_code, 0);
  expect_trouble(run({"diagnose", "s.sdf"}), {"found no picture", "--layer"});
  expect_trouble(run({"diagnose", "s.sdf", "--layer", "a.exr"}), {"normal=normals.png"});
  expect_trouble(run({"diagnose", "s.sdf", "--layer", "shadow=a.exr"}), {"expected normal or depth"});
  expect_trouble(run({"diagnose", "s.sdf", "--layer", "normals=a.exr"}), {"expected 'normal'"});
  expect_trouble(run({"render", "s.sdf", "-o", "a.png", "--layers", "normal"}), {"-o NAME.exr"});
  expect_trouble(run({"render", "s.sdf", "-o", "a.exr", "--layers", "normal,normal"}), {"twice"});
  expect_trouble(run({"render", "s.sdf", "-o", "a.exr", "--layers", "normal,"}), {"found ''"});
}

/// Pictures of two scenes in the directory c: s.ppm of the ball, t.ppm of even exponents.
class DiagnoseCase : public DiagnoseCommand {
 protected:
  DiagnoseCase() {
    std::filesystem::create_directory(workplace_.path("c"));
    workplace_.file("c/s.sdf", std::string(ball_scene));
    workplace_.file("c/t.sdf", read_file(source_path("tests/scenes/phong-even-exponent.sdf")));
  }
  void render(const std::string& name, const std::string& fault) const {
    std::vector<std::string> words{"render", "c/" + name + ".sdf", "-o", "c/" + name + ".ppm"};
    if (!fault.empty()) words.insert(words.end(), {"--fault", fault});
    ASSERT_EQ(run(words).exit_code, 0);
  }
};

TEST_F(DiagnoseCase, WhatOneSceneCannotTellAnotherCan) {
  render("s", "specular-missing");
  const Json alone = json_of({"diagnose", "c/s.sdf", "c/s.ppm", "--json", "-"});
  EXPECT_EQ(alone["ambiguous"].size(), 1U) << alone;
  render("t", "specular-missing");
  const Json json = json_of({"diagnose", "--case", "c", "--json", "-"});
  EXPECT_EQ(json["verdict"], "faults");
  ASSERT_EQ(json["faults"].size(), 1U) << json;
  EXPECT_EQ(json["faults"][0]["id"], "specular-missing");
  EXPECT_EQ(json["faults"][0]["alike"], Json::array());
  EXPECT_EQ(json["faults"][0]["pictures"], Json({"s.ppm", "t.ppm"}));
  EXPECT_EQ(json["pictures"].size(), 2U);
  EXPECT_TRUE(contains(run({"diagnose", "--case", "c"}).out, "s.ppm, t.ppm"));
}

TEST_F(DiagnoseCase, AFaultIsTakenBackWhereAnotherPictureIsRightWithoutIt) {
  render("s", "ka-kd-swapped");
  render("t", "");
  const Outcome outcome = run({"diagnose", "--case", "c"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(contains(outcome.out, "not ka-kd-swapped")) << outcome.out;
  const Json json = json_of({"diagnose", "--case", "c", "--json", "-"});
  EXPECT_EQ(json["faults"], Json::array());
  EXPECT_EQ(json["withdrawn"][0]["contradicted_by"], "t.ppm");
}

TEST_F(DiagnoseCase, WhatCannotBeReadIsLeftOutWithItsReason) {
  render("s", "");
  workplace_.file("c/t.png", "no picture");
  workplace_.file("c/u.ppm", "P3 1 1 255 1 2 3");
  const Outcome outcome = run({"diagnose", "--case", "c"});
  EXPECT_EQ(outcome.exit_code, 2) << outcome.out << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "left out: c/t.png")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "left out: c/u.ppm: no scene has its name")) << outcome.out;
  EXPECT_EQ(json_of({"diagnose", "--case", "c", "--json", "-"})["verdict"], "unexplained");
  std::filesystem::remove(workplace_.path("c/t.png"));
  EXPECT_EQ(run({"diagnose", "--case", "c"}).exit_code, 0);
  std::filesystem::create_directory(workplace_.path("empty"));
  workplace_.file("c/s.ppm", "no picture either");
  EXPECT_EQ(run({"diagnose", "--case", "c"}).exit_code, 2);
  expect_trouble(run({"diagnose", "--case", "c/none"}), {"c/none"});
  expect_trouble(run({"diagnose", "--case", "c", "--scenes", "empty"}), {"no picture", "--scenes"});
  expect_trouble(run({"diagnose"}), {"SCENE and IMAGE", "--case"});
}

TEST_F(DiagnoseCommand, HintsTellMoreByAndBy) {
  ASSERT_EQ(run({"render", "s.sdf", "--fault", "ka-kd-swapped", "-o", "a.ppm"}).exit_code, 0);
  const std::string slide = run({"diagnose", "s.sdf", "a.ppm", "--hint", "1"}).out;
  const std::string mistake = run({"diagnose", "s.sdf", "a.ppm", "--hint", "2"}).out;
  EXPECT_TRUE(contains(slide, "look at the slide")) << slide;
  EXPECT_FALSE(contains(slide, "ka and kd")) << slide;
  EXPECT_TRUE(contains(mistake, "ka and kd")) << mistake;
  EXPECT_FALSE(contains(mistake, "ka-kd-swapped")) << mistake;
}

TEST_F(DiagnoseCommand, HintsHoldForJsonToo) {
  ASSERT_EQ(run({"render", "s.sdf", "--fault", "ka-kd-swapped", "-o", "a.ppm"}).exit_code, 0);
  const std::string slide = run({"diagnose", "s.sdf", "a.ppm", "--hint", "1", "--json", "-"}).out;
  for (const char* const secret : {"ka-kd-swapped", "ka and kd", "ambiguous", "tell_apart"})
    EXPECT_FALSE(contains(slide, secret)) << slide;
  EXPECT_TRUE(contains(slide, "\"slide\"")) << slide;
}

TEST_F(DiagnoseCommand, RedAndBlueExchangedIsNotRight) {
  ASSERT_EQ(run({"render", "s.sdf", "--fault", "red-blue-exchanged", "-o", "a.ppm"}).exit_code, 0);
  const Outcome outcome = run({"diagnose", "s.sdf", "a.ppm"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "red-blue-exchanged")) << outcome.out;
}

TEST_F(DiagnoseCommand, APictureOfOneColourNamesNoFault) {
  std::string dark = "P3 32 24 255\n";
  for (int i = 0; i < 32 * 24; ++i) dark += "0 0 0\n";
  workplace_.file("dark.ppm", dark);
  const Outcome outcome = run({"diagnose", "s.sdf", "dark.ppm"});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.out << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "the picture has one colour")) << outcome.out;
}

TEST_F(DiagnoseCommand, ItAbstainsFromAnotherPicture) {
  workplace_.file("other.sdf", replaced(ball_scene, "0 0 -3 1 red", "1 1 -3 0.5 red"));
  ASSERT_EQ(run({"render", "other.sdf", "-o", "a.ppm"}).exit_code, 0);
  const Outcome outcome = run({"diagnose", "s.sdf", "a.ppm"});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "no set of known faults explains it")) << outcome.out;
}

TEST_F(DiagnoseCommand, AnotherBackgroundIsAHabit) {
  workplace_.file("room.sdf", room_scene);
  workplace_.file("black.sdf", replaced(room_scene, "background 0.1 0.15 0.3", "background 0 0 0"));
  ASSERT_EQ(run({"render", "black.sdf", "-o", "a.ppm"}).exit_code, 0);
  const Outcome outcome = run({"diagnose", "room.sdf", "a.ppm"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.out << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "right, with habits")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "habit: Where nothing is hit, it is black. (0 0 0)")) << outcome.out;
  const Json json = json_of({"diagnose", "room.sdf", "a.ppm", "--json", "-"});
  EXPECT_TRUE(json["faults"].empty()) << json;
  EXPECT_EQ(json["habits"][0]["id"], "background") << json;
  EXPECT_EQ(json["certain"]["camera"], "right") << json;
}

TEST_F(DiagnoseCommand, ACameraIsRightThoughTheColoursAreNot) {
  workplace_.file("room.sdf", room_scene);
  workplace_.file("other.sdf", replaced(room_scene, "define light key 4 6 2 1 1 1 1",
                                        "define light key -5 1 3 0.6 0.9 0.7 1"));
  ASSERT_EQ(run({"render", "other.sdf", "-o", "a.ppm"}).exit_code, 0);
  const Outcome outcome = run({"diagnose", "room.sdf", "a.ppm"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.out << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "camera: right")) << outcome.out;
  EXPECT_FALSE(contains(outcome.out, "confidence")) << outcome.out;
}

TEST_F(DiagnoseCommand, WhatIsNearlyRightIsCountedAndNamed) {
  workplace_.file("with.sdf", replaced(ball_scene, "define light",
                                       "define shape sphere tiny 0.9 0.7 -2.6 0.09 red\ndefine light"));
  ASSERT_EQ(run({"render", "s.sdf", "-o", "a.ppm"}).exit_code, 0);
  const Outcome outcome = run({"diagnose", "with.sdf", "a.ppm"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "a.ppm: right apart from ")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "'tiny'")) << outcome.out;
  const Json json = json_of({"diagnose", "with.sdf", "a.ppm", "--json", "-"});
  EXPECT_EQ(json["verdict"], "right_apart");
  EXPECT_EQ(json["shapes"][0]["name"], "tiny");
  EXPECT_EQ(json["pixels"], json["unexplained_pixels"]);
}

TEST_F(DiagnoseCommand, WhatIsNotRightIsNeverNoPixelAway) {
  workplace_.file("other.sdf", replaced(ball_scene, "ambient 0.2 0.2 0.2", "ambient 0.2003 0.2 0.2"));
  ASSERT_EQ(run({"render", "other.sdf", "-o", "a.pfm"}).exit_code, 0);
  const Outcome outcome = run({"diagnose", "s.sdf", "a.pfm"});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.out;
  EXPECT_FALSE(contains(outcome.out, "remaining: 0 pixels")) << outcome.out;
  EXPECT_FALSE(contains(outcome.out, "is it a picture of this scene?")) << outcome.out;
}

TEST_F(DiagnoseCommand, SwappedArgumentsAreNamed) {
  ASSERT_EQ(run({"render", "s.sdf", "-o", "a.ppm"}).exit_code, 0);
  expect_trouble(run({"diagnose", "a.ppm", "s.sdf"}), {"plumb diagnose s.sdf a.ppm"});
}

TEST_F(DiagnoseCommand, APictureOfAnotherSizeIsRefused) {
  ASSERT_EQ(run({"render", "s.sdf", "--size", "40x24", "-o", "a.ppm"}).exit_code, 0);
  expect_trouble(run({"diagnose", "s.sdf", "a.ppm"}), {"a.ppm", "40x24", "32x24", "--size 40x24"});
  EXPECT_EQ(run({"diagnose", "s.sdf", "a.ppm", "--size", "40x24"}).exit_code, 0);
  expect_trouble(run({"diagnose", "s.sdf", "a.ppm", "--size", "80x48"}), {"a.ppm", "40x24", "80x48"});
  ASSERT_EQ(run({"render", "s.sdf", "--size", "64x48", "-o", "a.ppm"}).exit_code, 0);
  EXPECT_EQ(run({"diagnose", "s.sdf", "a.ppm"}).exit_code, 0) << "the same view";
}

TEST_F(DiagnoseCommand, FaultsThatCannotBeToldApartAreListedInJsonAlone) {
  workplace_.file("blank.sdf", replaced(ball_scene, "0 0 -3 1 red", "0 0 -3 9 red"));
  ASSERT_EQ(run({"render", "s.sdf", "--fault", "tone-map-twice", "-o", "a.ppm"}).exit_code, 0);
  const std::string text = run({"diagnose", "s.sdf", "a.ppm"}).out;
  std::size_t alike = 0;
  for (std::size_t at = text.find("\n      or "); at != std::string::npos;
       at = text.find("\n      or ", at + 1))
    ++alike;
  EXPECT_LE(alike, 6U) << text;
}

TEST_F(DiagnoseCommand, AMissingPictureIsTrouble) {
  const Outcome outcome = run({"diagnose", "s.sdf", "none.ppm"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(contains(outcome.err, "none.ppm")) << outcome.err;
}

TEST_F(DiagnoseCommand, AnUnknownFaultIsNamedWithTheNearest) {
  const Outcome outcome = run({"render", "s.sdf", "--fault", "ka-kd-swaped", "-o", "a.ppm"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(contains(outcome.err, "did you mean ka-kd-swapped?")) << outcome.err;
}

TEST_F(DiagnoseCommand, FaultsAreListed) {
  const Json json = json_of({"faults", "--json", "-"});
  EXPECT_GE(json["faults"].size(), 45U);
  for (const Json& fault : json["faults"]) {
    EXPECT_FALSE(fault["wrong"] == fault["right"]) << fault;
    EXPECT_FALSE(fault["slide"].get<std::string>().empty()) << fault;
  }
  EXPECT_TRUE(contains(run({"faults"}).out, "pixel-corner (4, Kameramodell; 38 of 42)"));
}

}  // namespace
}  // namespace plumb::tests
