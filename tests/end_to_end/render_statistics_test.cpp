// plumb render: the two tracers, samples and statistics, as a user asks for them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/end_to_end.hpp"
#include "tests/support/run.hpp"

namespace plumb::tests {
namespace {

class Render : public testing::Test {
 protected:
  Outcome render(std::vector<std::string> options) {
    options.insert(options.begin(), {"render", scene_});
    return run_plumb(options, workplace_.directory());
  }
  std::string bytes(const std::string& name) { return read_file(workplace_.path(name)); }

  Workplace workplace_;
  std::string scene_ = workplace_.file("ball.sdf", std::string(ball_scene));
};

TEST_F(Render, BothTracersGiveOnePicture) {
  EXPECT_EQ(render({"-o", "fast.pfm"}).exit_code, 0);
  EXPECT_EQ(render({"-o", "slow.pfm", "--engine", "textbook"}).exit_code, 0);
  const Outcome compared = run_plumb({"compare", "slow.pfm", "fast.pfm"}, workplace_.directory());
  EXPECT_EQ(compared.exit_code, 0) << compared.out;
  EXPECT_EQ(render({"-o", "x.pfm", "--engine", "embree"}).exit_code, 2);
}

TEST_F(Render, StatisticsCountTheRays) {
  const Outcome outcome = render({"-o", "a.pfm", "--stats", "--stats-json", "stats.json"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("rays     camera 768 shadow"), std::string::npos) << outcome.err;
  const auto json = nlohmann::json::parse(bytes("stats.json"));
  EXPECT_EQ(json["engine"], "engine");
  EXPECT_EQ(json["rays"]["camera"], 32 * 24);
  EXPECT_GT(json["rays"]["shadow"], 0);
  EXPECT_EQ(json["rays"]["mirrored"], 0);
  EXPECT_EQ(json["objects"], 1);
  EXPECT_GT(json["seconds"]["render"], 0);
  EXPECT_GT(json["cpu_seconds"]["build"], 0);
  EXPECT_NE(json["kernel"].get<std::string>().find("no secondary rays"), std::string::npos);
}

TEST_F(Render, StatisticsOfTheTextbookTracerAreItsTimesAlone) {
  for (const char* option : {"--engine=textbook", "--real=long-double"}) {
    EXPECT_EQ(render({"-o", "a.pfm", option, "--stats-json", "stats.json"}).exit_code, 0);
    const auto json = nlohmann::json::parse(bytes("stats.json"));
    EXPECT_EQ(json["engine"], "textbook");
    EXPECT_GT(json["seconds"]["render"], 0);
    EXPECT_FALSE(json.contains("rays"));
  }
  EXPECT_EQ(render({"-o", "-", "--stats-json", "-"}).exit_code, 2);
}

TEST_F(Render, SamplesSmoothTheEdgeAndLeaveTheRest) {
  EXPECT_EQ(render({"-o", "one.pfm"}).exit_code, 0);
  EXPECT_EQ(render({"-o", "sixteen.pfm", "--samples", "16", "--stats-json", "stats.json"}).exit_code, 0);
  EXPECT_EQ(nlohmann::json::parse(bytes("stats.json"))["rays"]["camera"], 16 * 32 * 24);
  EXPECT_NE(bytes("one.pfm"), bytes("sixteen.pfm"));
  EXPECT_EQ(render({"-o", "same.pfm", "--samples", "1", "--pattern", "low-discrepancy"}).exit_code, 0);
  EXPECT_EQ(bytes("one.pfm"), bytes("same.pfm"));
}

TEST_F(Render, SamplesThatDoNotFitAreRefused) {
  const Outcome no_square = render({"-o", "x.pfm", "--samples", "5", "--pattern", "grid"});
  EXPECT_EQ(no_square.exit_code, 2);
  EXPECT_NE(no_square.err.find("expected a square like 4"), std::string::npos) << no_square.err;
  EXPECT_EQ(render({"-o", "x.pfm", "--samples", "5"}).exit_code, 0);
  const Outcome textbook = render({"-o", "y.pfm", "--samples", "4", "--engine", "textbook"});
  EXPECT_EQ(textbook.exit_code, 2);
  EXPECT_NE(textbook.err.find("expected 1"), std::string::npos) << textbook.err;
  EXPECT_EQ(render({"-o", "z.pfm", "--samples", "0"}).exit_code, 2);
}

}  // namespace
}  // namespace plumb::tests
