// `plumb verify`: its table, its JSON, its exit codes, its cache, and what it does without POV-Ray.
#include <sys/stat.h>

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "tests/support/end_to_end.hpp"

namespace plumb::tests {
namespace {

using Json = nlohmann::json;

std::set<std::string> keys_of(const Json& json) {
  std::set<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.insert(key);
  return keys;
}

std::size_t lines_in(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

class Verify : public testing::Test {
 protected:
  void SetUp() override {
    povray_ = system::find_program("povray");
    if (povray_.empty()) GTEST_SKIP() << "POV-RAY IS NOT INSTALLED: verify is not tested";
    workplace_.file("ball.sdf", std::string(ball_scene));
  }

  Outcome verify(const std::vector<std::string>& arguments,
                 const std::vector<std::string>& environment = {}) const {
    std::vector<std::string> all{"verify"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return run_plumb(all, workplace_.directory(), environment);
  }
  Json verify_json(std::vector<std::string> arguments,
                   const std::vector<std::string>& environment = {}) const {
    arguments.insert(arguments.end(), {"--json", "-"});
    const Outcome outcome = verify(arguments, environment);
    EXPECT_TRUE(Json::accept(outcome.out)) << outcome.out << outcome.err;
    return Json::parse(outcome.out, nullptr, false);
  }

  /// A `povray` that is a shell script, first on PATH; in it, "$POVRAY" is the real one.
  std::string path_with_povray(const std::string& script) const {
    std::filesystem::create_directories(workplace_.path("bin"));
    const std::string fake =
        workplace_.file("bin/povray", "#!/bin/sh\nPOVRAY='" + povray_ + "'\n" + script + "\n");
    chmod(fake.c_str(), 0755);
    return "PATH=" + workplace_.path("bin") + ":/usr/bin:/bin";
  }
  /// Writes a line to `log` whenever it is started.
  std::string path_with_log() const {
    return path_with_povray("echo \"$@\" >> '" + workplace_.path("log") + "'\nexec \"$POVRAY\" \"$@\"");
  }
  std::size_t starts_of_povray() const {
    const std::string log = workplace_.path("log");
    return std::filesystem::exists(log) ? lines_in(read_file(log)) : 0;
  }

  std::vector<std::string> cached_pictures() const {
    std::vector<std::string> paths;
    for (const auto& entry : std::filesystem::directory_iterator(workplace_.path(".cache"))) {
      if (entry.path().extension() == ".picture") paths.push_back(entry.path().string());
    }
    return paths;
  }

  Workplace workplace_;
  std::string povray_;
};

// --- table and JSON -------------------------------------------------------------------------------

TEST_F(Verify, PrintsATableWithALineForEachScene) {
  workplace_.file("second.sdf", replaced(ball_scene, "32 24", "16 12"));
  const Outcome outcome = verify({"ball.sdf", "second.sdf"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_EQ(outcome.err, "");
  std::istringstream lines(outcome.out);
  std::vector<std::string> table;
  for (std::string line; std::getline(lines, line);) table.push_back(line);
  ASSERT_EQ(table.size(), 4U) << outcome.out;
  for (const char* const title : {"scene", "size", "error", "over", "result"})
    EXPECT_TRUE(contains(table[0], title));
  for (const char* const part : {"ball.sdf", "32x24", " agree"})
    EXPECT_TRUE(contains(table[1], part)) << table[1];
  for (const char* const part : {"second.sdf", "16x12", " agree"})
    EXPECT_TRUE(contains(table[2], part)) << table[2];
  EXPECT_TRUE(contains(table[3], "2 scenes against POV-Ray 3.")) << table[3];
  EXPECT_TRUE(contains(table[3], "2 agree, 0 differ, 0 in trouble")) << table[3];
}

TEST_F(Verify, JsonOnStandardOutputIsAlone) {
  const Outcome outcome = verify({"ball.sdf", "--json", "-"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  ASSERT_TRUE(Json::accept(outcome.out)) << outcome.out;
}

TEST_F(Verify, JsonInAFileIsBesideTheTable) {
  workplace_.file("result.json", std::string(100'000, 'x'));
  const Outcome outcome = verify({"ball.sdf", "--json", "result.json"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_TRUE(contains(outcome.out, "1 agree"));
  EXPECT_EQ(Json::parse(read_file(workplace_.path("result.json"))).at("scenes").size(), 1U);
  EXPECT_EQ(listing(workplace_.directory()), (std::vector<std::string>{"ball.sdf", "result.json"}));
}

TEST_F(Verify, JsonHasTheDocumentedKeysAndTypes) {
  const Json json = verify_json({"ball.sdf"});
  EXPECT_EQ(json.at("tool"), "plumb");
  EXPECT_EQ(json.at("version"), PLUMB_VERSION);
  EXPECT_EQ(json.at("reference").at("renderer"), "povray");
  EXPECT_TRUE(json.at("reference").at("version").get<std::string>().starts_with("3."));
  ASSERT_EQ(json.at("scenes").size(), 1U);
  const Json& scene = json.at("scenes").at(0);
  EXPECT_EQ(scene.at("scene"), "ball.sdf");
  EXPECT_EQ(scene.at("status"), "agree");
  EXPECT_EQ(scene.at("message"), "");
  EXPECT_EQ(scene.at("width"), 32);
  EXPECT_EQ(scene.at("height"), 24);
  for (const char* const error : {"max_error", "judged_error", "mean_error", "rms_error"}) {
    EXPECT_TRUE(scene.at(error).is_number_float()) << error;
    EXPECT_GE(scene.at(error).get<double>(), 0);
    EXPECT_LE(scene.at(error).get<double>(), 1e-6);
  }
  EXPECT_LE(scene.at("mean_error").get<double>(), scene.at("rms_error").get<double>());
  EXPECT_LE(scene.at("rms_error").get<double>(), scene.at("max_error").get<double>());
  EXPECT_EQ(scene.at("pixels_over"), 0);
  EXPECT_EQ(scene.at("non_finite"), 0);
  const Json& worst = scene.at("worst");
  EXPECT_TRUE(worst.at("x").is_number_integer());
  EXPECT_TRUE(worst.at("y").is_number_integer());
  EXPECT_EQ(worst.at("ours").size(), 3U);
  EXPECT_EQ(worst.at("reference").size(), 3U);
  EXPECT_GT(scene.at("seconds").at("ours").get<double>(), 0);
  EXPECT_GT(scene.at("seconds").at("reference").get<double>(), 0);
  EXPECT_EQ(scene.at("cached"), false);
}

/// What issue 2 documents, no more and no less: acceptance reads it.
TEST_F(Verify, JsonHasTheDocumentedKeysAndNoOthers) {
  const Json json = verify_json({"ball.sdf"});
  EXPECT_EQ(keys_of(json), (std::set<std::string>{"tool", "version", "reference", "notice", "scenes"}));
  EXPECT_EQ(keys_of(json.at("reference")), (std::set<std::string>{"renderer", "version"}));
  const Json& scene = json.at("scenes").at(0);
  EXPECT_EQ(keys_of(scene), (std::set<std::string>{
                                "scene", "status", "message", "width", "height", "max_error", "judged_error",
                                "mean_error", "rms_error", "pixels_over", "unexamined", "unverified",
                                "non_finite", "worst", "seconds", "cached", "metrics", "budget", "shapes"}));
  EXPECT_EQ(keys_of(scene.at("worst")), (std::set<std::string>{"x", "y", "ours", "reference"}));
  EXPECT_EQ(keys_of(scene.at("seconds")), (std::set<std::string>{"ours", "reference"}));
}

TEST_F(Verify, JsonThatCannotBeWrittenIsTrouble) {
  expect_trouble(verify({"ball.sdf", "--json", "nowhere/result.json"}),
                 {"nowhere/result.json", "cannot be written"});
}

TEST_F(Verify, SizeIsTakenInsteadOfTheScenes) {
  const Json scene = verify_json({"ball.sdf", "--size", "20x10"}).at("scenes").at(0);
  EXPECT_EQ(scene.at("width"), 20);
  EXPECT_EQ(scene.at("height"), 10);
  EXPECT_EQ(scene.at("status"), "agree");
}

TEST_F(Verify, TheSceneIsReadInADialect) {
  workplace_.file("loose.sdf", replaced(ball_scene, "ambient", "define ambient"));
  EXPECT_EQ(verify({"loose.sdf"}).exit_code, 2);
  const Outcome outcome = verify({"loose.sdf", "--dialect", "loose"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
}

TEST_F(Verify, OneJobGivesTheSameFiguresAsMany) {
  workplace_.file("second.sdf", replaced(ball_scene, "-3 1 red", "-4 1 red"));
  workplace_.file("third.sdf", replaced(ball_scene, "-3 1 red", "-5 1 red"));
  const std::vector<std::string> scenes{"ball.sdf", "second.sdf", "third.sdf"};
  const auto with_jobs = [&](const char* jobs) {
    std::vector<std::string> arguments = scenes;
    arguments.insert(arguments.end(), {"--jobs", jobs});
    Json json = verify_json(arguments);
    for (Json& scene : json.at("scenes")) {
      scene.erase("seconds");
      scene.erase("cached");
    }
    return json;
  };
  EXPECT_EQ(with_jobs("1"), with_jobs("8"));
}

// --- exit codes -----------------------------------------------------------------------------------

TEST_F(Verify, ToleranceZeroDiffersWithExitCode1) {
  const Outcome outcome = verify({"ball.sdf", "--tolerance", "0"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, " differ")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "0 agree, 1 differ, 0 in trouble")) << outcome.out;
}

/// The figure is that of float against double, which no other difference gets into.
TEST_F(Verify, FloatIsNamedWhereItDiffers) {
  const std::string by_float = "rendered with --real float: float32 alone differs from double by up to ";
  const Outcome differs = verify({"ball.sdf", "--real", "float", "--tolerance", "1e-7"});
  EXPECT_EQ(differs.exit_code, 1) << differs.out;
  EXPECT_TRUE(contains(differs.out, by_float)) << differs.out;
  EXPECT_TRUE(contains(differs.out, "; try --real double")) << differs.out;
  const std::string figure = differs.out.substr(differs.out.find(by_float) + by_float.size());
  EXPECT_GT(std::stod(figure), 1e-7) << differs.out;
  EXPECT_LT(std::stod(figure), 1e-5) << differs.out;
  const Outcome agrees = verify({"ball.sdf", "--real", "float", "--tolerance", "0.1"});
  EXPECT_EQ(agrees.exit_code, 0) << agrees.out;
  EXPECT_FALSE(contains(agrees.out, "--real")) << agrees.out;
  const Outcome of_double = verify({"ball.sdf", "--tolerance", "0"});
  EXPECT_EQ(of_double.exit_code, 1) << of_double.out;
  EXPECT_FALSE(contains(of_double.out, "--real")) << of_double.out;
}

/// Rounding is no tie: a lone sphere coincides with nothing, however small the tolerance.
TEST_F(Verify, ALoneSphereHasNoTies) {
  for (const char* const tolerance : {"0", "1e-9", "1e-8"}) {
    const Outcome outcome = verify({"ball.sdf", "--tolerance", tolerance});
    EXPECT_FALSE(contains(outcome.out, "explained")) << tolerance << "\n" << outcome.out;
  }
}

TEST_F(Verify, ABadSceneNeverStopsTheOthers) {
  workplace_.file("bad.sdf", replaced(ball_scene, "-3 1 red", "-3 0 red"));
  workplace_.file("last.sdf", replaced(ball_scene, "-3 1 red", "-4 1 red"));
  const Outcome outcome = verify({"bad.sdf", "ball.sdf", "missing.sdf", "last.sdf"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(contains(outcome.out, "2 agree, 0 differ, 2 in trouble")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "bad.sdf:2:21: error: ")) << outcome.out;

  const Json scenes = verify_json({"bad.sdf", "ball.sdf", "missing.sdf", "last.sdf"}).at("scenes");
  ASSERT_EQ(scenes.size(), 4U);
  const std::vector<std::pair<std::string, std::string>> expected{
      {"bad.sdf", "error"}, {"ball.sdf", "agree"}, {"missing.sdf", "error"}, {"last.sdf", "agree"}};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(scenes[i].at("scene"), expected[i].first);
    EXPECT_EQ(scenes[i].at("status"), expected[i].second);
  }
  EXPECT_TRUE(contains(scenes[0].at("message"), "bad.sdf:2:21: error: found radius"));
  EXPECT_TRUE(contains(scenes[2].at("message"), "missing.sdf: cannot be read"));
}

TEST_F(Verify, TroubleOutweighsADifference) {
  EXPECT_EQ(verify({"ball.sdf", "missing.sdf", "--tolerance", "0"}).exit_code, 2);
}

TEST_F(Verify, AnUnknownCameraIsTroubleOfTheScene) {
  const Outcome outcome = verify({"ball.sdf", "--camera", "nobody"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(contains(outcome.out, "no camera 'nobody'")) << outcome.out;
}

TEST_F(Verify, ARendererThatDisagreesIsFoundOut) {
  const std::string path = path_with_povray(
      "[ -f in.pov ] && sed -i 's/^background.*/background { rgb <0.1,0.15,2.5> }/' in.pov\n"
      "exec \"$POVRAY\" \"$@\"");
  const Json scene = verify_json({"ball.sdf"}, {path}).at("scenes").at(0);
  EXPECT_EQ(scene.at("status"), "differ");
  EXPECT_NEAR(scene.at("max_error").get<double>(), 0.5, 1e-6);
  EXPECT_GT(scene.at("pixels_over").get<int>(), 300);
  EXPECT_NEAR(scene.at("worst").at("ours").at(2).get<double>(), 3, 1e-6);
  EXPECT_NEAR(scene.at("worst").at("reference").at(2).get<double>(), 2.5, 1e-6);
}

// --- the renderer fails ---------------------------------------------------------------------------

constexpr const char* version_is_real = "[ \"$1\" = --version ] && exec \"$POVRAY\" \"$@\"\n";

TEST_F(Verify, AParseErrorIsShownWithItsLineOfSdl) {
  const std::string path = path_with_povray(
      std::string(version_is_real) + "echo \"File 'in.pov' line 2: Parse Error: nonsense\" >&2\nexit 1");
  const Outcome outcome = verify({"ball.sdf"}, {path});
  EXPECT_EQ(outcome.exit_code, 2);
  for (const char* const part : {"Parse Error: nonsense", "#version 3.7", "1 in trouble"}) {
    EXPECT_TRUE(contains(outcome.out, part)) << outcome.out;
  }
  EXPECT_TRUE(cached_pictures().empty());
}

TEST_F(Verify, ARendererThatDiesIsTrouble) {
  const Outcome outcome =
      verify({"ball.sdf"}, {path_with_povray(std::string(version_is_real) + "kill -SEGV $$")});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(contains(outcome.out, "signal 11")) << outcome.out;
}

TEST_F(Verify, ARendererThatWritesNothingIsTrouble) {
  const Outcome outcome = verify({"ball.sdf"}, {path_with_povray(std::string(version_is_real) + "exit 0")});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(contains(outcome.out, "1 in trouble")) << outcome.out;
  EXPECT_TRUE(cached_pictures().empty());
}

TEST_F(Verify, AWarningOfTheRendererIsShown) {
  const std::string path = path_with_povray(
      "\"$POVRAY\" \"$@\"\ncode=$?\n[ \"$1\" = --version ] || echo 'Warning: it is late' >&2\nexit $code");
  const Outcome outcome = verify({"ball.sdf"}, {path});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "it is late")) << outcome.out;
}

// --- the cache ------------------------------------------------------------------------------------

TEST_F(Verify, AWarmCacheStartsNoPovRay) {
  const std::string path = path_with_log();
  const Json cold = verify_json({"ball.sdf"}, {path}).at("scenes").at(0);
  EXPECT_EQ(cold.at("status"), "agree");
  EXPECT_EQ(cold.at("cached"), false);
  const std::size_t starts = starts_of_povray();
  EXPECT_EQ(starts, 2U) << "its version and the picture:\n" << read_file(workplace_.path("log"));

  const Json warm = verify_json({"ball.sdf"}, {path}).at("scenes").at(0);
  EXPECT_EQ(starts_of_povray(), starts);
  EXPECT_EQ(warm.at("cached"), true);
  EXPECT_EQ(warm.at("status"), "agree");
  EXPECT_EQ(warm.at("max_error"), cold.at("max_error"));
  const Outcome table = verify({"ball.sdf"}, {path});
  EXPECT_TRUE(contains(table.out, "agree (cached)")) << table.out;
  EXPECT_EQ(starts_of_povray(), starts);
}

TEST_F(Verify, WhatChangesThePictureMissesTheCache) {
  const std::string path = path_with_log();
  verify({"ball.sdf"}, {path});
  std::size_t starts = starts_of_povray();
  workplace_.file("moved.sdf", replaced(ball_scene, "0 0 -3", "0 0.1 -3"));
  for (const std::vector<std::string>& other :
       {std::vector<std::string>{"moved.sdf"}, std::vector<std::string>{"ball.sdf", "--size", "24x32"},
        std::vector<std::string>{"ball.sdf", "--depth", "3"}}) {
    EXPECT_EQ(verify_json(other, {path}).at("scenes").at(0).at("cached"), false) << other.back();
    EXPECT_EQ(starts_of_povray(), ++starts);
  }
}

/// The file's name and layout do not: the key is what POV-Ray would get.
TEST_F(Verify, TheSameSceneInAnotherFileIsCached) {
  verify({"ball.sdf"});
  workplace_.file("copy.sdf", "# a copy\n\n" + std::string(ball_scene));
  EXPECT_EQ(verify_json({"copy.sdf"}).at("scenes").at(0).at("cached"), true);
}

class DamagedCache : public Verify, public testing::WithParamInterface<Word> {};
INSTANTIATE_TEST_SUITE_P(By, DamagedCache,
                         testing::Values(Word{"AFlippedByte"}, Word{"AFlippedHash"}, Word{"Truncation"},
                                         Word{"Emptiness"}, Word{"AnotherFile"}),
                         [](const auto& test) { return std::string(test.param.text); });

TEST_P(DamagedCache, IsNoticedAndRenderedAgain) {
  const std::string path = path_with_log();
  verify({"ball.sdf"}, {path});
  const std::size_t starts = starts_of_povray();
  ASSERT_EQ(cached_pictures().size(), 1U);
  const std::string entry = cached_pictures().front();
  const std::string good = read_file(entry);
  std::string bad = good;
  const std::string how = GetParam().text;
  if (how == "AFlippedByte") bad[bad.size() / 2] = static_cast<char>(bad[bad.size() / 2] ^ 1);
  if (how == "AFlippedHash") bad[20] = bad[20] == 'a' ? 'b' : 'a';
  if (how == "Truncation") bad.resize(bad.size() - 1);
  if (how == "Emptiness") bad.clear();
  if (how == "AnotherFile") bad = "P3\n1 1\n255\n0 0 0\n";
  workplace_.file(entry.substr(workplace_.directory().size() + 1), bad);

  const Json again = verify_json({"ball.sdf"}, {path}).at("scenes").at(0);
  EXPECT_EQ(again.at("status"), "agree") << again.at("message");
  EXPECT_EQ(again.at("cached"), false);
  EXPECT_EQ(starts_of_povray(), starts + 1);
  EXPECT_EQ(verify_json({"ball.sdf"}, {path}).at("scenes").at(0).at("cached"), true);
  EXPECT_EQ(starts_of_povray(), starts + 1);
}

TEST_F(Verify, ACacheThatCannotBeWrittenIsNoTrouble) {
  workplace_.file("second.sdf", replaced(ball_scene, "-3 1 red", "-4 1 red"));
  const std::vector<std::string> scenes{"ball.sdf", "second.sdf"};
  const Outcome outcome = verify(scenes, {"PLUMB_CACHE=/proc/nowhere"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "2 agree")) << outcome.out;
  EXPECT_TRUE(outcome.err.starts_with("warning: /proc/nowhere: cannot be written: ")) << outcome.err;
  for (const char* const part : {"renders them again", "PLUMB_CACHE"})
    EXPECT_TRUE(contains(outcome.err, part)) << outcome.err;
  EXPECT_EQ(lines_in(outcome.err), 1U) << "once, whatever the number of scenes: " << outcome.err;
}

TEST_F(Verify, ACacheUnderAFileIsToldBesideTheJson) {
  workplace_.file("plain", "");
  const Outcome outcome =
      verify({"ball.sdf", "--json", "-"}, {"PLUMB_CACHE=" + workplace_.path("plain") + "/cache"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(Json::accept(outcome.out)) << outcome.out;
  EXPECT_TRUE(contains(outcome.err, "plain/cache: cannot be written: Not a directory")) << outcome.err;
}

// --- stored images --------------------------------------------------------------------------------

class StoredImages : public Verify {
 protected:
  std::string references() const { return "PLUMB_REFERENCES=" + workplace_.path("references"); }
  std::string path_without_povray() const { return "PATH=" + workplace_.path("nowhere"); }
  void store() const {
    const Outcome outcome =
        run_plumb({"references", "--update", "ball.sdf"}, workplace_.directory(), {references()});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  }
};

TEST_F(StoredImages, ASceneWithoutOneIsTrouble) {
  const Outcome outcome = verify({"ball.sdf", "--stored"}, {references()});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(contains(outcome.out, "no stored reference image")) << outcome.out;
  EXPECT_TRUE(contains(outcome.err, "NO POV-RAY IS RUN")) << outcome.err;
}

TEST_F(StoredImages, AreComparedWithoutPovRay) {
  store();
  std::filesystem::remove_all(workplace_.path(".cache"));
  const std::string path = path_with_log();
  const Outcome outcome = verify({"ball.sdf", "--stored"}, {references(), path});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "1 agree")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, " agree (stored)\n")) << outcome.out;
  EXPECT_TRUE(contains(outcome.err, "NO POV-RAY IS RUN")) << outcome.err;
  EXPECT_EQ(starts_of_povray(), 0U);
  const Json scene = verify_json({"ball.sdf", "--stored"}, {references(), path}).at("scenes").at(0);
  EXPECT_EQ(scene.at("cached"), true) << "was not rendered now";
}

TEST_F(StoredImages, AreTheFallBackWithoutPovRaySaidLoudly) {
  store();
  const Outcome outcome = verify({"ball.sdf"}, {references(), path_without_povray()});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "NO POV-RAY IS RUN")) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "povray is not on PATH")) << outcome.err;
}

TEST_F(StoredImages, WithoutPovRayAndImageIsTrouble) {
  const Outcome outcome = verify({"ball.sdf"}, {references(), path_without_povray()});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(contains(outcome.out, "no stored reference image")) << outcome.out;
  EXPECT_TRUE(contains(outcome.err, "povray is not on PATH")) << outcome.err;
}

TEST_F(Verify, TheReportIsOnePageWithEveryScene) {
  workplace_.file("broken.sdf", "define shape sphere a 0 0 0 1 nothing\n");
  const Outcome outcome = verify({"ball.sdf", "broken.sdf", "--size", "16x12", "--report", "out/report"});
  EXPECT_EQ(outcome.exit_code, 2) << "one scene is in trouble";
  const std::string page = read_file(workplace_.path("out/report/index.html"));
  for (const char* const part : {"ball.sdf", "broken.sdf", "plumb explain --size 16x12", "agree"})
    EXPECT_TRUE(contains(page, part)) << part;
  EXPECT_TRUE(contains(outcome.out, "\nreport: out/report/index.html\n")) << outcome.out;
  EXPECT_TRUE(Json::accept(verify({"ball.sdf", "--report", "out", "--json", "-"}).out)) << "JSON is alone";
  EXPECT_EQ(verify({"ball.sdf", "--report", "ball.sdf"}).exit_code, 2) << "no directory can be made there";
}

TEST_F(Verify, TermsStandInTheJson) {
  const Json json = verify_json({"ball.sdf", "--terms"});
  const Json& terms = json.at("scenes").at(0).at("terms");
  EXPECT_EQ(keys_of(terms),
            (std::set<std::string>{"ambient", "diffuse", "specular", "shadow", "mirror", "refraction"}));
  for (const auto& [term, figures] : terms.items()) {
    EXPECT_LE(figures.at("max_error"), 1e-6) << term;
    EXPECT_EQ(figures.at("in_scene"), term != "mirror" && term != "refraction") << term;
    EXPECT_EQ(figures.at("unexplained"), 0) << term;
  }
  EXPECT_FALSE(verify_json({"ball.sdf"}).at("scenes").at(0).contains("terms")) << "when not asked for";
}

TEST_F(Verify, TheBudgetInTheJsonHasEveryCause) {
  const Json json = verify_json({"ball.sdf"});
  EXPECT_EQ(keys_of(json.at("scenes").at(0).at("budget")),
            (std::set<std::string>{"silhouette", "shadow_edge", "secondary_edge", "coincident",
                                   "reference_tolerance", "depth", "quantisation", "clamped", "undecided",
                                   "unexplained"}));
}

TEST_F(Verify, ASignalLeavesNothingBehind) {
  const std::string fake = path_with_povray("case $1 in --version) exec \"$POVRAY\" \"$@\";; esac\ntouch '" +
                                            workplace_.path("started") + "'; sleep 60");
  const std::string wait =
      "for i in $(seq 500); do [ -e started ] && break; sleep 0.02; done; kill -TERM $!; wait $!; echo code "
      "$?";
  const auto result =
      run_shell(fake + " TMPDIR=\"$PWD\" \"$0\" verify ball.sdf & " + wait, workplace_.directory());
  EXPECT_TRUE(contains(result.output, "code 143")) << "ended by SIGTERM: " << result.output;
  EXPECT_EQ(listing(workplace_.directory()),
            (std::vector<std::string>{"ball.sdf", "bin", "bin/povray", "started"}));
}

TEST_F(StoredImages, AreOfOneSize) {
  store();
  const Outcome outcome = verify({"ball.sdf", "--stored", "--size", "16x12"}, {references()});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(contains(outcome.out, "16 x 12")) << outcome.out;
}

TEST_F(StoredImages, ADamagedOneIsTrouble) {
  store();
  ASSERT_EQ(run_plumb({"render", "ball.sdf", "-o", "references/ball.exr", "--depth", "1", "--camera", "eye",
                       "--real", "float"},
                      workplace_.directory())
                .exit_code,
            0);
  const Outcome outcome = verify({"ball.sdf", "--stored"}, {references()});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(contains(outcome.out, "ball.exr")) << outcome.out;
}

TEST_F(StoredImages, DamagedProvenanceIsTrouble) {
  store();
  workplace_.file("references/provenance.json", "[{");
  expect_trouble(verify({"ball.sdf", "--stored"}, {references()}), {"provenance.json", "damaged"});
}

}  // namespace
}  // namespace plumb::tests
