// plumb chart: its figures, its pictures, and what it does when it is broken off or has nothing to draw with.
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "references/studies/chart/plot.hpp"
#include "tests/support/end_to_end.hpp"

namespace plumb::tests {
namespace {

using nlohmann::json;

/// A point of a chart as plot.py reads it.
json point(const std::string& renderer, const std::string& title, double ratio, json rms, int non_finite,
           const char* against) {
  return {{"id", title},
          {"title", title},
          {"renderer", renderer},
          {"real", "float"},
          {"methods", title},
          {"against", against},
          {"ratio", {{"median", ratio}, {"min", 0.9 * ratio}, {"max", 1.2 * ratio}}},
          {"error", {{"max", rms}, {"rms", rms}, {"pixels_over", 12}, {"non_finite", non_finite}}},
          {"fails", non_finite > 0 || rms > 1},
          {"pareto", ratio < 2}};
}

/// What is hard to draw: an error of 0, one that overflows, one that is no number, long names, equal points.
json hard_chart() {
  json points;
  for (const char* against : {"pixel_centres", "pixel_areas"}) {
    points.push_back(point("engine", "engine, float", 1, 1e-7, 0, against));
    points.push_back(point("engine", "engine, double", 1.5, 0, 0, against));
    points.push_back(point("textbook", "textbook, float, normal-as-it-is", 5, 8e35, 0, against));
    points.push_back(
        point("textbook", "textbook, double, a-method-of-a-very-long-name", 6, nullptr, 390, against));
    for (const double ratio : {20., 20., 21.})
      points.push_back(point("povray", "POV-Ray, " + std::to_string(points.size()), ratio, 4e-6, 0, against));
  }
  const json scene{
      {"scene", std::string(90, 'd') + "/scene.sdf"}, {"left_out", json::array()}, {"points", points}};
  return {{"plumb", "0"},
          {"machine", "a machine"},
          {"runs", 3},
          {"size", {{"width", 40}, {"height", 30}}},
          {"instructions_complaint", "none"},
          {"scenes", {scene, scene}}};
}

/// By the definition, with loops that share nothing with pareto_front(): it makes a picture, and of those
/// that do nothing beats it in one figure and is as good in the other.
bool is_on_front(const json& points, const json& one) {
  const auto cost = [](const json& p) { return p["ratio"]["median"].get<double>(); };
  const auto error = [](const json& p) { return p["error"]["rms"].get<double>(); };
  const auto fails = [&](const json& p) { return p["error"]["non_finite"] > 0 || !(error(p) <= 1); };
  if (fails(one)) return false;
  for (const json& other : points) {
    if (other["against"] != one["against"] || fails(other)) continue;
    if (cost(other) <= cost(one) && error(other) <= error(one) &&
        (cost(other) < cost(one) || error(other) < error(one)))
      return false;
  }
  return true;
}

class ChartCommand : public testing::Test {
 protected:
  json chart_in(const std::string& name) { return json::parse(read_file(workplace_.path(name))); }

  /// Of the message.
  std::string complaint_of(const std::vector<std::string>& interpreter) {
    try {
      studies::check_plotting(interpreter);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  Workplace workplace_;
  std::string ball_ = workplace_.file("ball.sdf", std::string(ball_scene));
};

TEST_F(ChartCommand, MeasuresEveryWayAndDrawsIt) {
  const Outcome outcome = run_plumb({"chart", "ball.sdf", "--size", "32x24", "--runs", "1", "--json",
                                     "c.json", "--svg", "c.svg", "--png", "c.png"},
                                    workplace_.directory());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json chart = chart_in("c.json");
  EXPECT_EQ(chart["size"], (json{{"width", 32}, {"height", 24}}));
  ASSERT_EQ(chart["scenes"].size(), 1U);
  const json& points = chart["scenes"][0]["points"];
  std::vector<std::string> ids;
  double fastest = std::numeric_limits<double>::infinity();
  for (const json& p : points) {
    ids.push_back(p["id"]);
    EXPECT_EQ(p["runs"], 1);
    EXPECT_FALSE(p["measured_before"]);
    EXPECT_GT(p["cpu_seconds"]["median"], 0);
    EXPECT_EQ(p["instructions"].is_null(), !chart["instructions_complaint"].is_null());
    EXPECT_EQ(p["pareto"], is_on_front(points, p)) << p["id"];
    EXPECT_EQ(p["fails"], p["error"]["non_finite"] > 0 || !(p["error"]["rms"] <= 1)) << p["id"];
    EXPECT_EQ(p["instructions_ratio"].is_null(), p["instructions"].is_null()) << p["id"];
    fastest = std::min(fastest, p["ratio"]["median"].get<double>());
  }
  EXPECT_EQ(fastest, 1);
  for (const char* id : {"engine-float", "engine-double-brute-force", "engine-double-samples-16",
                         "textbook-float-sphere-naive", "textbook-long-double", "povray-state",
                         "povray-png16", "povray-png8", "povray-aa-fine"})
    EXPECT_EQ(std::count(ids.begin(), ids.end(), id), 1) << id;
  EXPECT_TRUE(read_file(workplace_.path("c.png")).starts_with("\x89PNG"));
  EXPECT_TRUE(contains(read_file(workplace_.path("c.svg")), "POV-Ray, PNG16"));
  EXPECT_EQ(listing(workplace_.directory()),
            (std::vector<std::string>{"ball.sdf", "c.json", "c.png", "c.svg"}));
}

TEST_F(ChartCommand, GoesOnWhereItWasKilled) {
  // Killed as soon as three ways are timed.
  const auto killed = run_shell(
      "\"$0\" chart ball.sdf --size 16x12 --runs 1 --json never.json & plumb=$!\n"
      "for i in $(seq 6000); do\n"
      "  [ $(cat .cache/chart/*.json 2>/dev/null | grep -o yardstick_seconds | wc -l) -ge 3 ] && break\n"
      "  sleep 0.01\n"
      "done\n"
      "kill -9 $plumb; wait $plumb; true",
      workplace_.directory());
  ASSERT_EQ(killed.exit_code, 0) << killed.output;
  ASSERT_FALSE(std::filesystem::exists(workplace_.path("never.json")));
  const std::vector<std::string> again{"chart",  "ball.sdf", "--size", "16x12",
                                       "--runs", "1",        "--json", "c.json"};
  ASSERT_EQ(run_plumb(again, workplace_.directory(), {"PLUMB_CACHE=" + workplace_.path(".cache")}).exit_code,
            0);
  const json chart = chart_in("c.json");
  const json& points = chart["scenes"][0]["points"];
  const auto kept = std::count_if(points.begin(), points.end(),
                                  [](const json& p) { return p["measured_before"].get<bool>(); });
  EXPECT_GE(kept, 3);
  EXPECT_LT(kept, static_cast<std::ptrdiff_t>(points.size()));
}

TEST_F(ChartCommand, AllTextLiesInThePictureAndNoneOnAnother) {
  const std::string chart = workplace_.file("hard.json", hard_chart().dump());
  system::ProcessLimits limits;
  limits.seconds = 60;
  const auto result =
      system::run_process({"/usr/bin/python3", "-B", source_path("tests/support/chart_texts.py"),
                           source_path("references/studies/chart/plot.py"), chart},
                          workplace_.directory(), limits);
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_TRUE(result.output.ends_with(" texts\n")) << result.output;
  EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
}

TEST_F(ChartCommand, DrawsTheSameBytesAgain) {
  const std::vector<std::string> files{workplace_.path("a.svg"), workplace_.path("b.svg")};
  for (const std::string& file : files) studies::plot_chart(hard_chart().dump(), {file});
  const std::string svg = read_file(files[0]);
  EXPECT_EQ(svg, read_file(files[1]));
  for (const char* text : {"fails", "390 not finite", "RMS 8e+35"}) EXPECT_TRUE(contains(svg, text)) << text;
}

TEST_F(ChartCommand, NamesThePackageThatIsMissing) {
  // -S: without what Debian's packages add to Python.
  const std::string no_matplotlib = complaint_of({"/usr/bin/python3", "-S"});
  EXPECT_TRUE(contains(no_matplotlib, "matplotlib is missing")) << no_matplotlib;
  EXPECT_TRUE(contains(no_matplotlib, "apt-get install python3-matplotlib")) << no_matplotlib;
  const std::string no_python = complaint_of({workplace_.path("python3")});
  EXPECT_TRUE(contains(no_python, "apt-get install python3-matplotlib")) << no_python;
  EXPECT_TRUE(contains(no_python, workplace_.path("python3"))) << no_python;
  EXPECT_EQ(complaint_of(studies::usual_python), "");
}

}  // namespace
}  // namespace plumb::tests
