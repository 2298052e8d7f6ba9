// `plumb judge` of a class in which something goes wrong: the others keep their results, and a run that is
// interrupted goes on.
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "references/submissions/sandbox/sandbox.hpp"
#include "tests/support/end_to_end.hpp"

namespace plumb::tests {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class JudgeClass : public testing::Test {
 protected:
  JudgeClass() {
    fs::create_directories(workplace_.path("scenes"));
    workplace_.file("scenes/s.sdf", replaced(std::string(ball_scene), "32 24", "16 12"));
    render("right.ppm", {});
  }

  void render(const std::string& to, std::vector<std::string> more) const {
    more.insert(more.begin(), {"render", "scenes/s.sdf", "-o", to});
    ASSERT_EQ(run_plumb(more, workplace_.directory()).exit_code, 0);
  }
  std::string right() const { return read_file(workplace_.path("right.ppm")); }
  void hand_in(const std::string& name, const std::string& picture, const std::string& file = "s.ppm") const {
    fs::create_directories(workplace_.path("in/" + name));
    workplace_.file("in/" + name + "/" + file, picture);
  }
  /// "$0" is the program; $JUDGE begins a command that judges.
  system::ProcessResult shell(const std::string& command) const {
    return run_shell("JUDGE=\"$0 judge --scenes scenes --jobs 1\"; " + command, workplace_.directory());
  }
  Json json(const std::string& file = "j.json") const {
    return Json::parse(read_file(workplace_.path(file)), nullptr, false);
  }
  std::map<std::string, std::string> verdicts(const std::string& file = "j.json") const {
    std::map<std::string, std::string> all;
    const Json told = json(file);
    for (const Json& picture : told.at("pictures")) all[picture["submission"]] = picture["verdict"];
    return all;
  }
  bool exists(const std::string& name) const { return fs::exists(workplace_.path(name)); }

  Workplace workplace_;
};

using Verdicts = std::map<std::string, std::string>;

TEST_F(JudgeClass, ADiskThatIsFullForOneIsItsTrouble) {
  hand_in("ada", right());
  hand_in("ben", right() + std::string(200'000, 'x'));  // more than may be written, and so copied
  hand_in("cy", right());
  const auto told = shell("ulimit -f 100; $JUDGE --images in --json j.json --junit u.xml");
  EXPECT_EQ(told.exit_code, 2) << told.output;
  EXPECT_EQ(verdicts(), (Verdicts{{"ada", "right"}, {"ben", "trouble"}, {"cy", "right"}}));
  EXPECT_TRUE(contains(json()["pictures"][1]["message"], "cannot be written")) << json();
  EXPECT_TRUE(contains(read_file(workplace_.path("u.xml")), "errors=\"1\""));
  // When there is room again the same command judges what is left, and the others are not judged again.
  EXPECT_TRUE(exists("j.json.judged.jsonl"));
  const auto again = shell("$JUDGE --images in --json j.json");
  EXPECT_TRUE(contains(again.output, "2 results")) << again.output;
  EXPECT_NE(verdicts()["ben"], "trouble");
  EXPECT_FALSE(exists("j.json.judged.jsonl"));
}

TEST_F(JudgeClass, AProgramThatItsOwnerAloneMayExecuteIsTroubleOfRoot) {
  fs::permissions(workplace_.directory(), fs::perms(0755));
  for (const auto& [name, mode] :
       std::map<std::string, unsigned>{{"ada", 0755}, {"ben", 0700}, {"cy", 0644}}) {
    hand_in(name, "#!/bin/sh\ncat '" + workplace_.path("right.ppm") + "' >\"$2\"\n", "run.sh");
    fs::permissions(workplace_.path("in/" + name + "/run.sh"), fs::perms(mode));
  }
  fs::permissions(workplace_.path("right.ppm"), fs::perms(0644));
  const auto told =
      shell("$JUDGE --renderer '{submission}/run.sh {scene} {image}' --submissions in --readable '" +
            workplace_.path("right.ppm") + "' --json j.json");
  const bool is_root = geteuid() == 0;
  EXPECT_EQ(verdicts(),
            (Verdicts{{"ada", "right"}, {"ben", is_root ? "trouble" : "right"}, {"cy", "crashed"}}))
      << told.output;
  EXPECT_EQ(contains(json()["pictures"][1]["message"], "chmod -R go+rX"), is_root) << json();
}

TEST_F(JudgeClass, AReportThatCannotBeWrittenCostsNoOtherOutput) {
  hand_in("ada", right());
  fs::create_directories(workplace_.path("report/index.html"));  // where the page should be
  const auto told = shell("$JUDGE --images in --report report --json j.json --csv c.csv --junit u.xml");
  EXPECT_EQ(told.exit_code, 2);
  EXPECT_TRUE(contains(told.output, "report")) << told.output;
  EXPECT_EQ(verdicts(), (Verdicts{{"ada", "right"}}));
  EXPECT_TRUE(contains(read_file(workplace_.path("c.csv")), ",right,"));
  EXPECT_TRUE(contains(read_file(workplace_.path("u.xml")), "tests=\"1\""));
}

TEST_F(JudgeClass, NamesMayHoldAnyBytes) {
  hand_in("ad\xe9", right());
  hand_in("b\nen", right());
  const auto told = shell("$JUDGE --images in --report report --json j.json --csv c.csv --junit u.xml");
  EXPECT_EQ(told.exit_code, 0) << told.output;
  EXPECT_EQ(verdicts(), (Verdicts{{"ad\\xe9", "right"}, {"b\nen", "right"}}));
  for (const char* const file : {"c.csv", "u.xml", "report/index.html", "report/submission-1.html"})
    EXPECT_FALSE(contains(read_file(workplace_.path(file)), "\xe9")) << file;
  fs::rename(workplace_.path("scenes/s.sdf"), workplace_.path("scenes/s\xe9.sdf"));
  hand_in("ad\xe9", right(), "s\xe9.ppm");
  shell("$JUDGE --images in --json j.json");
  EXPECT_EQ(verdicts(), (Verdicts{{"ad\\xe9", "right"}, {"b\nen", "no-image"}}));
}

TEST_F(JudgeClass, WhatIsNoPictureOfAnyKindIsUnreadable) {
  for (const char* const name :
       {"s.ppm", "s.pfm", "s.png", "s.exr", "s.tif", "s.tiff", "s.jpg", "s.jpeg", "s.bmp", "s.tga", "s.hdr"})
    hand_in(std::string("by") + fs::path(name).extension().string(), "no picture", name);
  const auto told = shell("$JUDGE --images in --json j.json");
  EXPECT_EQ(told.exit_code, 1) << told.output;
  ASSERT_EQ(verdicts().size(), 11U);
  for (const auto& [name, verdict] : verdicts()) EXPECT_EQ(verdict, "unreadable") << name;
}

/// Where nothing can be confined these say so and are skipped.
class JudgeClassRuns : public JudgeClass {
 protected:
  void SetUp() override {
    try {
      submissions::require_sandbox();
    } catch (const std::runtime_error& error) {
      GTEST_SKIP() << error.what();
    }
    fs::create_directories(workplace_.path("class"));
  }
  /// A shell script; $1 is the scene, $2 the image.
  void submit(const std::string& name, const std::string& text) const {
    fs::permissions(workplace_.file(place_ + "class/" + name, "#!/bin/sh\n" + text), fs::perms(0755));
  }
  /// One that takes this long to hand in the right picture, which it holds in octal.
  void submit_slow(const std::string& name, const std::string& seconds) const {
    std::string octal;
    for (const char c : right()) {
      char digits[8];
      std::snprintf(digits, sizeof digits, "\\%03o", static_cast<unsigned char>(c));
      octal += digits;
    }
    submit(name, "sleep " + seconds + "\nprintf '" + octal + "' > \"$2\"\n");
  }
  std::string place_;  ///< of the class
  static constexpr const char* run_class =
      "$JUDGE --renderer '{submission} {scene} {image}' --submissions class --timeout 100 ";
};

TEST_F(JudgeClassRuns, KilledItGoesOnWhereItWas) {
  for (const char* const name : {"a", "b", "c", "d"}) submit_slow(name, "1");
  shell(std::string(run_class) + "--report report --json j.json & judge=$!\n" +
        "until [ $(cat report/judged.jsonl 2>/dev/null | grep -c key) -ge 2 ]; do sleep 0.1; done\n" +
        "kill -9 $judge; wait $judge");
  EXPECT_FALSE(exists("j.json"));
  std::vector<Json> kept;
  std::istringstream lines(read_file(workplace_.path("report/judged.jsonl")));
  for (std::string line; std::getline(lines, line);) kept.push_back(Json::parse(line, nullptr, false));
  ASSERT_GE(kept.size(), 3U);
  submit("d", "exit 3\n");  // changed: judged anew, whatever it was
  const auto told = shell(std::string(run_class) + "--report report --json j.json");
  EXPECT_EQ(told.exit_code, 1) << told.output;
  EXPECT_TRUE(contains(told.output, "going on with report/judged.jsonl")) << told.output;
  EXPECT_EQ(verdicts(), (Verdicts{{"a", "right"}, {"b", "right"}, {"c", "right"}, {"d", "crashed"}}));
  EXPECT_EQ(json()["pictures"][0]["wall_seconds"], kept[1]["picture"]["wall_seconds"]) << "it ran again";
  EXPECT_TRUE(contains(read_file(workplace_.path("report/submission-1.html")), "data:image/png;base64,"));
  EXPECT_FALSE(exists("report/judged.jsonl"));
}

TEST_F(JudgeClassRuns, InterruptedItWritesWhatIsDone) {
  submit_slow("a", "0");
  submit("b", "sleep 100\n");
  submit_slow("c", "0");
  const auto told = shell(std::string(run_class) + "--json j.json --csv c.csv --junit u.xml & judge=$!\n" +
                          "until grep -q key j.json.judged.jsonl 2>/dev/null; do sleep 0.1; done\n" +
                          "kill -TERM $judge; wait $judge");
  EXPECT_EQ(told.exit_code, 2) << told.output;
  EXPECT_EQ(verdicts(), (Verdicts{{"a", "right"}, {"b", "not-judged"}, {"c", "not-judged"}}));
  EXPECT_EQ(json()["complete"], false);
  EXPECT_TRUE(contains(told.output, "2 of 3 pictures were not judged")) << told.output;
  EXPECT_TRUE(contains(read_file(workplace_.path("u.xml")), "errors=\"2\""));
  submit_slow("b", "0");
  const auto rest = shell(std::string(run_class) + "--json j.json");
  EXPECT_EQ(rest.exit_code, 0) << rest.output;
  EXPECT_EQ(json()["complete"], true);
}

/// Schedulers share cores among sessions before they share them among processes.
TEST_F(JudgeClassRuns, ANeighbourThatTakesAllCoresTakesNoTime) {
  const std::string hog =
      "exec python3 -c '\nimport os\nfor i in range(20 * os.cpu_count()):\n if os.fork() == 0:\n"
      "  os.setsid()\n  while True: pass\nwhile True: pass'\n";
  submit("a-hog", hog);
  submit("c-hog", hog);
  submit_slow("b-right", "0");
  const std::string compute = "python3 -c '\nimport time\nwhile time.process_time() < 1.5: pass'\n";
  const std::string script = read_file(workplace_.path("class/b-right"));
  workplace_.file("class/b-right", replaced(script, "sleep 0\n", compute));
  const auto told = shell(
      "$0 judge --scenes scenes --jobs 2 --renderer '{submission} {scene} {image}' --submissions class "
      "--timeout 5 --cpu 10000 "
      "--processes 10000 --json j.json");
  EXPECT_EQ(verdicts(), (Verdicts{{"a-hog", "timed-out"}, {"b-right", "right"}, {"c-hog", "timed-out"}}))
      << told.output;
}

TEST_F(JudgeClassRuns, AnExitCodeIsNoSignal) {
  for (const char* const code : {"137", "152"}) submit(code, std::string("exit ") + code + "\n");
  submit("killed", "kill -9 $$\n");
  shell(std::string(run_class) + "--json j.json");
  EXPECT_EQ(verdicts(), (Verdicts{{"137", "crashed"}, {"152", "crashed"}, {"killed", "crashed"}}));
  for (const char* const code : {"137", "152"}) {
    const Json told = json();
    const Json& pictures = told.at("pictures");
    const auto at = std::find_if(pictures.begin(), pictures.end(),
                                 [&](const Json& picture) { return picture["submission"] == code; });
    EXPECT_TRUE(contains((*at)["message"], std::string("or exit code ") + code)) << *at;
  }
  EXPECT_TRUE(contains(json()["pictures"][2]["message"], "signal 9")) << json();
}

/// The script that runs the submissions lies beside them and beside the results.
class JudgeBesideResults : public JudgeClassRuns {
 protected:
  void SetUp() override {
    JudgeClassRuns::SetUp();
    place_ = "teach/";
    fs::create_directories(workplace_.path("teach/class"));
    fs::copy(workplace_.path("scenes"), workplace_.path("teach/scenes"));
    fs::permissions(
        workplace_.file(
            "teach/run.sh",
            "#!/bin/sh\nbeside=$(dirname \"$0\")/beside\n[ ! -e $beside ] || . $beside\nexec \"$@\"\n"),
        fs::perms(0755));
  }
  system::ProcessResult in_place(const std::string& command) const { return shell("cd teach; " + command); }
  static constexpr const char* json_file = "teach/j.json";
  static constexpr const char* run_beside =
      "$JUDGE --renderer './run.sh {submission} {scene} {image}' --submissions class --timeout "
      "100 ";
};

TEST_F(JudgeBesideResults, NoResultIsSeenByASubmission) {
  for (const char* const place : {"cache", "stored"}) {
    fs::create_directories(workplace_.path(place_ + place));
    workplace_.file(place_ + place + "/picture", "right\n");
  }
  workplace_.file("teach/c.csv.judged.jsonl", "of an earlier run\n");
  submit_slow("ada", "0");
  submit("spy",
         "cd \"$(dirname \"$0\")/..\"; test -s run.sh && echo HERE\n"
         "for f in report/* *.json *.jsonl *.csv *.xml cache/* stored/*; do test -s \"$f\" && echo SEEN $f; "
         "done\nexit 3\n");
  const std::string all = "export PLUMB_CACHE=$PWD/cache PLUMB_REFERENCES=$PWD/stored; " +
                          std::string(run_beside) + "--report report --json j.json --csv c.csv --junit u.xml";
  for (const char* const when : {"first", "with the results of the first"}) {
    const auto told = in_place(all);
    ASSERT_EQ(verdicts(json_file), (Verdicts{{"ada", "right"}, {"spy", "crashed"}})) << told.output;
    EXPECT_EQ(json(json_file)["pictures"][1]["printed"], "HERE\n") << when;
  }
  // Where the results are among what is shown the pages are hidden alone.
  in_place(std::string(run_beside) + "--report . --json j.json");
  in_place(std::string(run_beside) + "--report . --json j.json");
  EXPECT_TRUE(exists("teach/submission-1.html"));
  submit("spy",
         "cd \"$(dirname \"$0\")/..\"; test -s run.sh && echo HERE; test -s submission-1.html && echo "
         "SEEN; test -s judged.jsonl && echo SEEN; exit 3\n");
  in_place(std::string(run_beside) + "--report . --json j.json");
  EXPECT_EQ(json(json_file)["pictures"][1]["printed"], "HERE\n");
}

TEST_F(JudgeBesideResults, ResultsAndOtherSubmissionsAreNoChange) {
  submit_slow("a", "0");
  submit("b", "sleep 100\n");
  const std::string all = std::string(run_beside) + "--report report --json j.json --csv c.csv";
  in_place(all +
           " & judge=$!\nuntil grep -q key report/judged.jsonl 2>/dev/null || ! kill -0 $judge; do sleep "
           "0.1; done\n" +
           "kill -TERM $judge; wait $judge");
  ASSERT_EQ(verdicts(json_file), (Verdicts{{"a", "right"}, {"b", "not-judged"}}));
  const Json before = json(json_file)["pictures"][0]["wall_seconds"];
  submit_slow("b", "0");
  ASSERT_EQ(in_place(all).exit_code, 0);
  EXPECT_EQ(json(json_file)["pictures"][0]["wall_seconds"], before) << "it ran again";
}

TEST_F(JudgeBesideResults, WhatLiesBesideTheScriptIsAChange) {
  submit_slow("a", "0");
  submit("b", "sleep 100\n");
  const std::string all = std::string(run_beside) + "--report report --json j.json";
  in_place(all +
           " & judge=$!\nuntil grep -q key report/judged.jsonl 2>/dev/null || ! kill -0 $judge; do sleep "
           "0.1; done\n" +
           "kill -TERM $judge; wait $judge");
  fs::permissions(workplace_.file("teach/beside", "exit 3\n"), fs::perms(0644));
  in_place(all);
  EXPECT_EQ(verdicts(json_file), (Verdicts{{"a", "crashed"}, {"b", "crashed"}}));
}

TEST_F(JudgeClassRuns, SaysWhatWasDoneInsteadOfAPicture) {
  submit("nothing", "exit 0\n");
  submit("prints", "echo rendering; printf 'P3\\n16 12\\n255\\n0 0 0\\n'\n");
  submit("another", "mkdir pictures; echo x > result.ppm; echo x > pictures/y.ppm\n");
  submit("fails", "echo x > result.ppm; exit 3\n");
  const auto told = shell(std::string(run_class) + "--json j.json");
  EXPECT_EQ(told.exit_code, 1) << told.output;
  EXPECT_EQ(
      verdicts(),
      (Verdicts{
          {"nothing", "no-image"}, {"prints", "no-image"}, {"another", "no-image"}, {"fails", "crashed"}}));
  std::map<std::string, std::string> why;
  const Json all = json();
  for (const Json& picture : all.at("pictures")) why[picture["submission"]] = picture["message"];
  EXPECT_TRUE(contains(why["nothing"], "wrote nothing")) << why["nothing"];
  EXPECT_TRUE(contains(why["prints"], "printed to standard output as PPM (P3)")) << why["prints"];
  for (const char* const part : {"result.ppm", "pictures/y.ppm", "expected s.ppm or out.ppm"})
    EXPECT_TRUE(contains(why["another"], part)) << why["another"];
  EXPECT_TRUE(contains(why["fails"], "exit code 3")) << why["fails"];
  EXPECT_TRUE(contains(why["fails"], "result.ppm")) << why["fails"];
}

TEST_F(JudgeClassRuns, WhatIsPrintedIsJudgedAsTheMessageSays) {
  submit_slow("prints", "0");
  const std::string script = workplace_.path("class/prints");
  workplace_.file("class/prints", replaced(read_file(script), " > \"$2\"", ""));
  const auto told = shell(
      "$JUDGE --renderer 'sh -c \"\\\"$@\\\" > \\\"$0\\\"\" {image} {submission} {scene}' --submissions "
      "class "
      "--timeout 100");
  EXPECT_EQ(told.exit_code, 0) << told.output;
}

}  // namespace
}  // namespace plumb::tests
