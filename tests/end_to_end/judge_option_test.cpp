// `plumb verify --judge`: who is wrong, in the table, in JSON and in words.
#include <nlohmann/json.hpp>

#include "tests/support/end_to_end.hpp"

namespace plumb::tests {
namespace {

using Json = nlohmann::json;

const char* const verdicts[] = {"ours_wrong", "reference_wrong", "both_wrong", "undecided"};

/// Against the stored image: POV-Ray is not needed.
Outcome verify(const Workplace& workplace, const std::string& scene, std::vector<std::string> more) {
  std::vector<std::string> arguments{"verify", "--stored", source_path("tests/scenes/" + scene)};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_plumb(arguments, workplace.directory());
}

Json only_scene(const Workplace& workplace, const std::string& scene, std::vector<std::string> more) {
  more.insert(more.end(), {"--json", "-"});
  const Outcome outcome = verify(workplace, scene, more);
  EXPECT_TRUE(Json::accept(outcome.out)) << outcome.out << outcome.err;
  return Json::parse(outcome.out, nullptr, false).at("scenes").at(0);
}

/// Every pixel over is in the list or was not judged, and the counts are those of the list.
void expect_complete(const Json& scene) {
  const Json& judgement = scene.at("judgement");
  const Json& pixels = judgement.at("pixels");
  EXPECT_EQ(pixels.size() + judgement.at("not_judged").get<std::size_t>(),
            scene.at("pixels_over").get<std::size_t>());
  for (const char* const verdict : verdicts) {
    const auto count = std::count_if(pixels.begin(), pixels.end(),
                                     [&](const Json& pixel) { return pixel.at("verdict") == verdict; });
    EXPECT_EQ(judgement.at(verdict).get<std::ptrdiff_t>(), count) << verdict;
  }
  for (const Json& pixel : pixels) {
    for (const char* const value : {"ours", "reference", "oracle"}) EXPECT_EQ(pixel.at(value).size(), 3U);
  }
}

TEST(JudgeOption, SaysThatFloatIsWrong) {
  const Workplace workplace;
  const std::vector<std::string> in_float{"--real", "float"};
  const Json plain = only_scene(workplace, "refraction.sdf", in_float);
  ASSERT_GT(plain.at("pixels_over"), 0);
  EXPECT_FALSE(plain.contains("judgement"));
  const Json judged = only_scene(workplace, "refraction.sdf", {"--real", "float", "--judge"});
  expect_complete(judged);
  EXPECT_GT(judged.at("judgement").at("ours_wrong"), 0);
  EXPECT_EQ(judged.at("judgement").at("reference_wrong"), 0);
  EXPECT_TRUE(contains(judged.at("message"), "judged in 113 bits, our side is wrong at "));
  EXPECT_EQ(judged.at("status"), "differ");
  EXPECT_GE(judged.at("budget").at("unexplained"), judged.at("judgement").at("ours_wrong"))
      << "what is wrong by 113 bits is explained by nothing";
  EXPECT_EQ(judged.at("pixels_over"), plain.at("pixels_over"));
}

TEST(JudgeOption, SaysThatTheReferenceIsWrongWhenItsRoundingCounts) {
  // Both round to float32: ours once, POV-Ray on its way, too. Within 1e-9 only the nearest float is right.
  const Workplace workplace;
  const Json judged =
      only_scene(workplace, "phong.sdf", {"--size", "160x120", "--judge", "--tolerance", "1e-9"});
  expect_complete(judged);
  EXPECT_GT(judged.at("judgement").at("reference_wrong"), 0);
  EXPECT_EQ(judged.at("judgement").at("ours_wrong"), 0);
}

TEST(JudgeOption, HasALineInTheTableWhereSomethingDiffers) {
  const Workplace workplace;
  const Outcome judged = verify(workplace, "refraction.sdf", {"--real", "float", "--judge"});
  EXPECT_TRUE(contains(judged.out, "judged in 113 bits: ours wrong ")) << judged.out;
  const Outcome plain = verify(workplace, "refraction.sdf", {"--real", "float"});
  EXPECT_FALSE(contains(plain.out, "judged")) << plain.out;
  EXPECT_EQ(plain.exit_code, judged.exit_code);
  const Outcome same = verify(workplace, "refraction.sdf", {"--judge"});
  EXPECT_EQ(same.exit_code, 0) << same.out;
  EXPECT_FALSE(contains(same.out, "judged")) << "nothing differs: " << same.out;
}

TEST(JudgeOption, IsOnTheReportsPage) {
  const Workplace workplace;
  verify(workplace, "refraction.sdf", {"--real", "float", "--judge", "--report", "report"});
  const std::string page = read_file(workplace.path("report/index.html"));
  EXPECT_TRUE(contains(page, "judged in 113 bits: ours wrong "));
}

}  // namespace
}  // namespace plumb::tests
