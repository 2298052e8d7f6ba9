// `plumb regress`: scenes in directories below, variants, what an update changes, bounds beside the images.
#include <nlohmann/json.hpp>

#include "references/renderers/baselines.hpp"
#include "tests/support/end_to_end.hpp"

namespace plumb::tests {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class Gate : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* const name : {"ball", "sub/one", "sub/deep/two"}) add(name);
  }

  void add(const std::string& name, const std::string& scene = std::string(ball_scene)) const {
    fs::create_directories(fs::path(workplace_.path("scenes/" + name)).parent_path());
    workplace_.file("scenes/" + name + ".sdf", scene);
  }
  void move_ball_of(const std::string& name) const { add(name, replaced(ball_scene, "0 0 -3", "0 0.1 -3")); }
  Outcome regress(std::vector<std::string> more = {},
                  const std::vector<std::string>& environment = {}) const {
    more.insert(more.begin(), {"regress", "scenes"});
    return run_plumb(more, workplace_.directory(), environment);
  }
  Outcome update(std::vector<std::string> more, const std::vector<std::string>& environment = {}) const {
    more.insert(more.end(), {"--because", "looked at"});
    const Outcome outcome = regress(more, environment);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
    return outcome;
  }
  Outcome approve_all() const { return update({"--update", "--all-new"}); }
  Json scene(const std::string& path, std::vector<std::string> more = {}) const {
    more.insert(more.end(), {"--json", "-"});
    const Json all = Json::parse(regress(more).out);
    for (const Json& each : all.at("scenes"))
      if (each.at("scene") == path) return each;
    ADD_FAILURE() << "no scene " << path;
    return {};
  }
  /// The bytes and the time of change of every file below the baselines.
  std::map<std::string, std::string> baselines() const {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(workplace_.path("scenes/baselines")))
      if (entry.is_regular_file()) all[entry.path()] = read_file(entry.path());
    return all;
  }

  Workplace workplace_;
};

// --- an update ------------------------------------------------------------------------------------

TEST_F(Gate, AnUpdateOfWhatIsUnchangedChangesNoByte) {
  update({"--update", "--all-new"}, {"GIT_AUTHOR_NAME=Ada"});
  const auto before = baselines();
  ASSERT_EQ(before.size(), 4U);
  const Outcome again =
      update({"--update", "ball", "sub/one", "sub/deep/two", "--threads", "1"}, {"GIT_AUTHOR_NAME=Grace"});
  EXPECT_EQ(baselines(), before);
  EXPECT_TRUE(contains(again.out, "unchanged ball 32x24, as Ada approved it, 20")) << again.out;
}

/// The same picture of the same scene is the same file, whenever it is made.
TEST_F(Gate, ImagesAreReproducible) {
  approve_all();
  const auto before = baselines();
  fs::remove_all(workplace_.path("scenes/baselines"));
  run_shell("sleep 1.1", workplace_.directory());
  approve_all();
  for (const auto& [path, bytes] : baselines()) {
    EXPECT_TRUE(bytes == before.at(path) || !path.ends_with(".exr")) << path;
  }
}

TEST_F(Gate, ImagesOfRenderAreReproducible) {
  for (const std::string extension : {"exr", "png", "ppm", "pfm"}) {
    for (const std::vector<std::string>& encode :
         {std::vector<std::string>{}, std::vector<std::string>{"--encode", "linear"}}) {
      std::string bytes[2];
      for (int i = 0; i < 2; ++i) {
        std::vector<std::string> all{"render", "scenes/ball.sdf", "--threads", std::to_string(1 + i),
                                     "-o",     "x." + extension};
        all.insert(all.end(), encode.begin(), encode.end());
        ASSERT_EQ(run_plumb(all, workplace_.directory()).exit_code, 0);
        bytes[i] = read_file(workplace_.path("x." + extension));
        if (i == 0) run_shell("sleep 1.1", workplace_.directory());
      }
      EXPECT_TRUE(bytes[0] == bytes[1]) << extension;
    }
  }
}

TEST_F(Gate, AnUpdateOfAChangedSceneRecordsWhoApprovedIt) {
  update({"--update", "--all-new"}, {"GIT_AUTHOR_NAME=Ada"});
  move_ball_of("sub/one");
  update({"--update", "sub/one"}, {"GIT_AUTHOR_NAME=Grace", "GIT_AUTHOR_EMAIL=grace@example.org"});
  const Json records = Json::parse(read_file(workplace_.path("scenes/baselines/baselines.json")));
  ASSERT_EQ(records.size(), 3U);
  EXPECT_EQ(records.at(0).at("who"), "Ada");
  EXPECT_EQ(records.at(2).at("scene"), "sub/one.sdf");
  EXPECT_EQ(records.at(2).at("who"), "Grace <grace@example.org>");
  EXPECT_EQ(regress().exit_code, 0);
}

TEST_F(Gate, GitsUserApproves) {
  ASSERT_EQ(run_shell("git init -q scenes && git -C scenes config user.name 'Ada Lovelace' && git -C scenes "
                      "config user.email ada@example.org",
                      workplace_.directory())
                .exit_code,
            0);
  update({"--update", "ball"}, {"GIT_AUTHOR_NAME=", "GIT_AUTHOR_EMAIL="});
  const Json records = Json::parse(read_file(workplace_.path("scenes/baselines/baselines.json")));
  EXPECT_EQ(records.at(0).at("who"), "Ada Lovelace <ada@example.org>");
}

TEST_F(Gate, AllNewApprovesWhatHasNoBaselineAndNothingElse) {
  update({"--update", "ball"});
  move_ball_of("ball");
  const Outcome outcome = approve_all();
  EXPECT_EQ(outcome.out, "approved sub/deep/two 32x24\napproved sub/one 32x24\n");
  EXPECT_EQ(scene("scenes/ball.sdf").at("status"), "differ");
  EXPECT_TRUE(contains(approve_all().out, "nothing is new"));
  expect_trouble(regress({"--update", "--all-new"}), {"--because"});
  expect_trouble(regress({"--all-new"}), {"--all-new", "--update"});
}

// --- directories ----------------------------------------------------------------------------------

TEST_F(Gate, ScenesInDirectoriesBelowAreCompared) {
  approve_all();
  EXPECT_TRUE(fs::exists(workplace_.path("scenes/baselines/sub/deep/two.exr")));
  EXPECT_EQ(regress().exit_code, 0) << regress().out;
  move_ball_of("sub/deep/two");
  EXPECT_EQ(regress().exit_code, 1);
  EXPECT_EQ(scene("scenes/sub/deep/two.sdf").at("status"), "differ");
  for (const char* const name :
       {"sub/deep/two", "scenes/sub/deep/two.sdf", "./scenes/sub/../sub/deep/two.sdf"})
    EXPECT_TRUE(contains(update({"--update", name}).out, "sub/deep/two 32x24")) << name;
  EXPECT_EQ(regress().exit_code, 0);
}

TEST_F(Gate, ASceneThatIsGoneBelowIsForgottenWithItsDirectory) {
  approve_all();
  fs::remove_all(workplace_.path("scenes/sub/deep"));
  EXPECT_EQ(regress().exit_code, 2);
  EXPECT_TRUE(contains(update({"--update", "sub/deep/two"}).out, "forgotten sub/deep/two"));
  EXPECT_EQ(regress().exit_code, 0);
  EXPECT_FALSE(fs::exists(workplace_.path("scenes/baselines/sub/deep")));
  EXPECT_TRUE(fs::exists(workplace_.path("scenes/baselines/sub/one.exr")));
}

TEST_F(Gate, LinksInCirclesEndAndHiddenDirectoriesAreNoScenes) {
  fs::create_directory_symlink("..", workplace_.path("scenes/sub/up"));
  fs::create_directory_symlink("sub", workplace_.path("scenes/again"));
  fs::create_directory_symlink("self", workplace_.path("scenes/self"));
  fs::create_directories(workplace_.path("elsewhere"));
  workplace_.file("elsewhere/far.sdf", std::string(ball_scene));
  fs::create_directory_symlink("../elsewhere", workplace_.path("scenes/link"));
  add(".hidden/bad", "nonsense\n");
  EXPECT_EQ(approve_all().out,
            "approved ball 32x24\napproved link/far 32x24\napproved sub/deep/two 32x24\n"
            "approved sub/one 32x24\n");
  EXPECT_EQ(regress().exit_code, 0);
}

TEST_F(Gate, NoRecordLeadsOutOfTheDirectory) {
  approve_all();
  const std::string path = "scenes/baselines/baselines.json";
  const std::string records = read_file(workplace_.path(path));
  for (const char* const name : {"../ball", "sub/../../ball", "/tmp/ball", "./ball", ""}) {
    Json broken = Json::parse(records);
    broken.at(0)["scene"] = std::string(name) + ".sdf";
    broken.at(0)["image"] = std::string(name) + ".exr";
    workplace_.file(path, broken.dump());
    expect_trouble(regress(), {"is damaged"});
  }
}

// --- variants -------------------------------------------------------------------------------------

TEST_F(Gate, AVariantHasBaselinesOfItsOwnAndElseThePlainOnes) {
  approve_all();
  move_ball_of("sub/one");
  EXPECT_EQ(regress({"--variant", "arm"}).exit_code, 1) << "the plain one counts";
  update({"--variant", "arm", "--update", "sub/one"});
  EXPECT_TRUE(fs::exists(workplace_.path("scenes/baselines/arm/sub/one.exr")));
  EXPECT_EQ(regress({"--variant", "arm"}).exit_code, 0) << regress({"--variant", "arm"}).out;
  EXPECT_EQ(regress().exit_code, 1);
  add("sub/one");
  EXPECT_EQ(regress().exit_code, 0) << "images of variants are nobody's orphans";
  EXPECT_EQ(regress({"--variant", "arm"}).exit_code, 1);
}

TEST_F(Gate, AVariantThatLooksTheSameNeedsNoImage) {
  approve_all();
  EXPECT_TRUE(contains(update({"--variant", "arm", "--update", "ball"}).out, "unchanged ball"));
  EXPECT_FALSE(fs::exists(workplace_.path("scenes/baselines/arm")));
}

TEST_F(Gate, AVariantHasANameThatIsNoDirectorys) {
  approve_all();
  for (const char* const name : {"../x", "a/b", ".x", "a b"})
    expect_trouble(regress({"--variant", name}), {"--variant", name});
  expect_trouble(regress({"--variant", "sub"}), {"'sub'", "another name"});
  update({"--variant", "arm", "--update", "ball", "--size", "8x8"});
  add("arm/x");
  expect_trouble(regress(), {"'arm'", "another name"});
}

// --- signals ---

TEST_F(Gate, ASignalWaitsUntilImagesAndRecordsAreOfOneUpdate) {
  constexpr std::size_t many = 500;
  for (std::size_t i = 0; i < many; ++i) add("s" + std::to_string(i));
  const auto told = run_shell(
      "\"$0\" regress scenes --update scenes/s*.sdf --because x --size 4x4 & "
      "until [ -e scenes/baselines/s0.exr ]; do :; done; kill -TERM $!; wait $!; echo code $?",
      workplace_.directory());
  EXPECT_TRUE(contains(told.output, "code 143")) << told.output;
  const renderers::Baselines baselines(workplace_.path("scenes/baselines"));
  EXPECT_EQ(baselines.all().size(), many);
  EXPECT_EQ(baselines.names().size(), many);
}

// --- bounds ---------------------------------------------------------------------------------------

class BoundedGate : public Gate {
 protected:
  void SetUp() override {
    Gate::SetUp();
    approve_all();
    move_ball_of("ball");
    over_ = scene("scenes/ball.sdf").at("pixels_over");
    ASSERT_GT(over_, 2U);
  }
  std::size_t over_ = 0;
};

TEST_F(BoundedGate, SoManyPixelsMayBeOver) {
  EXPECT_EQ(regress({"--allow-over", std::to_string(over_)}).exit_code, 0);
  EXPECT_EQ(regress({"--allow-over", "0.1%"}).exit_code, 1);
  const Outcome all = regress({"--allow-over", "100%"});
  EXPECT_EQ(all.exit_code, 0);
  const std::string said = "without them it differs";
  ASSERT_TRUE(contains(all.out, said)) << all.out;
  EXPECT_EQ(all.out.find(said), all.out.rfind(said)) << "the other scenes are as they were\n" << all.out;
}

TEST_F(BoundedGate, WhatIsIgnoredDoesNotCountAndIsSaid) {
  const Json ignored = scene("scenes/ball.sdf", {"--ignore", "0,0,32,24"});
  EXPECT_TRUE(ignored.is_null() || ignored.at("status") == "error") << "no pixel would be left";
  const Json left = scene("scenes/ball.sdf", {"--ignore", "0,0,31,24"});
  EXPECT_EQ(left.at("status"), "agree") << left;
  EXPECT_EQ(left.at("bounds").at("pixels_ignored"), 31 * 24);
  EXPECT_EQ(scene("scenes/ball.sdf", {"--only", "0,0,2,2"}).at("status"), "agree");
  EXPECT_EQ(scene("scenes/ball.sdf", {"--only", "8,0,16,24"}).at("status"), "differ");
  const std::string table = regress({"--ignore", "0,0,31,24"}).out;
  EXPECT_TRUE(contains(table, "bounds: ") && contains(table, "0,0,31,24")) << table;
}

TEST_F(BoundedGate, BoundsOfOneSceneLieBesideTheBaselinesWithTheirReason) {
  workplace_.file("scenes/baselines/bounds.json",
                  R"({"ball": {"allow_over": "100%", "because": "the ball rolls"}})");
  const Outcome table = regress({"--junit", "junit.xml", "--report", "report"});
  EXPECT_EQ(table.exit_code, 0) << table.out;
  for (const std::string& text :
       {table.out, read_file(workplace_.path("junit.xml")), read_file(workplace_.path("report/index.html")),
        scene("scenes/ball.sdf").dump()})
    EXPECT_TRUE(contains(text, "the ball rolls")) << text.substr(0, 2000);
  move_ball_of("sub/one");
  EXPECT_EQ(regress().exit_code, 1) << "they are of one scene alone";
}

TEST_F(BoundedGate, BoundsWithoutAReasonOrOfNoSceneAreTrouble) {
  workplace_.file("scenes/baselines/bounds.json", R"({"ball": {"allow_over": "100%"}})");
  expect_trouble(regress(), {"bounds.json", "because"});
  workplace_.file("scenes/baselines/bounds.json", R"({"bal": {"allow_over": 1, "because": "x"}})");
  expect_trouble(regress(), {"bounds.json", "'bal'"});
}

}  // namespace
}  // namespace plumb::tests
