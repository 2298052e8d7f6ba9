// `plumb regress`: what it compares, what it says, what it stores and what it refuses.
#include <nlohmann/json.hpp>
#include <regex>

#include "tests/support/end_to_end.hpp"

namespace plumb::tests {
namespace {

using Json = nlohmann::json;

std::string moved_ball() { return replaced(ball_scene, "0 0 -3", "0 0.1 -3"); }

class Regress : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directory(workplace_.path("scenes"));
    workplace_.file("scenes/ball.sdf", std::string(ball_scene));
  }

  Outcome regress(const std::vector<std::string>& arguments,
                  const std::vector<std::string>& environment = {}) const {
    std::vector<std::string> all{"regress", "scenes"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return run_plumb(all, workplace_.directory(), environment);
  }
  Outcome approve(const std::string& scene, const std::string& because = "looked at") const {
    const Outcome outcome = regress({"--update", scene, "--because", because});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome;
  }
  /// The one scene's object, or the first's.
  Json scene_json(std::vector<std::string> arguments = {}) const {
    arguments.insert(arguments.end(), {"--json", "-"});
    const Outcome outcome = regress(arguments);
    EXPECT_TRUE(Json::accept(outcome.out)) << outcome.out << outcome.err;
    return Json::parse(outcome.out).at("scenes").at(0);
  }
  Json records() const { return Json::parse(read_file(workplace_.path("scenes/baselines/baselines.json"))); }
  std::vector<std::string> files() const { return listing(workplace_.directory()); }

  Workplace workplace_;
};

// --- judging --------------------------------------------------------------------------------------

TEST_F(Regress, AnApprovedSceneAgrees) {
  approve("ball");
  const auto before = files();
  const Outcome outcome = regress({});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out;
  EXPECT_EQ(outcome.err, "");
  EXPECT_TRUE(contains(outcome.out, "1 scene against scenes/baselines: 1 agree, 0 differ, 0 in trouble"))
      << outcome.out;
  EXPECT_FALSE(contains(outcome.out, "approve with")) << outcome.out;
  EXPECT_EQ(files(), before);
}

TEST_F(Regress, ADifferenceNamesTheWorstPixelBothValuesAndWhoApproved) {
  approve("ball", "the first light");
  workplace_.file("scenes/ball.sdf", moved_ball());
  const Outcome outcome = regress({});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.out;
  const std::regex worst(
      "[0-9]+ of 768 pixels are over; worst pixel \\([0-9]+, [0-9]+\\): ours [0-9.]+ [0-9.]+ [0-9.]+, "
      "baseline "
      "[0-9.]+ [0-9.]+ [0-9.]+, off by [0-9.]+\n");
  EXPECT_TRUE(std::regex_search(outcome.out, worst)) << outcome.out;
  for (const char* const part : {"the first light", "the scene file has changed since", "approve with: "})
    EXPECT_TRUE(contains(outcome.out, part)) << part << " is missing in\n" << outcome.out;
}

TEST_F(Regress, WhoApprovedFollowsTheDifferenceAndNotesOfAttributionAreLast) {
  const std::vector<std::string> large{"--size", "160x120"};  // more pixels over than are examined
  ASSERT_EQ(regress({"--update", "ball", "--because", "x", large[0], large[1]}).exit_code, 0);
  workplace_.file("scenes/ball.sdf", moved_ball());
  const std::string message = scene_json(large).at("message");
  std::vector<std::size_t> places;
  for (const char* const part : {" pixels are over; worst pixel ", "\nbaseline approved by ",
                                 "\nthe scene file has changed since\n", "not examined"}) {
    EXPECT_TRUE(contains(message, part)) << part << " is missing in\n" << message;
    places.push_back(message.find(part));
  }
  EXPECT_TRUE(std::is_sorted(places.begin(), places.end())) << message;
}

/// A change of one float's last bits is far below 1e-6; a change of 2e-6 is not.
TEST_F(Regress, TheToleranceDecides) {
  approve("ball");
  workplace_.file("scenes/ball.sdf", replaced(ball_scene, "background 0.1", "background 0.100002"));
  EXPECT_EQ(regress({}).exit_code, 1);
  EXPECT_EQ(regress({"--tolerance", "1e-5"}).exit_code, 0);
}

TEST_F(Regress, ANewSceneDiffersUntilItIsApproved) {
  const Outcome outcome = regress({});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(contains(outcome.out, "new: there is no baseline yet")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "approve with: ")) << outcome.out;
  EXPECT_EQ(files(), (std::vector<std::string>{"scenes", "scenes/ball.sdf"})) << "a look stores nothing";
  for (const char* const figure : {"max_error", "pixels_over", "worst", "metrics", "budget", "unverified"})
    EXPECT_TRUE(scene_json({}).at(figure).is_null()) << figure << ": nothing was compared";
}

TEST_F(Regress, AnotherSizeDiffers) {
  approve("ball");
  const Json scene = scene_json({"--size", "16x12"});
  EXPECT_EQ(scene.at("status"), "differ");
  EXPECT_TRUE(contains(scene.at("message"), "the size is 16x12, of the baseline 32x24")) << scene;
}

TEST_F(Regress, ABaselineWithoutItsSceneIsTroubleUntilItIsForgotten) {
  workplace_.file("scenes/other.sdf", std::string(ball_scene));
  approve("ball");
  approve("other");
  std::filesystem::remove(workplace_.path("scenes/ball.sdf"));
  const Outcome outcome = regress({});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(contains(outcome.out, "THE SCENE IS GONE")) << outcome.out;
  EXPECT_TRUE(contains(approve("ball", "it is gone").out, "forgotten ball"));
  EXPECT_EQ(regress({}).exit_code, 0);
  EXPECT_EQ(files(),
            (std::vector<std::string>{"scenes", "scenes/baselines", "scenes/baselines/baselines.json",
                                      "scenes/baselines/other.exr", "scenes/other.sdf"}));
}

TEST_F(Regress, ABadSceneIsTroubleAndDoesNotStopTheOthers) {
  approve("ball");
  workplace_.file("scenes/bad.sdf", "nonsense\n");
  const Outcome outcome = regress({});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(contains(outcome.out, "scenes/bad.sdf:1:1")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "1 agree, 0 differ, 1 in trouble")) << outcome.out;
}

TEST_F(Regress, HiddenFilesDirectoriesAndOthersAreNoScenes) {
  std::filesystem::create_directories(workplace_.path("scenes/deeper/folder.sdf"));
  workplace_.file("scenes/.hidden.sdf", "nonsense\n");
  workplace_.file("scenes/notes.txt", "nonsense\n");
  approve("ball");
  EXPECT_EQ(regress({}).exit_code, 0);
}

TEST_F(Regress, ADirectoryWithoutScenesIsTrouble) {
  std::filesystem::remove(workplace_.path("scenes/ball.sdf"));
  expect_trouble(regress({}), {"scenes", "*.sdf"});
  std::filesystem::remove(workplace_.path("scenes"));
  expect_trouble(regress({}), {"scenes", "no such directory"});
}

TEST_F(Regress, StartsNoPovRay) {
  approve("ball");
  EXPECT_EQ(regress({}, {"PATH=" + workplace_.path("nowhere")}).exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(workplace_.path(".cache")));
}

// --- damage ---------------------------------------------------------------------------------------

class DamagedBaselines : public Regress, public testing::WithParamInterface<Word> {};
INSTANTIATE_TEST_SUITE_P(By, DamagedBaselines,
                         testing::Values(Word{"NoImage"}, Word{"CutImage"}, Word{"OtherImage"},
                                         Word{"NoRecord"}, Word{"CutRecords"}, Word{"EmptyRecords"},
                                         Word{"RecordsAreNoList"}, Word{"RecordTwice"}, Word{"KeyIsGone"},
                                         Word{"PathLeadsOut"}),
                         [](const auto& test) { return std::string(test.param.text); });

TEST_P(DamagedBaselines, AreTroubleAndAreNotMadeAgain) {
  approve("ball");
  const std::string image = "scenes/baselines/ball.exr";
  const std::string all = "scenes/baselines/baselines.json";
  const std::string how = GetParam().text;
  Json json = records();
  if (how == "NoImage") std::filesystem::remove(workplace_.path(image));
  if (how == "CutImage") workplace_.file(image, read_file(workplace_.path(image)).substr(0, 600));
  if (how == "OtherImage") {
    ASSERT_EQ(run_plumb({"render", "scenes/ball.sdf", "-o", image, "--depth", "1", "--real", "float"},
                        workplace_.directory())
                  .exit_code,
              0);
  }
  if (how == "NoRecord") workplace_.file(all, "[]");
  if (how == "CutRecords") workplace_.file(all, "[{");
  if (how == "EmptyRecords") workplace_.file(all, "");
  if (how == "RecordsAreNoList") workplace_.file(all, "{}");
  if (how == "RecordTwice") workplace_.file(all, Json{json.at(0), json.at(0)}.dump());
  if (how == "KeyIsGone") json.at(0).erase("pixels_sha256");
  if (how == "PathLeadsOut") json.at(0)["image"] = "../../ball.exr";
  if (how == "KeyIsGone" || how == "PathLeadsOut") workplace_.file(all, json.dump());

  const auto before = files();
  const Outcome outcome = regress({});
  EXPECT_EQ(outcome.exit_code, 2) << outcome.out << outcome.err;
  const bool is_of_records =
      how != "NoImage" && how != "CutImage" && how != "OtherImage" && how != "NoRecord";
  EXPECT_TRUE(contains(outcome.out + outcome.err, is_of_records ? all + ": is damaged" : image))
      << outcome.out;
  EXPECT_EQ(files(), before);
  EXPECT_EQ(regress({"--update", "ball", "--because", "mended"}).exit_code, is_of_records ? 2 : 0);
  EXPECT_EQ(regress({}).exit_code, is_of_records ? 2 : 0);
}

// --- approving ------------------------------------------------------------------------------------

TEST_F(Regress, AnApprovalRecordsWhoWhenWhyAndHow) {
  EXPECT_EQ(regress({"--update", "ball", "--because", "it's \"right\"\n& <new>", "--size", "16x12"},
                    {"GIT_AUTHOR_NAME=Ada Lovelace", "GIT_AUTHOR_EMAIL="})
                .exit_code,
            0);
  const Json record = records().at(0);
  EXPECT_EQ(record.at("scene"), "ball.sdf");
  EXPECT_EQ(record.at("image"), "ball.exr");
  EXPECT_EQ(record.at("who"), "Ada Lovelace");
  EXPECT_EQ(record.at("why"), "it's \"right\"\n& <new>");
  EXPECT_EQ(record.at("version"), PLUMB_VERSION);
  EXPECT_EQ(record.at("width"), 16);
  EXPECT_EQ(record.at("height"), 12);
  const std::regex iso_8601("20[0-9]{2}-[01][0-9]-[0-3][0-9]T[0-2][0-9]:[0-5][0-9]:[0-6][0-9]Z");
  EXPECT_TRUE(std::regex_match(record.at("when").get<std::string>(), iso_8601)) << record;
  const auto sum = run_shell("sha256sum scenes/ball.sdf", workplace_.directory());
  EXPECT_EQ(record.at("scene_sha256"), sum.output.substr(0, sum.output.find(' ')));
}

TEST_F(Regress, WithoutAGitNameTheLoginNameIsRecorded) {
  EXPECT_EQ(regress({"--update", "ball", "--because", "x"},
                    {"HOME=" + workplace_.directory(), "XDG_CONFIG_HOME=" + workplace_.directory(),
                     "GIT_CONFIG_NOSYSTEM=1", "GIT_AUTHOR_NAME=", "GIT_AUTHOR_EMAIL="})
                .exit_code,
            0);
  const auto login = run_shell("id -un", workplace_.directory());
  EXPECT_EQ(records().at(0).at("who").get<std::string>() + "\n", login.output);
}

/// The recorded command makes the very file again.
TEST_F(Regress, TheRecordedCommandRendersTheBaseline) {
  workplace_.file("scenes/it's.sdf", std::string(ball_scene));
  EXPECT_EQ(regress({"--update", "it's", "--because", "x", "--size", "16x12", "--real", "float"}).exit_code,
            0);
  const std::string image = workplace_.path("scenes/baselines/it's.exr");
  std::filesystem::rename(image, workplace_.path("approved.exr"));
  const std::string command = records().at(0).at("command");
  const auto result =
      run_shell("plumb() { \"$PLUMB\" \"$@\"; }; PLUMB=$0; cd scenes; " + command, workplace_.directory());
  EXPECT_EQ(result.exit_code, 0) << command << "\n" << result.output;
  EXPECT_TRUE(read_file(image) == read_file(workplace_.path("approved.exr")));
}

TEST_F(Regress, TheShownCommandApproves) {
  for (const std::string& name : {std::string("ball"), std::string("a & <b> \"c\" 'd' $e"), std::string("-x"),
                                  std::string("two\nlines"), std::string("tab\t`x`\\n!*~\r")}) {
    workplace_.file("scenes/" + name + ".sdf", moved_ball());
  }
  const Outcome outcome = regress({"--json", "-", "--size", "16x12", "--real", "float"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  const Json scenes = Json::parse(outcome.out).at("scenes");
  ASSERT_EQ(scenes.size(), 5U);
  for (const Json& scene : scenes) {
    const std::string command = scene.at("approve");
    const auto result = run_shell(command, workplace_.directory());
    EXPECT_EQ(result.exit_code, 0) << command << "\n" << result.output;
  }
  EXPECT_EQ(regress({"--size", "16x12", "--real", "float"}).exit_code, 0);
}

TEST_F(Regress, ThePrintedCommandApproves) {
  std::filesystem::remove(workplace_.path("scenes/ball.sdf"));
  workplace_.file("scenes/two\n  'lines'\n.sdf", std::string(ball_scene));
  const std::string said = regress({}).out;
  const std::string before = "approve with: ";
  const std::string reason = "--because 'the new image is right'";
  const std::size_t begin = said.find(before) + before.size();
  const std::string command = said.substr(begin, said.find(reason) + reason.size() - begin);
  const auto result = run_shell(command, workplace_.directory());
  EXPECT_EQ(result.exit_code, 0) << command << "\n" << result.output;
  EXPECT_EQ(regress({}).exit_code, 0);
}

TEST_F(Regress, ASceneIsNamedByNameFileOrPath) {
  for (const std::string& name :
       {std::string("ball"), std::string("ball.sdf"), std::string("scenes/ball.sdf"),
        std::string("./scenes/../scenes/ball.sdf"), workplace_.path("scenes/ball.sdf")}) {
    EXPECT_TRUE(contains(approve(name).out, " ball 32x24")) << name;
  }
  EXPECT_EQ(records().size(), 1U);
}

TEST_F(Regress, UpdatesKeepEachOthersRecords) {
  workplace_.file("scenes/other.sdf", moved_ball());
  approve("other", "second of the alphabet");
  approve("ball", "first of the alphabet");
  ASSERT_EQ(records().size(), 2U);
  EXPECT_EQ(records().at(0).at("why"), "first of the alphabet");
  EXPECT_EQ(records().at(1).at("why"), "second of the alphabet");
  EXPECT_EQ(regress({}).exit_code, 0);
}

TEST_F(Regress, UpdatesAtTheSameTimeKeepEachOthersRecords) {
  constexpr int updates = 8;
  std::string commands;
  for (int i = 0; i < updates; ++i) {
    const std::string name = "s" + std::to_string(i);
    workplace_.file("scenes/" + name + ".sdf", std::string(ball_scene));
    commands += "\"$0\" regress scenes --update " + name + " --because x & ";
  }
  run_shell(commands + "wait", workplace_.directory());
  EXPECT_EQ(records().size(), static_cast<std::size_t>(updates));
}

TEST_F(Regress, AnUpdateNeedsAReason) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"--update", "ball"},
        std::vector<std::string>{"--update", "ball", "--because", ""},
        std::vector<std::string>{"--update", "ball", "--because", " \t\n"}}) {
    expect_trouble(regress(arguments), {"--because"});
  }
  EXPECT_EQ(files(), (std::vector<std::string>{"scenes", "scenes/ball.sdf"}));
}

TEST_F(Regress, AnUpdateNeedsScenes) {
  expect_trouble(regress({"--update", "--because", "x"}), {"--update", "scenes/*.sdf"});
  expect_trouble(regress({"--update"}), {"--update", "scenes/*.sdf"});
}

TEST_F(Regress, AReasonWithoutAnUpdateIsTrouble) {
  expect_trouble(regress({"--because", "x"}), {"--because", "--update"});
}

TEST_F(Regress, AnUnknownSceneNamesTheNearest) {
  expect_trouble(regress({"--update", "bal.sdf", "--because", "x"}), {"'bal.sdf'", "did you mean 'ball'"});
  workplace_.file("ball.sdf", std::string(ball_scene));
  workplace_.file("elsewhere.sdf", std::string(ball_scene));
  expect_trouble(regress({"--update", "./elsewhere.sdf", "--because", "x"}), {"./elsewhere.sdf"});
  expect_trouble(regress({"--update", "./ball.sdf", "--because", "x"}), {"./ball.sdf"});
}

// --- what is never stored -------------------------------------------------------------------------

class NotFinite : public Regress {
 protected:
  /// Finite in double, infinite in the float32 of a picture.
  void SetUp() override {
    Regress::SetUp();
    workplace_.file("scenes/bright.sdf", replaced(ball_scene, "1 1 1 1\n", "1 1 1 1e100\n"));
  }
};

TEST_F(NotFinite, AnImageIsRefusedAndWithItTheWholeUpdate) {
  const auto before = files();
  const Outcome outcome = regress({"--update", "ball", "bright", "--because", "x"});
  expect_trouble(outcome, {"scenes/bright.sdf", "not finite", "(", "inf"});
  EXPECT_EQ(files(), before);
}

TEST_F(NotFinite, AnImageDiffersAndNoCommandIsOffered) {
  const Outcome outcome = regress({"--json", "-"});
  const Json scene = Json::parse(outcome.out).at("scenes").at(1);
  EXPECT_EQ(scene.at("status"), "differ");
  EXPECT_EQ(scene.at("approve"), "");
  EXPECT_TRUE(contains(scene.at("message"), "cannot be approved")) << scene;
}

TEST_F(NotFinite, AnImageDiffersFromAFiniteBaseline) {
  approve("ball");
  workplace_.file("scenes/ball.sdf", read_file(workplace_.path("scenes/bright.sdf")));
  const Json scene = scene_json();
  EXPECT_EQ(scene.at("status"), "differ");
  EXPECT_GT(scene.at("non_finite"), 0);
  EXPECT_TRUE(contains(scene.at("message"), "inf")) << scene;
}

/// A limit on the size of files stands for a full disk: first for the image, then for the records alone.
TEST_F(Regress, AFullDiskLeavesAllAsItWas) {
  approve("ball", "the first");
  const std::string old_image = read_file(workplace_.path("scenes/baselines/ball.exr"));
  const std::string old_records = read_file(workplace_.path("scenes/baselines/baselines.json"));
  workplace_.file("scenes/ball.sdf", moved_ball());
  const auto before = files();
  for (const char* const attempt : {"ulimit -f 1; \"$0\" regress scenes --update ball --because x",
                                    "b=$(head -c 60000 /dev/zero | tr '\\0' x); ulimit -f 60; \"$0\" regress "
                                    "scenes --update ball --because "
                                    "$b"}) {
    expect_trouble(run_shell(attempt, workplace_.directory()), {"cannot be written"});
    EXPECT_EQ(read_file(workplace_.path("scenes/baselines/ball.exr")), old_image);
    EXPECT_EQ(read_file(workplace_.path("scenes/baselines/baselines.json")), old_records);
    EXPECT_EQ(files(), before);
  }
}

TEST_F(Regress, ASignalLeavesNothingBehind) {
  const auto before = files();
  const auto result = run_shell(
      "\"$0\" regress scenes --update ball --because x --size 4000x4000 & for i in $(seq 500); do ls -d "
      "scenes/.plumb-* 2>/dev/null && break; sleep 0.02; done; kill -TERM $!; wait $!; echo code $?",
      workplace_.directory());
  EXPECT_TRUE(contains(result.output, "code 143")) << result.output;
  EXPECT_EQ(files(), before);
}

TEST_F(Regress, ANameThatIsNoUtf8IsRefused) {
  workplace_.file("scenes/b\xE4ll.sdf", std::string(ball_scene));
  const auto before = files();
  expect_trouble(regress({"--update", "b\xE4ll", "--because", "x"}), {"UTF-8"});
  EXPECT_TRUE(Json::accept(regress({"--json", "-"}).out));
  EXPECT_FALSE(std::filesystem::exists(workplace_.path("scenes/baselines/baselines.json")));
}

// --- the report -----------------------------------------------------------------------------------

class RegressReport : public Regress {
 protected:
  /// The first scene of the page.
  Json shown(std::vector<std::string> arguments = {}) const {
    arguments.insert(arguments.end(), {"--report", "out"});
    regress(arguments);
    const std::string page = read_file(workplace_.path("out/index.html"));
    const std::string open = "id=\"report-data\">";
    const std::size_t begin = page.find(open) + open.size();
    return Json::parse(page.substr(begin, page.find("</script>", begin) - begin)).at("scenes").at(0);
  }
};

TEST_F(RegressReport, ItsPlaceIsSaid) {
  EXPECT_TRUE(contains(regress({"--report", "out"}).out, "\nreport: out/index.html\n"));
  EXPECT_TRUE(Json::accept(regress({"--report", "out", "--json", "-"}).out)) << "JSON is alone";
  EXPECT_TRUE(regress({"--report", "out", "--junit", "-"}).out.ends_with("</testsuites>\n"));
}

TEST_F(RegressReport, ASceneWithoutABaselineHasNoFigures) {
  const Json result = shown().at("result");
  EXPECT_EQ(result.at("status"), "differ");
  EXPECT_TRUE(contains(result.at("not_compared"), "there is nothing to compare with")) << result;
  for (const char* const figure : {"max_error", "judged_error", "mean_error", "rms_error", "pixels_over",
                                   "non_finite", "worst", "budget", "metrics"})
    EXPECT_FALSE(result.contains(figure)) << figure;
}

TEST_F(RegressReport, NorHasOneOfAnotherSizeOrInTrouble) {
  approve("ball");
  EXPECT_TRUE(contains(shown({"--size", "16x12"}).at("result").at("not_compared"), "sizes"));
  workplace_.file("scenes/ball.sdf", "nonsense\n");
  const Json result = shown().at("result");
  EXPECT_EQ(result.at("not_compared"), "nothing was compared");
  EXPECT_FALSE(result.contains("max_error"));
}

TEST_F(RegressReport, AComparedSceneHasFigures) {
  approve("ball");
  const Json result = shown().at("result");
  EXPECT_FALSE(result.contains("not_compared"));
  EXPECT_EQ(result.at("max_error"), 0);
  EXPECT_EQ(result.at("pixels_over"), 0);
}

TEST_F(RegressReport, WhatIsIgnoredIsMarked) {
  approve("ball");
  EXPECT_EQ(shown().at("causes"), Json::array());
  EXPECT_EQ(shown({"--ignore", "0,0,4,4"}).at("causes"), Json::array({"ignored"}));
}

TEST_F(RegressReport, NeitherHasTheTable) {
  EXPECT_TRUE(contains(regress({}).out, " 32x24          -        -       -       -  differ\n"))
      << regress({}).out;
}

// --- JSON and JUnit -------------------------------------------------------------------------------

TEST_F(Regress, JsonHasTheKeysOfVerifyAndTheCommand) {
  approve("ball");
  workplace_.file("scenes/ball.sdf", moved_ball());
  const Outcome outcome = regress({"--json", "-"});
  EXPECT_EQ(outcome.exit_code, 1);
  const Json json = Json::parse(outcome.out);
  EXPECT_EQ(json.at("tool"), "plumb");
  EXPECT_EQ(json.at("version"), PLUMB_VERSION);
  EXPECT_EQ(json.at("baselines"), "scenes/baselines");
  const Json& scene = json.at("scenes").at(0);
  EXPECT_EQ(scene.at("scene"), "scenes/ball.sdf");
  EXPECT_EQ(scene.at("status"), "differ");
  EXPECT_EQ(scene.at("width"), 32);
  EXPECT_GT(scene.at("max_error"), 0.01);
  EXPECT_GT(scene.at("pixels_over"), 0);
  for (const char* const key : {"message", "height", "judged_error", "mean_error", "rms_error", "non_finite",
                                "worst", "budget", "shapes", "seconds", "cached"}) {
    EXPECT_TRUE(scene.contains(key)) << key;
  }
  EXPECT_TRUE(contains(scene.at("approve"), " regress scenes --update scenes/ball.sdf --because ")) << scene;
}

TEST_F(Regress, JsonAndJunitCannotBothBeStandardOutput) {
  expect_trouble(regress({"--json", "-", "--junit", "-"}), {"--json", "--junit"});
}

TEST_F(Regress, JunitTellsThatTheRecordsAreDamaged) {
  approve("ball");
  ASSERT_EQ(regress({"--junit", "junit.xml"}).exit_code, 0);
  workplace_.file("scenes/baselines/baselines.json", "[{");
  const Outcome outcome = regress({"--junit", "junit.xml"});
  expect_trouble(outcome, {"baselines.json: is damaged"});
  workplace_.file(
      "read.py",
      "import xml.etree.ElementTree as tree\n"
      "root = tree.parse('junit.xml').getroot()\n"
      "print(root.get('errors'), root.get('tests'), root.find('.//testcase/error').get('message'))\n");
  const auto result = run_shell("python3 read.py", workplace_.directory());
  ASSERT_EQ(result.exit_code, 0) << result.output;
  EXPECT_TRUE(result.output.starts_with("1 1 ")) << "that of the run before is gone: " << result.output;
  EXPECT_TRUE(contains(result.output, "baselines.json: is damaged")) << result.output;
}

TEST_F(Regress, JsonTellsThatTheBoundsAreDamaged) {
  approve("ball");
  ASSERT_EQ(regress({"--json", "j.json", "--junit", "junit.xml"}).exit_code, 0);
  workplace_.file("scenes/baselines/bounds.json", "[]");
  expect_trouble(regress({"--json", "j.json", "--junit", "junit.xml"}), {"bounds.json"});
  const Json told = Json::parse(read_file(workplace_.path("j.json")));
  EXPECT_TRUE(contains(told.at("error"), "bounds.json")) << told;
  EXPECT_EQ(told.at("tool"), "plumb");
  EXPECT_EQ(told.at("version"), PLUMB_VERSION);
  EXPECT_EQ(told.at("scenes"), Json::array()) << "those of the run before are gone";
}

TEST_F(Regress, OneFileThatCannotBeWrittenCostsNotTheOther) {
  approve("ball");
  std::filesystem::create_directory(workplace_.path("full"));
  ASSERT_EQ(regress({"--json", "j.json", "--junit", "junit.xml"}).exit_code, 0);
  workplace_.file("scenes/ball.sdf", moved_ball());
  expect_trouble(regress({"--json", "full", "--junit", "junit.xml"}), {"full"});
  EXPECT_TRUE(contains(read_file(workplace_.path("junit.xml")), "failures=\"1\""));
  expect_trouble(regress({"--json", "j.json", "--junit", "full"}), {"full"});
  EXPECT_EQ(Json::parse(read_file(workplace_.path("j.json"))).at("scenes").at(0).at("status"), "differ");
}

TEST_F(Regress, JunitTellsEachOutcomeOfHostileNames) {
  const std::string hostile = "a & <b> \"c\" 'd'";
  workplace_.file("scenes/" + hostile + ".sdf", std::string(ball_scene));
  workplace_.file("scenes/bad.sdf", "nonsense\n");
  approve("ball");
  EXPECT_EQ(regress({"--junit", "junit.xml"}).exit_code, 2);
  workplace_.file(
      "read.py",
      "import json, xml.etree.ElementTree as tree\n"
      "cases = tree.parse('junit.xml').getroot().iter('testcase')\n"
      "print(json.dumps([[c.get('name'), [[e.tag, e.get('message'), e.text] for e in c]] for c in "
      "cases]))\n");
  const auto result = run_shell("python3 read.py", workplace_.directory());
  ASSERT_EQ(result.exit_code, 0) << result.output;
  const Json cases = Json::parse(result.output);
  ASSERT_EQ(cases.size(), 3U);
  EXPECT_EQ(cases.at(0).at(0), hostile);
  EXPECT_EQ(cases.at(0).at(1).at(0).at(0), "failure");
  EXPECT_EQ(cases.at(0).at(1).at(0).at(1), "new: there is no baseline yet");
  EXPECT_TRUE(contains(cases.at(0).at(1).at(0).at(2), "approve with: "));
  EXPECT_EQ(cases.at(1).at(0), "bad");
  EXPECT_EQ(cases.at(1).at(1).at(0).at(0), "error");
  EXPECT_EQ(cases.at(2).at(0), "ball");
  EXPECT_TRUE(cases.at(2).at(1).empty());
}

TEST_F(Regress, JunitOnStandardOutputIsAlone) {
  const Outcome outcome = regress({"--junit", "-"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(outcome.out.starts_with("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites "))
      << outcome.out;
  EXPECT_TRUE(outcome.out.ends_with("</testsuites>\n")) << outcome.out;
}

}  // namespace
}  // namespace plumb::tests
