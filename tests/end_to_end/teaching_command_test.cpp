// The pages for students, and the scene that settles what a picture leaves open.
#include <nlohmann/json.hpp>

#include "tests/support/end_to_end.hpp"

namespace plumb::tests {
namespace {

using Json = nlohmann::json;

class TeachingCommand : public testing::Test {
 protected:
  Outcome run(const std::vector<std::string>& arguments) const {
    return run_plumb(arguments, workplace_.directory());
  }
  std::string text_of(const std::string& name) const { return read_file(workplace_.path(name)); }
  /// Makes p.ppm of a scene of ours.
  std::string picture(const std::string& scene, const std::string& faults) const {
    EXPECT_EQ(run({"render", source_path("tests/scenes/" + scene), "--fault", faults, "-o", "p.ppm", "--size",
                   "80x60"})
                  .exit_code,
              0);
    return source_path("tests/scenes/" + scene);
  }

  Workplace workplace_;
};

TEST_F(TeachingCommand, ThePageOfTheFaultsHasAPairOfPicturesForEach) {
  const Outcome outcome = run({"faults", "--report", "pages", "--json", "faults.json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string page = text_of("pages/index.html");
  std::size_t pictures = 0;
  for (std::size_t at = page.find("<img "); at != std::string::npos; at = page.find("<img ", at + 1))
    ++pictures;
  const Json faults = Json::parse(text_of("faults.json"))["faults"];
  EXPECT_EQ(pictures, 3 * faults.size());
  for (const Json& fault : faults) {
    const std::string id = fault["id"];
    EXPECT_TRUE(contains(page, "<section id=\"" + id + "\">")) << id;
    EXPECT_TRUE(contains(page, "<a href=\"#" + id + "\">")) << id;
  }
  EXPECT_FALSE(contains(page, "://")) << "the page needs no other file";
}

TEST_F(TeachingCommand, WhatIsAmbiguousIsSettledByTheSceneThatIsNamed) {
  for (const auto& [scene, fault] :
       {std::pair{"box.sdf", "inverse-square-falloff"}, {"phong.sdf", "specular-absolute"}}) {
    const Json open = Json::parse(run({"diagnose", picture(scene, fault), "p.ppm", "--json", "-"}).out);
    ASSERT_EQ(open["faults"].size(), 1U) << open;
    ASSERT_EQ(open["tell_apart"].size(), 1U) << open;
    const Json& group = open["tell_apart"][0];
    EXPECT_NEAR(open["faults"][0]["confidence"], 1.0 / static_cast<double>(group["faults"].size()), 1e-9);
    ASSERT_TRUE(group["scene"].is_string()) << group;
    const std::string other = group["scene"].get<std::string>().substr(std::string("tests/scenes/").size());
    const Json settled = Json::parse(run({"diagnose", picture(other, fault), "p.ppm", "--json", "-"}).out);
    ASSERT_EQ(settled["faults"].size(), 1U) << settled;
    EXPECT_EQ(settled["faults"][0]["id"], fault);
    EXPECT_TRUE(settled["ambiguous"].empty()) << settled;
    EXPECT_GT(settled["faults"][0]["confidence"], 0.9);
  }
}

TEST_F(TeachingCommand, ADiagnosisHasAPageThatTellsAsMuchAsTheHint) {
  const std::string scene = picture("combined-still-life.sdf", "pixel-corner");
  const auto page = [&](const char* hint) {
    const Outcome outcome = run({"diagnose", scene, "p.ppm", "--report", "d", "--hint", hint});
    EXPECT_EQ(outcome.exit_code, 1) << outcome.out << outcome.err;
    EXPECT_TRUE(contains(outcome.out, "report: d/diagnose.html")) << outcome.out;
    return text_of("d/diagnose.html");
  };
  const std::string slide = page("1");
  const std::string mistake = page("2");
  const std::string formula = page("3");
  EXPECT_TRUE(contains(slide, "Look at the slide"));
  EXPECT_FALSE(contains(slide, "instead of its centre"));
  EXPECT_TRUE(contains(mistake, "instead of its centre"));
  EXPECT_FALSE(contains(mistake, "pixel-corner"));
  EXPECT_TRUE(contains(formula, "<section id=\"pixel-corner\">"));
  EXPECT_TRUE(contains(formula, "confidence "));
}

TEST_F(TeachingCommand, ThePageNamesTheSceneThatSettlesWhatIsOpen) {
  const std::string scene = picture("phong.sdf", "specular-absolute");
  EXPECT_EQ(run({"diagnose", scene, "p.ppm", "--report", "d"}).exit_code, 1);
  EXPECT_TRUE(
      contains(text_of("d/diagnose.html"), "diagnose <code>tests/scenes/phong-odd-exponent.sdf</code>"));
}

TEST_F(TeachingCommand, ARightPictureHasAPageThatSaysSo) {
  const std::string scene = source_path("tests/scenes/lambert.sdf");
  ASSERT_EQ(run({"render", scene, "-o", "p.ppm"}).exit_code, 0);
  EXPECT_EQ(run({"diagnose", scene, "p.ppm", "--report", "d"}).exit_code, 0);
  EXPECT_TRUE(contains(text_of("d/diagnose.html"), "The picture is right."));
}

TEST_F(TeachingCommand, ACorpusHasItsMatrix) {
  std::filesystem::create_directory(workplace_.path("corpus"));
  workplace_.file("corpus/ball.sdf", std::string(ball_scene));
  const Outcome outcome = run({"faults", "--corpus", "corpus", "--json", "-"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json corpus = Json::parse(outcome.out)["corpus"];
  EXPECT_EQ(corpus["teaching_set"], Json({"ball.sdf"}));
  EXPECT_EQ(corpus["seen_in"]["pixel-corner"], Json({"ball.sdf"}));
  EXPECT_TRUE(corpus["seen_in"]["box-face-missing"].empty()) << "the scene has no box";
  EXPECT_FALSE(corpus["not_told_apart"].empty());
}

TEST_F(TeachingCommand, ACorpusWithoutScenesIsTrouble) {
  std::filesystem::create_directory(workplace_.path("corpus"));
  expect_trouble(run({"faults", "--corpus", "corpus"}), {"corpus", "found no scene", "*.sdf"});
}

}  // namespace
}  // namespace plumb::tests
