// Methods of the literature draw the lecture's picture where none of them has a reason to fail.
#include "tracer/methods/method_sets.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "references/studies/chart/pareto.hpp"
#include "tests/support/run.hpp"
#include "tracer/format/reader.hpp"

namespace plumb::tests {
namespace {

textbook::RenderJob small_job() {
  textbook::RenderJob job;
  job.width = 60;
  job.height = 40;
  return job;
}

Scene still_life() {
  return read_scene(read_file(tests::source_path("tests/scenes/combined-still-life.sdf"))).scene;
}

TEST(MethodSets, TheFirstIsTheLectures) {
  const Scene scene = still_life();
  EXPECT_EQ(methods::method_sets().front().id, "lecture");
  EXPECT_EQ(
      methods::render_with_methods(methods::method_sets().front(), scene, scene.cameras.front(), small_job())
          .rgb,
      textbook::render(scene, scene.cameras.front(), small_job()).rgb);
}

TEST(MethodSets, IdsAreUniqueAndEachNamesItsSource) {
  std::set<std::string_view> ids;
  for (const methods::MethodSet& set : methods::method_sets()) {
    EXPECT_TRUE(ids.insert(set.id).second) << set.id;
    EXPECT_FALSE(set.source.empty()) << set.id;
    EXPECT_EQ(methods::find_method_set(set.id), &set);
  }
  EXPECT_EQ(methods::find_method_set("no-such-method"), nullptr);
}

TEST(MethodSets, SphereAndBoxMethodsDrawTheSamePicture) {
  const Scene scene = still_life();
  const Image right = textbook::render(scene, scene.cameras.front(), small_job());
  int tried = 0;
  for (const methods::MethodSet& set : methods::method_sets()) {
    if (!set.id.starts_with("sphere-") && !set.id.starts_with("box-")) continue;
    ++tried;
    const Image image = methods::render_with_methods(set, scene, scene.cameras.front(), small_job());
    int pixels = 0;
    for (std::size_t i = 0; i < image.rgb.size(); ++i) {
      // because methods differ by some 1e-16 of t, enlarged by mirrors and glass
      pixels += std::abs(image.rgb[i] - right.rgb[i]) <= 1e-5F ? 0 : 1;
    }
    EXPECT_EQ(pixels, 0) << set.id;
  }
  EXPECT_GE(tried, 6);
}

/// By its definition, point by point.
std::vector<bool> front_by_definition(const std::vector<studies::CostAndError>& points) {
  std::vector<bool> on;
  for (const studies::CostAndError& p : points) {
    bool is_beaten = false;
    for (const studies::CostAndError& q : points) {
      const bool as_good = q.cost <= p.cost && q.error <= p.error;
      is_beaten = is_beaten || (as_good && (q.cost < p.cost || q.error < p.error));
    }
    on.push_back(!is_beaten);
  }
  return on;
}

TEST(ParetoFront, IsThatOfTheDefinition) {
  std::uint32_t state = 1;
  const auto random = [&] { return static_cast<double>((state = state * 1664525U + 1013904223U) >> 28U); };
  for (int set = 0; set < 200; ++set) {
    std::vector<studies::CostAndError> points;
    for (int i = 0; i < 12; ++i) points.push_back({random(), random()});  // of 16 values: many are equal
    EXPECT_EQ(studies::pareto_front(points), front_by_definition(points)) << set;
  }
}

}  // namespace
}  // namespace plumb::tests
