// `plumb lint`: all findings at once, and dialects that really read the file.
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "tests/support/end_to_end.hpp"

namespace plumb::tests {
namespace {

using Json = nlohmann::json;

/// Seven errors of other kinds, in other lines.
constexpr std::string_view wrong_in_seven_ways =
    "define material red 0.4 0.1 0.1 0.6 0.2 0.1 0.3 0.2\n"
    "define shape sphere ball 0 0 -3 0 red\n"
    "define shape sphere ball 0 0 -3 1 red\n"
    "define shape box block 0 0 0 1 1 1 rad\n"
    "define light key 4 6 x 1 1 1 1\n"
    "ambient 0.2 0.2\n"
    "define camera eye 600\n"
    "render eye out.ppm 32 24\n";

/// What people of the course wrote: extra fields of a material, an own light, other spellings.
constexpr std::string_view as_people_write =
    "define material red 0.4 0.1 0.1 0.6 0.2 0.1 0.3 0.2 0.1 20 0.1 1 1.5\n"
    "define shape sphere ball 0 0 -3 -1 red\n"
    "define light key 4 6 2 1 1 1\n"
    "define amblight 0.2 0.2 0.2\n"
    "define camera eye 60 // the camera\n"
    "render eye image . ppm 16 12\n";

class Lint : public testing::Test {
 protected:
  Outcome lint(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "lint");
    return run_plumb(arguments, workplace_.directory());
  }
  Json lint_json(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--json", "-"});
    const Outcome outcome = lint(arguments);
    EXPECT_TRUE(Json::accept(outcome.out)) << outcome.out << outcome.err;
    return Json::parse(outcome.out, nullptr, false);
  }
  Outcome run(const std::vector<std::string>& arguments) const {
    return run_plumb(arguments, workplace_.directory());
  }
  void file(const std::string& name, std::string_view text) const {
    workplace_.file(name, std::string(text));
  }

  Workplace workplace_;
};

/// X of the lines `    --dialect X`.
std::vector<std::string> proposals(const std::string& out) {
  std::vector<std::string> found;
  std::istringstream lines(out);
  const std::string before = "    --dialect ";
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(before)) found.push_back(line.substr(before.size()));
  }
  return found;
}

TEST_F(Lint, AGoodSceneHasNothingToReport) {
  file("ball.sdf", ball_scene);
  const Outcome outcome = lint({"ball.sdf"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out, "ball.sdf: 0 errors, 0 warnings\n");
  EXPECT_EQ(outcome.err, "");
}

TEST_F(Lint, WarningsAreNoErrors) {
  file("bare.sdf", "ambient 1 1 1\n");
  const Outcome outcome = lint({"bare.sdf"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_TRUE(contains(outcome.out, "bare.sdf:1:1: warning: no camera")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "bare.sdf: 0 errors, 3 warnings\n")) << outcome.out;
}

TEST_F(Lint, AllFindingsAreReportedAtOnceInTheOrderOfTheFile) {
  file("bad.sdf", wrong_in_seven_ways);
  const Outcome outcome = lint({"bad.sdf"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err, "");
  std::size_t at = 0;
  for (const char* const place : {"1:17", "2:21", "3:21", "4:36", "5:22", "6:1", "7:15"}) {
    const std::size_t next = outcome.out.find("bad.sdf:" + std::string(place) + ": error: ");
    ASSERT_NE(next, std::string::npos) << place << "\n" << outcome.out;
    EXPECT_GE(next, at) << place;
    at = next;
  }
  EXPECT_TRUE(contains(outcome.out, "bad.sdf: 7 errors, 0 warnings\n")) << outcome.out;
}

TEST_F(Lint, ManyFindingsAreAllShown) {
  std::string text(ball_scene);
  for (int i = 0; i < 1000; ++i) text += "teapot\n";
  file("bad.sdf", text);
  const Outcome outcome = lint({"bad.sdf"});
  EXPECT_TRUE(contains(outcome.out, "bad.sdf:1007:1: error: "));
  EXPECT_TRUE(contains(outcome.out, "bad.sdf: 1000 errors, 0 warnings\n"));
}

TEST_F(Lint, SeveralFilesAreAllLintedAndOneBadOneIsTrouble) {
  file("good.sdf", ball_scene);
  file("bad.sdf", "teapot\n");
  const Outcome outcome = lint({"bad.sdf", "missing.sdf", ".", "good.sdf"});
  EXPECT_EQ(outcome.exit_code, 2);
  for (const char* const part :
       {"bad.sdf:1:1: error: found 'teapot'", "missing.sdf: cannot be read: No such file",
        ".: is a directory", "good.sdf: 0 errors, 0 warnings\n"}) {
    EXPECT_TRUE(contains(outcome.out, part)) << part << "\n" << outcome.out;
  }
  EXPECT_EQ(lint({"good.sdf", "good.sdf"}).exit_code, 0);
}

TEST_F(Lint, ASceneThatNoDialectReadsGetsNoProposal) {
  file("bad.sdf", "teapot\n");
  EXPECT_TRUE(proposals(lint({"bad.sdf"}).out).empty());
}

TEST_F(Lint, AGoodSceneGetsNoProposal) {
  file("ball.sdf", ball_scene);
  EXPECT_TRUE(proposals(lint({"ball.sdf"}).out).empty());
}

TEST_F(Lint, WhatTheOrderOfTransformsDecidesIsSaid) {
  const std::string ball = "define material m 1 0 0 1 0 0 1 1 1 20\ndefine shape sphere ball 0 0 -3 1 m\n";
  file("turned.sdf", ball + "transform ball translate 1 0 0\ntransform ball rotate 90 0 0 1\n");
  file("moved.sdf", ball + "transform ball translate 1 0 0\ntransform ball translate 0 2 0\n");
  const std::string said = "where 'ball' stands depends on the order of its transforms";
  EXPECT_NE(lint({"turned.sdf"}).out.find(said), std::string::npos);
  EXPECT_EQ(lint({"turned.sdf", "--dialect", "pre"}).out.find(said), std::string::npos);
  EXPECT_EQ(lint({"moved.sdf"}).out.find(said), std::string::npos);
  EXPECT_EQ(lint_json({"turned.sdf"})["scenes"][0]["placed_by_order"], Json({"ball"}));
  EXPECT_EQ(lint_json({"moved.sdf"})["scenes"][0]["placed_by_order"], Json::array());
}

TEST_F(Lint, NothingIsWritten) {
  file("people.sdf", as_people_write);
  lint({"people.sdf"});
  EXPECT_EQ(listing(workplace_.directory()), (std::vector<std::string>{"people.sdf"}));
}

TEST_F(Lint, EveryProposalReallyReadsTheScene) {
  file("people.sdf", as_people_write);
  const Outcome outcome = lint({"people.sdf"});
  EXPECT_EQ(outcome.exit_code, 2);
  const auto dialects = proposals(outcome.out);
  ASSERT_GE(dialects.size(), 4U) << outcome.out;
  EXPECT_EQ(std::set<std::string>(dialects.begin(), dialects.end()).size(), dialects.size())
      << "twice the same";
  EXPECT_TRUE(contains(outcome.out, "only its author knows")) << outcome.out;
  EXPECT_EQ(run({"export", "people.sdf", "-o", "scene.pov"}).exit_code, 2);
  for (const std::string& dialect : dialects) {
    SCOPED_TRACE(dialect);
    EXPECT_EQ(lint({"people.sdf", "--dialect", dialect}).exit_code, 0);
    EXPECT_EQ(run({"export", "people.sdf", "--dialect", dialect, "-o", "scene.pov"}).exit_code, 0);
    EXPECT_EQ(run({"render", "people.sdf", "--dialect", dialect, "-o", "image.ppm"}).exit_code, 0);
  }
}

/// Both polarities of opacity are among the readings of a material with extra fields.
TEST_F(Lint, BothPolaritiesOfOpacityAreProposed) {
  file("people.sdf", as_people_write);
  const std::string out = lint({"people.sdf"}).out;
  EXPECT_TRUE(contains(out, "-opacity")) << out;
  EXPECT_TRUE(contains(out, "-transparency")) << out;
}

TEST_F(Lint, AProposalIsVerifiedAgainstPovRay) {
  if (system::find_program("povray").empty()) GTEST_SKIP() << "POV-RAY IS NOT INSTALLED";
  file("people.sdf", as_people_write);
  const auto dialects = proposals(lint({"people.sdf"}).out);
  ASSERT_FALSE(dialects.empty());
  for (const std::string& dialect : {dialects.front(), dialects.back()}) {
    const Outcome outcome = run({"verify", "people.sdf", "--dialect", dialect});
    EXPECT_EQ(outcome.exit_code, 0) << dialect << outcome.out << outcome.err;
  }
}

struct Spelling {
  std::string name;
  std::string from;
  std::string to;
  std::string dialect;
};
void PrintTo(const Spelling& spelling, std::ostream* out) { *out << spelling.name; }

class OtherSpelling : public Lint, public testing::WithParamInterface<Spelling> {};
INSTANTIATE_TEST_SUITE_P(Of, OtherSpelling,
                         testing::ValuesIn(std::vector<Spelling>{
                             {"Comment", "ambient 0.2 0.2 0.2", "ambient 0.2 0.2 0.2 // grey", "loose"},
                             {"Ambient", "ambient", "define ambient", "loose"},
                             {"AmbientOfOneNumber", "ambient 0.2 0.2 0.2", "ambient 0.2", "loose"},
                             {"AmbientAsLight", "ambient 0.2", "define light ambient amb 0.2", "loose"},
                             {"ImageWithBlanks", "out.ppm", "out . ppm", "loose"},
                             {"NoBlankAfterDefine", "define camera", "definecamera", "loose"},
                             {"NegativeRadius", "-3 1 red", "-3 -1 red", "loose"},
                             {"LightOfSix", "1 1 1 1\n", "1 1 1\n", "light-color"},
                             {"LightOfLaAndLd", "1 1 1 1\n", "0.1 0.1 0.1 1 1 1\n", "la-ld"},
                             {"LightOfLaLdAndBrightness", "1 1 1 1\n", "0.1 0.1 0.1 1 1 1 1\n",
                              "la-ld-brightness"},
                             {"MaterialOf11", "0.1 20\n", "0.1 20 0.5\n", "refl"},
                             {"MaterialOf12", "0.1 20\n", "0.1 20 0.5 1\n", "refl-opacity"},
                             {"MaterialOf13", "0.1 20\n", "0.1 20 0.5 1 1.5\n", "refl-opacity-ior"},
                             {"MaterialOf14", "0.1 20\n", "0.1 20 1 0.5 1.5 0\n", "opacity-refl-ior-rough"},
                         }),
                         [](const auto& test) { return test.param.name; });

TEST_P(OtherSpelling, IsRefusedAndItsDialectProposed) {
  file("people.sdf", replaced(ball_scene, GetParam().from, GetParam().to));
  const Outcome outcome = lint({"people.sdf"});
  EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
  const auto dialects = proposals(outcome.out);
  EXPECT_NE(std::find(dialects.begin(), dialects.end(), GetParam().dialect), dialects.end()) << outcome.out;
  EXPECT_EQ(lint({"people.sdf", "--dialect", GetParam().dialect}).exit_code, 0);
}

// --- JSON -----------------------------------------------------------------------------------------

TEST_F(Lint, JsonTellsFindingsAndDialects) {
  file("people.sdf", as_people_write);
  file("good.sdf", ball_scene);
  const Json json = lint_json({"people.sdf", "good.sdf", "missing.sdf"});
  EXPECT_EQ(json.at("tool"), "plumb");
  EXPECT_EQ(json.at("version"), PLUMB_VERSION);
  ASSERT_EQ(json.at("scenes").size(), 3U);

  const Json& people = json.at("scenes").at(0);
  EXPECT_EQ(people.at("scene"), "people.sdf");
  EXPECT_EQ(people.at("status"), "error");
  EXPECT_EQ(people.at("message"), "");
  EXPECT_EQ(people.at("dialects"), proposals(lint({"people.sdf"}).out));
  EXPECT_GE(people.at("findings").size(), 6U);
  const Json& first = people.at("findings").at(0);
  EXPECT_EQ(first.at("severity"), "error");
  EXPECT_EQ(first.at("line"), 1);
  EXPECT_EQ(first.at("column"), 17);
  EXPECT_TRUE(contains(first.at("message"), "13 numbers")) << first;

  const Json& good = json.at("scenes").at(1);
  EXPECT_EQ(good.at("status"), "readable");
  EXPECT_TRUE(good.at("findings").empty());
  EXPECT_TRUE(good.at("dialects").empty());

  const Json& missing = json.at("scenes").at(2);
  EXPECT_EQ(missing.at("status"), "error");
  EXPECT_TRUE(contains(missing.at("message"), "cannot be read")) << missing;
}

TEST_F(Lint, JsonHasTheExitCodeOfTheText) {
  file("good.sdf", ball_scene);
  file("bad.sdf", "teapot\n");
  EXPECT_EQ(lint({"good.sdf", "--json", "-"}).exit_code, 0);
  EXPECT_EQ(lint({"bad.sdf", "--json", "-"}).exit_code, 2);
}

TEST_F(Lint, JsonInAFileIsBesideTheText) {
  file("bad.sdf", "teapot\n");
  const Outcome outcome = lint({"bad.sdf", "--json", "findings.json"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(contains(outcome.out, "bad.sdf:1:1: error: ")) << outcome.out;
  EXPECT_EQ(Json::parse(read_file(workplace_.path("findings.json"))).at("scenes").size(), 1U);
}

TEST_F(Lint, JsonOfABinaryFileIsValid) {
  file("binary.sdf", std::string("\xff\xfe\x80\x81 \x01\x02\n\xc3(", 10));
  EXPECT_EQ(lint_json({"binary.sdf"}).at("scenes").at(0).at("status"), "error");
}

TEST_F(Lint, TheScenesOfTheProjectHaveNoErrors) {
  std::vector<std::string> scenes;
  for (const auto& entry : std::filesystem::directory_iterator(source_path("tests/scenes"))) {
    if (entry.path().extension() == ".sdf") scenes.push_back(entry.path().string());
  }
  ASSERT_FALSE(scenes.empty());
  const Outcome outcome = lint(scenes);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out;
}

}  // namespace
}  // namespace plumb::tests
