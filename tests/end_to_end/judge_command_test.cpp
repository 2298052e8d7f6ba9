// `plumb judge`: small tracers, right, wrong and hostile, each with its verdict, and nothing outside touched.
#include <nlohmann/json.hpp>

#include "references/submissions/sandbox/sandbox.hpp"
#include "tests/support/end_to_end.hpp"

namespace plumb::tests {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class JudgeCommand : public testing::Test {
 protected:
  JudgeCommand() {
    fs::create_directories(workplace_.path("scenes")), workplace_.file("scenes/s.sdf", scene());
  }

  static std::string scene() { return std::string(ball_scene); }
  Outcome judge(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"judge", "--scenes", "scenes"});
    return run_plumb(arguments, workplace_.directory());
  }
  /// A submission, a program of /bin/sh or Python; $1 is the scene, $2 the image.
  void hand_in(const std::string& name, const std::string& text) const {
    fs::create_directories(workplace_.path("class"));
    fs::permissions(workplace_.file("class/" + name, text), fs::perms(0755));
  }
  void shell(const std::string& name, const std::string& text) const { hand_in(name, "#!/bin/sh\n" + text); }
  /// A tracer that renders right: plumb under another name, for runs do not see plumb itself.
  std::string tracer() const {
    const std::string path = workplace_.path("tracer/tracer");
    fs::create_directories(workplace_.path("tracer"));
    fs::copy_file(PLUMB_BINARY, path, fs::copy_options::skip_existing);
    return path;
  }
  /// The pictures of the class by submission.
  std::map<std::string, Json> judge_class(const std::string& seconds) const {
    tracer();
    const Outcome outcome = judge({"--renderer", "{submission} {scene} {image}", "--submissions", "class",
                                   "--readable", "tracer", "--timeout", seconds, "--json", "-"});
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    std::map<std::string, Json> pictures;
    const Json all = Json::parse(outcome.out, nullptr, false);
    EXPECT_TRUE(all.is_object()) << outcome.out << outcome.err;
    for (const Json& picture : all.value("pictures", Json::array()))
      pictures[picture["submission"].get<std::string>()] = picture;
    return pictures;
  }

  Workplace workplace_;
};

/// Where nothing can be confined the tests of runs say so and are skipped; those of pictures are not.
class JudgeRuns : public JudgeCommand {
 protected:
  void SetUp() override {
    try {
      submissions::require_sandbox();
    } catch (const std::runtime_error& error) {
      GTEST_SKIP() << error.what();
    }
  }
};

TEST_F(JudgeRuns, SaysWhichLimitsTheKernelDoesNotKeep) {
  const std::string weaker = submissions::limits_not_enforced();
  const Outcome outcome =
      judge({"--renderer", tracer() + " render {scene} -o {image}", "--json", "-", "--report", "report"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  const Json json = Json::parse(outcome.out, nullptr, false);
  EXPECT_EQ(json.value("limits_not_enforced", ""), weaker);
  EXPECT_EQ(json.contains("limits_not_enforced"), !weaker.empty());
  EXPECT_TRUE(contains(outcome.err, weaker)) << outcome.err;
  const std::string page = read_file(workplace_.path("report/index.html"));
  EXPECT_EQ(contains(page, "<p>Limits: the kernel"), !weaker.empty());
}

TEST_F(JudgeCommand, OfPicturesAloneNoLimitIsMissing) {
  fs::create_directories(workplace_.path("pictures"));
  run_plumb({"render", "scenes/s.sdf", "-o", "pictures/s.ppm"}, workplace_.directory());
  const Outcome outcome = judge({"--images", "pictures", "--json", "-"});
  EXPECT_FALSE(Json::parse(outcome.out, nullptr, false).contains("limits_not_enforced")) << outcome.out;
}

TEST_F(JudgeRuns, NamesWhatATracerDoes) {
  const std::string render = tracer() + " render \"$1\" ";
  shell("good", render + "-o \"$2\"\n");
  shell("fault", render + "--fault ka-kd-swapped -o \"$2\"\n");
  shell("by-the-render-line", render + "-o out.ppm\n");
  shell("size", render + "--size 8x8 -o \"$2\"\n");
  shell("truncated", render + "-o t.ppm; head -c 100 t.ppm > \"$2\"\n");
  shell("nothing", "exit 0\n");
  shell("failing", "exit 3\n");
  shell("crash", "kill -SEGV $$\n");
  hand_in("lost", "#!/no/such/interpreter\n");
  const auto pictures = judge_class("30");
  ASSERT_EQ(pictures.size(), 9U);
  const std::map<std::string, std::string> expected{
      {"good", "right"},      {"fault", "faults"},         {"by-the-render-line", "right"},
      {"size", "wrong-size"}, {"truncated", "unreadable"}, {"nothing", "no-image"},
      {"failing", "crashed"}, {"crash", "crashed"},        {"lost", "crashed"}};
  for (const auto& [name, verdict] : expected)
    EXPECT_EQ(pictures.at(name)["verdict"], verdict) << name << pictures.at(name);
  EXPECT_EQ(pictures.at("fault")["faults"][0]["id"], "ka-kd-swapped");
  EXPECT_TRUE(contains(pictures.at("lost")["message"], "No such file or directory")) << pictures.at("lost");
}

TEST_F(JudgeRuns, TimeEndsWhatDoesNotEnd) {
  shell("hang", "trap '' TERM INT HUP; while :; do sleep 1; done\n");
  const auto pictures = judge_class("2");
  ASSERT_EQ(pictures.size(), 1U);
  EXPECT_EQ(pictures.at("hang")["verdict"], "timed-out");
}

TEST_F(JudgeRuns, LimitsEndWhatTakesTooMuch) {
  shell("image", "head -c 1000000000 /dev/zero > \"$2\"\n");
  shell("stdout", "head -c 1000000000 /dev/zero\n");
  shell("many-files", "i=0; while :; do i=$((i+1)); echo x > f$i; done\n");
  // More than the 64 that are allowed, fewer than the 256 at which the kernel would end it before the
  // watcher; they last longer than the run may.
  shell("bomb", "i=0; while [ $i -lt 150 ]; do i=$((i+1)); sleep 100 & done; wait\n");
  const auto pictures = judge_class("30");
  ASSERT_EQ(pictures.size(), 4U);
  EXPECT_EQ(pictures.at("image")["verdict"], "too-much-output");
  EXPECT_EQ(pictures.at("stdout")["verdict"], "too-much-output");
  EXPECT_EQ(pictures.at("many-files")["verdict"], "too-much-output");
  EXPECT_EQ(pictures.at("bomb")["verdict"], "too-many-processes");
}

TEST_F(JudgeRuns, TouchesAndSeesNothingOutside) {
  tracer();
  workplace_.file("secret", "the secret");
  const std::string here = workplace_.directory();
  shell("a-neighbour", "# the neighbour's secret\n");
  shell("reader",
        "cat '" + here + "/secret' '" + here + "/class/a-neighbour' && echo READ; ls -A /home /root; env\n");
  shell("writer", "for d in / /etc /root /home /usr; do touch $d/owned && echo WROTE $d; done\n");
  shell("link", "ln -s '" + here + "/secret' \"$2\"\n");
  shell("pipe", "mkfifo \"$2\"\n");
  shell("network", "cat /proc/net/dev; echo x > /dev/tcp/1.1.1.1/53 && echo CONNECTED\n");
  shell("daemon", "setsid sleep 987654 > /dev/null 2>&1 &\nexit 0\n");
  const auto before = listing(here);
  const auto pictures = judge_class("30");
  EXPECT_EQ(listing(here), before);
  for (const auto& [name, picture] : pictures) {
    const std::string printed = picture.value("printed", "");
    EXPECT_NE(picture["verdict"], "right") << name;
    for (const char* const bad : {"READ", "secret\n", "WROTE", "CONNECTED", "eth0", "PLUMB_CACHE"})
      EXPECT_FALSE(contains(printed, bad)) << name << ": " << printed;
  }
  EXPECT_TRUE(contains(pictures.at("network")["printed"], "lo:"));
  EXPECT_TRUE(contains(pictures.at("link")["message"], "a link"));
  EXPECT_TRUE(contains(pictures.at("pipe")["message"], "a pipe"));
  EXPECT_TRUE(contains(run_shell("pgrep -f 'sleep 98765[4]' || echo none", here).output, "none"));
}

/// The teacher's script beside the class: what is shown holds what is hidden, which holds what is shown.
TEST_F(JudgeRuns, AProgramBesideItsClass) {
  tracer();
  shell("ada", "exec \"$3\" render \"$1\" -o \"$2\"\n");
  fs::create_symlink("class", workplace_.path("link"));
  fs::permissions(workplace_.file("run.sh",
                                  "#!/bin/sh\ncat \"$(dirname \"$0\")\"/class/ada > /dev/null || exit 1\n"
                                  "exec \"$1\" \"$2\" \"$3\" \"$(dirname \"$0\")/tracer/tracer\"\n"),
                  fs::perms(0755));
  for (const char* const of_class : {"class", "class/", "./class//.", "link", "scenes/../class"}) {
    const Outcome outcome =
        judge({"--renderer", "./run.sh {submission} {scene} {image}", "--submissions", of_class, "--timeout",
               "60", "--readable", "tracer", "--readable", "tracer/"});
    EXPECT_EQ(outcome.exit_code, 0) << of_class << ": " << outcome.out << outcome.err;
  }
}

TEST_F(JudgeRuns, AFailingSandboxIsNoVerdict) {
  shell("ada", "exit 0\n");
  fs::permissions(workplace_.file("run.sh", "#!/bin/sh\n"), fs::perms(0644));
  expect_trouble(judge({"--renderer", "./run.sh {submission} {scene}", "--submissions", "class"}),
                 {"run.sh", "execute"});
  expect_trouble(
      judge({"--renderer", "{submission} {scene}", "--submissions", "class", "--readable", "/tmp"}),
      {"/tmp", "move"});
}

TEST_F(JudgeRuns, AWordOfTheCommandDoesNotShowAllThatThereIs) {
  const Outcome outcome =
      judge({"--renderer", "/bin/sh -c 'test ! -e /home || exit 3' / /tmp /tmp/ {scene}"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "no-image")) << outcome.out;
}

TEST_F(JudgeRuns, OneTracerWithoutAShell) {
  const Outcome outcome = judge({"--renderer", "'" PLUMB_BINARY "' render {scene} -o {image}", "--report",
                                 "report", "--csv", "c.csv", "--junit", "u.xml"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_TRUE(contains(read_file(workplace_.path("c.csv")), ",right,"));
  EXPECT_TRUE(contains(read_file(workplace_.path("u.xml")), "failures=\"0\""));
  EXPECT_TRUE(contains(read_file(workplace_.path("report/submission-1.html")), "data:image/png;base64,"));
}

TEST_F(JudgeCommand, PicturesOfAClass) {
  for (const char* const name : {"ada", "ben", "cy"}) fs::create_directories(workplace_.path("in/") + name);
  const auto render = [&](const std::string& to, const std::string& fault) {
    std::vector<std::string> arguments{"render", "scenes/s.sdf", "-o", "in/" + to};
    if (!fault.empty()) arguments.insert(arguments.end(), {"--fault", fault});
    ASSERT_EQ(run_plumb(arguments, workplace_.directory()).exit_code, 0);
  };
  render("ada/s.ppm", "");
  render("ben/s.png", "ka-kd-swapped");
  const Outcome outcome = judge({"--images", "in", "--hint", "2", "--json", "-"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  const Json pictures = Json::parse(outcome.out)["pictures"];
  ASSERT_EQ(pictures.size(), 3U);
  EXPECT_EQ(pictures[0]["verdict"], "right");
  EXPECT_EQ(pictures[1]["verdict"], "faults");
  EXPECT_TRUE(pictures[1]["faults"][0].contains("title"));
  EXPECT_FALSE(pictures[1]["faults"][0].contains("id"));
  EXPECT_EQ(pictures[2]["verdict"], "no-image");
}

TEST_F(JudgeCommand, WhatIsNotJudgedOfAClassIsSaid) {
  for (const char* const name : {"ada", "ben"}) fs::create_directories(workplace_.path("in/") + name);
  for (const char* const to :
       {"in/ada/s.ppm", "in/ben/s.ppm", "in/ben/s.png", "in/ada/other.ppm", "in/s.ppm"})
    ASSERT_EQ(run_plumb({"render", "scenes/s.sdf", "-o", to}, workplace_.directory()).exit_code, 0);
  fs::create_directory_symlink("ada", workplace_.path("in/cy"));
  fs::create_symlink("loop", workplace_.path("in/loop"));
  const Outcome outcome = judge({"--images", "in", "--json", "-"});
  EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
  const Json json = Json::parse(outcome.out);
  EXPECT_EQ(json["of_no_scene"], Json({"ada/other.ppm", "s.ppm"}));
  EXPECT_TRUE(contains(outcome.err, "is a submission: ada/other.ppm, s.ppm"));
  ASSERT_EQ(json["pictures"].size(), 3U);
  EXPECT_EQ(json["pictures"][0]["verdict"], "right");
  EXPECT_EQ(json["pictures"][1]["verdict"], "trouble");
  EXPECT_TRUE(contains(std::string(json["pictures"][1]["message"]), "found s.ppm and s.png"));
  EXPECT_EQ(json["pictures"][2]["verdict"], "trouble");
  EXPECT_TRUE(contains(std::string(json["pictures"][2]["message"]), "found a link"));
}

TEST_F(JudgeCommand, FaultsThatCannotBeToldApartAreSaidInEveryOutput) {
  fs::create_directories(workplace_.path("pictures"));
  // The camera is moved and not turned: whatever loses its place gives that picture.
  workplace_.file("scenes/s.sdf", replaced(ball_scene, "camera eye 60 0 0 0", "camera eye 60 0.4 0 0"));
  ASSERT_EQ(run_plumb({"render", "scenes/s.sdf", "--fault", "camera-without-effect", "-o", "pictures/s.ppm"},
                      workplace_.directory())
                .exit_code,
            0);
  const Outcome told = judge({"--images", "pictures", "--json", "-", "--csv", "a.csv", "--junit", "a.xml"});
  const Json picture = Json::parse(told.out)["pictures"][0];
  ASSERT_GT(picture["ambiguous"].size(), 0U) << told.out;
  const std::string other = picture["ambiguous"][0][1];
  const std::string text = judge({"--images", "pictures"}).out;
  for (const std::string& output :
       {text, read_file(workplace_.path("a.csv")), read_file(workplace_.path("a.xml"))}) {
    EXPECT_TRUE(contains(output, other)) << output;
    EXPECT_TRUE(contains(output, "the same picture here)")) << output;
    EXPECT_TRUE(contains(output, "[confidence 0.")) << output;
  }
}

/// The second scene tells apart what the first does not; another submission has another mistake in each.
TEST_F(JudgeCommand, ThePicturesOfASubmissionAreOneCase) {
  workplace_.file("scenes/t.sdf", read_file(source_path("tests/scenes/phong-even-exponent.sdf")));
  const auto paint = [&](const std::string& name, const std::string& scene, const std::string& fault) {
    fs::create_directories(workplace_.path("pictures/" + name));
    std::vector<std::string> words{"render", "scenes/" + scene + ".sdf", "-o",
                                   "pictures/" + name + "/" + scene + ".ppm"};
    if (!fault.empty()) words.insert(words.end(), {"--fault", fault});
    ASSERT_EQ(run_plumb(words, workplace_.directory()).exit_code, 0);
  };
  paint("anna", "s", "specular-missing"), paint("anna", "t", "specular-missing");
  paint("bert", "s", "ka-kd-swapped"), paint("bert", "t", "");
  for (const char* journal : {"made", "kept"}) {
    const Outcome outcome = judge({"--images", "pictures", "--json", "-", "--report", "report"});
    const Json submissions = Json::parse(outcome.out, nullptr, false).value("submissions", Json::array());
    ASSERT_EQ(submissions.size(), 2U) << outcome.out << outcome.err;
    EXPECT_EQ(submissions[0]["submission"], "anna");
    ASSERT_EQ(submissions[0]["faults"].size(), 1U) << journal << submissions[0];
    EXPECT_EQ(submissions[0]["faults"][0]["id"], "specular-missing");
    EXPECT_EQ(submissions[0]["faults"][0]["alike"], Json::array());
    EXPECT_EQ(submissions[0]["faults"][0]["pictures"], Json({"s", "t"}));
    EXPECT_EQ(submissions[1]["faults"], Json::array()) << journal;
    EXPECT_EQ(submissions[1]["withdrawn"][0]["contradicted_by"], "t");
  }
}

TEST_F(JudgeCommand, TheReportLinksTheLessonOfEachFault) {
  fs::create_directories(workplace_.path("pictures"));
  ASSERT_EQ(run_plumb({"render", "scenes/s.sdf", "--fault", "ka-kd-swapped", "-o", "pictures/s.ppm"},
                      workplace_.directory())
                .exit_code,
            0);
  const Outcome told = judge({"--images", "pictures", "--report", "report", "--json", "-"});
  ASSERT_EQ(told.exit_code, 1) << told.err;
  EXPECT_TRUE(contains(read_file(workplace_.path("report/submission-1.html")),
                       "<a href=\"faults.html#ka-kd-swapped\">"));
  EXPECT_TRUE(contains(read_file(workplace_.path("report/faults.html")), "<section id=\"ka-kd-swapped\">"));
  const Json picture = Json::parse(told.out)["pictures"][0];
  EXPECT_EQ(picture["faults"][0]["id"], "ka-kd-swapped");
  EXPECT_EQ(
      picture["encoding"],
      Json::parse(
          R"({"tone_map":true,"gamma":1.0,"rounding":"truncate","levels":[256,256,256],"flipped":false})"));
  // A teacher who tells less leaves no formulas of an earlier run.
  const Outcome hinted = judge({"--images", "pictures", "--report", "report", "--hint", "2", "--json", "-"});
  ASSERT_EQ(hinted.exit_code, 1) << hinted.err;
  EXPECT_FALSE(fs::exists(workplace_.path("report/faults.html")));
  EXPECT_FALSE(contains(hinted.out, "ka-kd-swapped")) << hinted.out;
}

TEST_F(JudgeCommand, WithoutBubblewrapNothingRuns) {
  const std::string touch = "/bin/touch " + workplace_.path("ran") + " {scene}";
  const Outcome outcome = run_plumb({"judge", "--scenes", "scenes", "--renderer", touch},
                                    workplace_.directory(), {"PATH=" + workplace_.directory()});
  expect_trouble(outcome, {"bwrap", "apt-get install bubblewrap"});
  EXPECT_FALSE(fs::exists(workplace_.path("ran")));
}

TEST_F(JudgeCommand, NothingThatIsRunAndNoPageOfOthersIsReplaced) {
  const std::string script = "#!/bin/sh\nexit 1\n";
  for (const char* const directory : {"class", "mine"}) fs::create_directories(workplace_.path(directory));
  workplace_.file("class/ada", script);
  workplace_.file("tracer", script);
  workplace_.file("mine/index.html", "my own page");
  fs::permissions(workplace_.path("class/ada"), fs::perms::owner_all);
  fs::permissions(workplace_.path("tracer"), fs::perms::owner_all);
  expect_trouble(judge({"--renderer", "./tracer {scene}", "--csv", "tracer"}), {"--csv", "an input"});
  expect_trouble(
      judge({"--renderer", "{submission} {scene}", "--submissions", "class", "--json", "class/ada"}),
      {"--json", "an input"});
  expect_trouble(judge({"--renderer", "./tracer {scene}", "--report", "mine"}),
                 {"index.html", "not replaced"});
  expect_trouble(judge({"--renderer", "./tracer {scene}", "--json", "r.json", "--resume", "./r.json"}),
                 {"names, too"});
  expect_trouble(judge({"--renderer", "./tracer {scene}", "--report", "new", "--csv", "new/index.html"}),
                 {"--csv", "--report"});
  EXPECT_EQ(read_file(workplace_.path("class/ada")), script);
  EXPECT_EQ(read_file(workplace_.path("tracer")), script);
  EXPECT_EQ(read_file(workplace_.path("mine/index.html")), "my own page");
  for (const char* const directory : {"half", "room/ada"}) fs::create_directories(workplace_.path(directory));
  workplace_.file("half/submission-1.html", "my own page");
  const Outcome half = judge({"--images", "room", "--report", "half"});
  expect_trouble(half, {"submission-1.html", "not replaced"});
  EXPECT_FALSE(contains(half.out, "report:")) << half.out;
}

TEST_F(JudgeCommand, ARightPictureStaysRightHoweverMuchIsPrinted) {
  fs::create_directories(workplace_.path("room"));
  ASSERT_EQ(run_plumb({"render", "scenes/s.sdf", "-o", "room/good.ppm"}, workplace_.directory()).exit_code,
            0);
  workplace_.file("room/chatty", "#!/bin/sh\nhead -c 3000000 /dev/zero\ncp \"${0%/*}/good.ppm\" \"$2\"\n");
  fs::permissions(workplace_.path("room/chatty"), static_cast<fs::perms>(0755));
  const Outcome outcome = judge({"--renderer", "room/chatty {scene} {image}"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
}

TEST_F(JudgeCommand, CommandsThatCannotBeRunAreTrouble) {
  expect_trouble(judge({}), {"--renderer", "--images"});
  expect_trouble(judge({"--renderer", "no-such-tracer {scene}"}), {"no-such-tracer"});
  expect_trouble(judge({"--renderer", "/bin/true"}), {"{scene}"});
  expect_trouble(judge({"--renderer", "/bin/true {scene} {submission}"}), {"--submissions"});
  expect_trouble(judge({"--renderer", "/bin/true 'x"}), {"quote"});
  expect_trouble(judge({"--images", "none"}), {"none"});
  for (const char* const seed : {"-1", "18446744073709551616", "1x", ""})
    expect_trouble(judge({"--renderer", "/bin/true {scene}", "--shuffle", seed}), {"--shuffle"});
}

}  // namespace
}  // namespace plumb::tests
