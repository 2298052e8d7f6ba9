// Speed against accuracy: every way to render a scene, its cost, and how far its picture is off.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "references/gates/verify.hpp"
#include "references/studies/chart/configuration.hpp"
#include "references/studies/chart/measurement.hpp"

namespace plumb::studies {

struct ChartOptions {
  Size size{160, 120};  ///< of all scenes; the oracle takes a minute for ten times as many pixels
  std::string camera;   ///< instead of the scenes' own, when not empty
  Dialect dialect;
  RenderOptions render;
  int runs = 5;
  bool fresh = false;  ///< true: nothing that was measured before is used
  std::function<void(double)> progress;
  std::function<void(const std::string&)> warn;
};

/// Median and extremes of several runs.
struct Spread {
  double median, min, max;
};
Spread spread_of(std::vector<double> values);

struct ChartPoint {
  Configuration way;
  ChartError error;
  Spread cpu_seconds;
  Spread ratio;  ///< to the fastest of the scene
  std::optional<std::uint64_t> instructions;
  int runs = 0;                                ///< as many as asked for; fewer where one takes long
  std::optional<double> instructions_ratio{};  ///< to the fewest of the scene
  bool fails = false;                          ///< makes no picture worth its cost: RMS over 1, or not finite
  bool pareto = false;                         ///< no other with the same truth beats its ratio and RMS error
  bool measured_before = false;                ///< true if all runs come from the cache
};

struct ChartScene {
  std::string scene;
  std::vector<ChartPoint> points;
  std::vector<std::string> left_out;  ///< each with the reason
};

struct Chart {
  ChartOptions options;
  std::vector<ChartScene> scenes;
  std::string machine;
  std::string povray;        ///< its version; empty when there is none
  std::string instructions;  ///< why they were not counted; empty when they were
};

/// Renders in one thread, run by run, every configuration once per run. The yardstick goes before each, so
/// that costs of different minutes, and of runs that were broken off and resumed, have a measure in common: a
/// ratio is a quotient of such quotients. Each measurement is kept at once, in the cache. Throws what reading
/// scenes and rendering throw.
Chart measure_chart(const std::vector<std::string>& scenes, const ChartOptions& options);

}  // namespace plumb::studies
