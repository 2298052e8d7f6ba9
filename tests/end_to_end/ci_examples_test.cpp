// The examples of continuous integration: read as YAML, and their lines run as far as that goes without a
// server. The packages and the clone are taken to be there; the program is the one just built.
#include <nlohmann/json.hpp>

#include "tests/support/end_to_end.hpp"

namespace plumb::tests {
namespace {

using Json = nlohmann::json;

/// By Python's YAML parser, which does not accept what is no YAML.
Json yaml(const std::string& path) {
  const Workplace workplace;
  const auto result = run_shell(
      "python3 -c 'import json, sys, yaml; print(json.dumps(yaml.safe_load(open(sys.argv[1]))))' '" + path +
          "'",
      workplace.directory());
  EXPECT_EQ(result.exit_code, 0) << result.output;
  return Json::parse(result.output, nullptr, false);
}

std::string joined(const Json& lines) {
  std::string text;
  for (const Json& line : lines) text += line.get<std::string>() + "\n";
  return text;
}

/// What one example does, wherever its server wants it written.
struct Example {
  std::string install;
  std::string compare;
  std::string image;
  std::string kept;  ///< the folder that is kept
  bool is_kept_on_failure = false;
};

Example github() {
  const Json job = yaml(source_path("scripts/ci-examples/github.yml")).at("jobs").at("regress");
  const Json& steps = job.at("steps");
  EXPECT_EQ(steps.size(), 4U);
  EXPECT_TRUE(steps.at(0).at("uses").get<std::string>().starts_with("actions/checkout@"));
  const Json& keep = steps.at(3);
  EXPECT_TRUE(keep.at("uses").get<std::string>().starts_with("actions/upload-artifact@"));
  EXPECT_TRUE(contains(steps.at(1).at("env").at("PLUMB_URL"), "vars.PLUMB_URL"));
  return {steps.at(1).at("run"), steps.at(2).at("run"), job.at("container"), keep.at("with").at("path"),
          keep.at("if") == "always()"};
}

Example gitlab() {
  const Json job = yaml(source_path("scripts/ci-examples/gitlab.yml")).at("regress");
  const Json& artifacts = job.at("artifacts");
  EXPECT_EQ(artifacts.at("reports").at("junit"), "results/junit.xml");
  return {joined(job.at("before_script")), joined(job.at("script")), job.at("image"),
          artifacts.at("paths").at(0), artifacts.at("when") == "always"};
}

class CiExample : public testing::TestWithParam<Word> {
 protected:
  void SetUp() override {
    example_ = std::string(GetParam().text) == "Github" ? github() : gitlab();
    std::filesystem::create_directories(workplace_.path(".plumb/build"));
    std::filesystem::create_symlink(PLUMB_BINARY, workplace_.path(".plumb/build/plumb"));
    std::filesystem::create_directory(workplace_.path("scenes"));
    workplace_.file("scenes/ball.sdf", std::string(ball_scene));
    const Outcome approved = run_plumb({"regress", "scenes", "--update", "ball", "--because", "looked at"},
                                       workplace_.directory());
    ASSERT_EQ(approved.exit_code, 0) << approved.err;
  }

  /// Both servers run the lines so that the first that fails ends the job.
  system::ProcessResult run(const std::string& lines) const {
    return run_shell("set -e\n" + lines, workplace_.directory());
  }
  std::string kept(const std::string& file) const { return workplace_.path(example_.kept + "/" + file); }

  Workplace workplace_;
  Example example_;
};
INSTANTIATE_TEST_SUITE_P(Of, CiExample, testing::Values(Word{"Github"}, Word{"Gitlab"}),
                         [](const auto& test) { return std::string(test.param.text); });

TEST_P(CiExample, InstallsByTheCommandOfTheReadme) {
  EXPECT_EQ(example_.image, "debian:12");
  EXPECT_TRUE(contains(example_.install, "git clone --depth 1 \"$PLUMB_URL\" .plumb\n")) << example_.install;
  EXPECT_TRUE(contains(example_.install, "\n.plumb/scripts/verify\n")) << example_.install;
  EXPECT_TRUE(contains(read_file(source_path("README.md")), "    scripts/verify "));
  const auto checked = run("sh -n <<'LINES'\n" + example_.install + "LINES\n");
  EXPECT_EQ(checked.exit_code, 0) << checked.output;
}

TEST_P(CiExample, PassesWhenTheScenesAgree) {
  const auto result = run(example_.compare);
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_TRUE(contains(read_file(kept("junit.xml")), "failures=\"0\"")) << result.output;
  EXPECT_TRUE(std::filesystem::exists(kept("report/index.html")));
}

TEST_P(CiExample, FailsAndKeepsTheResultsWhenASceneDiffers) {
  workplace_.file("scenes/ball.sdf", replaced(ball_scene, "0 0 -3", "0 0.1 -3"));
  const auto result = run(example_.compare);
  EXPECT_EQ(result.exit_code, 1) << result.output;
  EXPECT_TRUE(example_.is_kept_on_failure);
  EXPECT_TRUE(contains(read_file(kept("junit.xml")), "failures=\"1\""));
  EXPECT_TRUE(std::filesystem::exists(kept("report/index.html")));
}

/// These tests would see an option that is gone.
TEST_P(CiExample, AnOptionThatDoesNotExistIsTrouble) {
  const auto result = run(replaced(example_.compare, "--junit", "--junitt"));
  EXPECT_EQ(result.exit_code, 2) << result.output;
  EXPECT_TRUE(contains(result.output, "--junitt")) << result.output;
}

}  // namespace
}  // namespace plumb::tests
