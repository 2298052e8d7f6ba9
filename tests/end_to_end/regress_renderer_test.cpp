// `plumb regress --renderer`: somebody else's renderer against pictures that were approved of it.
#include <cstring>
#include <nlohmann/json.hpp>

#include "references/submissions/sandbox/sandbox.hpp"
#include "tests/support/end_to_end.hpp"

namespace plumb::tests {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

std::string scene_of(const std::string& background, const std::string& image = "out.ppm") {
  return "background " + background + "\ndefine camera eye 40\nrender eye " + image + " 2 1\n";
}

/// Where nothing can be confined these tests say so and are skipped.
class OtherRenderer : public testing::Test {
 protected:
  void SetUp() override {
    try {
      submissions::require_sandbox();
    } catch (const std::runtime_error& error) {
      GTEST_SKIP() << error.what();
    }
    // Root's runs become another user, who may enter here.
    fs::permissions(workplace_.directory(), fs::perms(0755));
    fs::create_directories(workplace_.path("scenes/deeper"));
    fs::create_directories(workplace_.path("program"));
    workplace_.file("scenes/a.sdf", scene_of("10 20 30"));
    workplace_.file("scenes/deeper/b.sdf", scene_of("40 50 60"));
    renderer(
        "sed -n 's/^background //p' \"$1\" | (read c; printf 'P3\\n2 1\\n255\\n%s\\n%s\\n' \"$c\" \"$c\") "
        "> \"$2\"\n");
  }

  /// $1 is the scene, $2 the image.
  void renderer(const std::string& script) const {
    fs::permissions(workplace_.file("program/tracer", "#!/bin/sh\n" + script), fs::perms(0755));
  }
  Outcome regress(std::vector<std::string> more = {}) const {
    std::vector<std::string> all{"regress", "scenes", "--renderer", "program/tracer {scene} {image}"};
    const bool is_limited = std::find(more.begin(), more.end(), "--timeout") != more.end();
    if (!is_limited) all.insert(all.end(), {"--timeout", "100"});  // on a busy machine
    all.insert(all.end(), more.begin(), more.end());
    return run_plumb(all, workplace_.directory());
  }
  Outcome approve_all() const {
    const Outcome outcome = regress({"--update", "--all-new", "--because", "looked at"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
    return outcome;
  }
  Json scenes(std::vector<std::string> more = {}) const {
    more.insert(more.end(), {"--json", "-"});
    const Outcome outcome = regress(more);
    EXPECT_TRUE(Json::accept(outcome.out)) << outcome.out << outcome.err;
    return Json::parse(outcome.out).at("scenes");
  }

  Workplace workplace_;
};

TEST_F(OtherRenderer, IsGatedByItsOwnPictures) {
  EXPECT_EQ(regress().exit_code, 1) << "nothing is approved yet";
  EXPECT_TRUE(contains(approve_all().out, "approved deeper/b 2x1"));
  const Outcome same = regress();
  EXPECT_EQ(same.exit_code, 0) << same.out << same.err;
  EXPECT_TRUE(contains(same.out, "2 agree")) << same.out;
  const Json record = Json::parse(read_file(workplace_.path("scenes/baselines/baselines.json"))).at(1);
  EXPECT_EQ(record.at("image"), "deeper/b.exr");
  EXPECT_EQ(record.at("renderer"), "program/tracer {scene} {image}");
}

/// One step of 8 bits is seen, and the values are those of the file: nothing is tone-mapped or linearised.
TEST_F(OtherRenderer, OneStepDiffersUnlessItIsAllowed) {
  approve_all();
  workplace_.file("scenes/a.sdf", scene_of("10 21 30"));
  const Json scene = scenes().at(0);
  EXPECT_EQ(scene.at("status"), "differ");
  EXPECT_EQ(scene.at("pixels_over"), 2);
  EXPECT_NEAR(scene.at("max_error").get<double>(), 1.0 / 255, 1e-7);
  EXPECT_EQ(regress({"--tolerance", "0.004"}).exit_code, 0);
  EXPECT_EQ(regress({"--allow-over", "2"}).exit_code, 0);
  EXPECT_EQ(regress({"--allow-over", "1"}).exit_code, 1);
}

TEST_F(OtherRenderer, ItsTroubleWithOneSceneLeavesTheOthersAlone) {
  approve_all();
  workplace_.file("program/good", read_file(workplace_.path("program/tracer")));
  struct Case {
    const char* script;
    const char* said;
  };
  for (const Case& c : {Case{"kill -SEGV $$", "signal 11"},
                        Case{"echo 'no licence' >&2; exit 3", "no licence"}, Case{"sleep 600", "timed-out"},
                        Case{"echo P3 > \"$2\"", "a.ppm"}, Case{"ln -s /etc/passwd \"$2\"", "a link"}}) {
    renderer("case \"$1\" in */a.sdf) " + std::string(c.script) +
             " ;; *) sed 1d \"$(dirname \"$0\")/good\" > /tmp/judged/good; . /tmp/judged/good ;; esac\n");
    const bool hangs = std::string(c.said) == "timed-out";
    const Outcome outcome = regress({"--timeout", hangs ? "10" : "100"});
    EXPECT_EQ(outcome.exit_code, 2) << c.script << outcome.out;
    EXPECT_TRUE(contains(outcome.out, "1 agree, 0 differ, 1 in trouble")) << c.script << outcome.out;
    EXPECT_TRUE(contains(outcome.out, c.said) || contains(outcome.out, "out.ppm")) << c.script << outcome.out;
  }
}

TEST_F(OtherRenderer, FloatsAreTakenByTheNameOfTheRenderLineAndNaNNeverAgrees) {
  const float values[6] = {0.25F, 4, -1, 0.125F, 1e-3F, 2};
  std::string bytes = "PF\n2 1\n-1.0\n" + std::string(reinterpret_cast<const char*>(values), sizeof values);
  workplace_.file("program/picture", bytes);
  workplace_.file("scenes/a.sdf", scene_of("0 0 0", "out.pfm"));
  fs::remove_all(workplace_.path("scenes/deeper"));
  renderer("cp \"$(dirname \"$0\")/picture\" \"$2\"\n");
  approve_all();
  EXPECT_EQ(regress().exit_code, 0) << regress().out;
  const float none = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(bytes.data() + bytes.size() - sizeof none, &none, sizeof none);
  workplace_.file("program/picture", bytes);
  const Json scene = scenes({"--allow-over", "100%", "--tolerance", "1e9"}).at(0);
  EXPECT_EQ(scene.at("status"), "differ");
  EXPECT_EQ(scene.at("non_finite"), 1);
  EXPECT_EQ(scene.at("approve"), "");
  const auto before = listing(workplace_.directory());
  expect_trouble(regress({"--update", "a", "--because", "x"}), {"not finite"});
  EXPECT_EQ(listing(workplace_.directory()), before);
}

TEST_F(OtherRenderer, ItsPicturesAreNotComparedWithPlumbsOwn) {
  approve_all();
  const Outcome outcome = run_plumb({"regress", "scenes"}, workplace_.directory());
  EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "compare with --renderer")) << outcome.out;
}

TEST_F(OtherRenderer, TheShownCommandApproves) {
  const Json found = scenes({"--variant", "gcc", "--timeout", "90"});
  for (const Json& scene : found) {
    const std::string command = scene.at("approve");
    const auto result = run_shell(command, workplace_.directory());
    EXPECT_EQ(result.exit_code, 0) << command << "\n" << result.output;
  }
  EXPECT_EQ(regress({"--variant", "gcc"}).exit_code, 0);
  EXPECT_EQ(regress().exit_code, 1) << "the plain ones are not there";
}

TEST_F(OtherRenderer, ItsCommandIsChecked) {
  for (const auto& [command, said] :
       {std::pair{"nothing-of-that-name {scene} {image}", "nothing-of-that-name"},
        {"program/tracer {image}", "{scene}"},
        {"program/tracer {scene}", "{image}"},
        {"program/tracer 'open {scene} {image}", "'"}})
    expect_trouble(run_plumb({"regress", "scenes", "--renderer", command}, workplace_.directory()), {said});
  expect_trouble(regress({"--real", "float"}), {"--real", "--renderer"});
}

}  // namespace
}  // namespace plumb::tests
