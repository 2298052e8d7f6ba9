// `plumb judge --shuffle`: scenes that a submission cannot have seen.
#include <nlohmann/json.hpp>

#include "references/submissions/sandbox/sandbox.hpp"
#include "tests/support/end_to_end.hpp"

namespace plumb::tests {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class JudgeShuffle : public testing::Test {
 protected:
  void SetUp() override {
    try {
      submissions::require_sandbox();
    } catch (const std::runtime_error& error) {
      GTEST_SKIP() << error.what();
    }
    fs::create_directories(workplace_.path("scenes"));
    workplace_.file("scenes/s.sdf", std::string(ball_scene));
    for (const char* const name : {"knows", "renders"})
      fs::create_directories(workplace_.path("class/") + name);
    // A tracer, and one that has seen the picture of the scene as it is.
    fs::copy_file(PLUMB_BINARY, workplace_.path("class/renders/tracer"));
    const std::string script =
        workplace_.file("class/knows/tracer", "#!/bin/sh\ncat \"${0%/*}/s.ppm\" > \"$4\"\n");
    fs::permissions(script, fs::perms(0755));
    const Outcome made =
        run_plumb({"render", "scenes/s.sdf", "-o", "class/knows/s.ppm"}, workplace_.directory());
    ASSERT_EQ(made.exit_code, 0) << made.err;
  }

  std::map<std::string, std::string> verdicts(std::vector<std::string> more, int exit_code) {
    more.insert(more.begin(), {"judge", "--timeout", "100", "--scenes", "scenes", "--submissions", "class",
                               "--renderer", "{submission}/tracer render {scene} -o {image}", "--json", "-"});
    const Outcome outcome = run_plumb(more, workplace_.directory());
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.out << outcome.err;
    told_ = Json::parse(outcome.out, nullptr, false);
    std::map<std::string, std::string> all;
    for (const Json& picture : told_.value("pictures", Json::array()))
      all[picture["submission"]] = picture["verdict"];
    return all;
  }

  Workplace workplace_;
  Json told_;
};

TEST_F(JudgeShuffle, APictureThatWasStoredIsNotRight) {
  auto all = verdicts({}, 0);
  EXPECT_EQ(all["knows"], "right");
  EXPECT_EQ(all["renders"], "right");
  EXPECT_FALSE(told_.contains("shuffle"));
  all = verdicts({"--shuffle", "17", "--report", "report"}, 1);
  EXPECT_NE(all["knows"], "right") << told_;
  EXPECT_EQ(all["renders"], "right") << told_;
  EXPECT_EQ(told_["shuffle"], Json::parse(R"({"seed":17,"unvaried":[]})"));
  for (const char* const page : {"report/index.html", "report/submission-1.html"})
    EXPECT_TRUE(contains(read_file(workplace_.path(page)), "--shuffle 17")) << page;
  EXPECT_NE(read_file(workplace_.path("report/scenes/s.sdf")), std::string(ball_scene));
}

TEST_F(JudgeShuffle, WhatCannotBeVariedIsSaid) {
  // Nothing but background: no number of it may change which faults are seen, and none is seen.
  workplace_.file("scenes/s.sdf", "background 0 0 0\ndefine camera eye 60\nrender eye out.ppm 32 24\n");
  verdicts({"--shuffle", "1"}, 1);
  EXPECT_EQ(told_["shuffle"]["unvaried"], Json::array({"s"}));
}

TEST_F(JudgeShuffle, PicturesThatAreMadeAlreadyCannotBeVaried) {
  const Outcome outcome = run_plumb(
      {"judge", "--scenes", "scenes", "--images", "class/knows", "--shuffle", "1"}, workplace_.directory());
  expect_trouble(outcome, {"--shuffle", "--renderer"});
}

}  // namespace
}  // namespace plumb::tests
