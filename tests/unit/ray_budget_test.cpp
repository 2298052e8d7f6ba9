// One price of a ray, wherever it is asked; and which pixels a budget looks at.
#include "tracer/textbook/ray_budget.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <set>

#include "references/attribution/pixel_tracer.hpp"
#include "references/faults/fault.hpp"
#include "references/renderers/povray.hpp"
#include "references/truth/oracle.hpp"
#include "references/truth/oracle_sample.hpp"
#include "tests/support/random_scene.hpp"
#include "tracer/scene/hierarchy.hpp"
#include "tracer/textbook/sampled_pixels.hpp"

namespace plumb::tests {
namespace {

using textbook::Work;

constexpr int side = 12;
constexpr double endless = std::numeric_limits<double>::infinity();

double instances_of(const Scene& scene) {
  double instances = 0;
  for_each_instance(scene, [&](const Instance&) { ++instances; });
  return instances;
}

/// Rays that are traced, and those to lights that light their point.
double charged_rays(const attribution::RayNode& tree) {
  double rays = 1;
  if (tree.meeting) {
    for (const auto& light : tree.meeting->lights) rays += light.counts ? 1 : 0;
  }
  for (const attribution::RayNode& child : tree.children) rays += charged_rays(child);
  return rays;
}

template <class Traced>
double spent_by(const Traced& trace) {
  Work work(endless);
  trace(work);
  return work.spent();
}

/// A random scene, one of its pixels, and what its rays cost by the contract: 20, and 1 for each sphere and
/// box.
class PriceOfAPixel : public testing::TestWithParam<unsigned> {
 protected:
  double expected() const {
    const attribution::TreeTracer tracer(shot());
    return charged_rays(tracer.tree_of(place_.x, place_.y)) * (20 + instances_of(scene_));
  }
  const Camera& camera() const { return scene_.cameras.front(); }
  Shot shot() const { return {scene_, camera(), side, side, random_.options}; }

  const RandomScene random_ = random_scene(GetParam());
  const Scene& scene_ = random_.scene;
  const PixelPlace place_{static_cast<int>(GetParam() % side), static_cast<int>(GetParam() / side % side)};
};

TEST_P(PriceOfAPixel, IsTheSameWithAndWithoutATree) {
  const Image none(side, side);
  const attribution::AttributionJob job{shot(), none, none, 1e-6, renderers::povray_resolution()};
  Work work(endless);
  const attribution::PixelTracer tracer(scene_, job, random_.options, work);
  const double world = work.spent();
  EXPECT_EQ(world, 50.0 * static_cast<double>(scene_.shapes.size()));
  tracer.at({place_.x, place_.y, attribution::Cause::unexplained});
  EXPECT_EQ(work.spent() - world, expected());
  tracer.tree_of({place_.x, place_.y, attribution::Cause::unexplained});
  EXPECT_EQ(work.spent() - world, 2 * expected());
  EXPECT_EQ(
      spent_by([&](Work& of_tree) { attribution::TreeTracer(shot(), of_tree).tree_of(place_.x, place_.y); }),
      expected());
}

TEST_P(PriceOfAPixel, IsTheSameForFaults) {
  textbook::RenderJob job;
  job.width = job.height = side;
  job.options = random_.options;
  EXPECT_EQ(spent_by([&](Work& work) { faults::colours_with(scene_, camera(), job, {}, {place_}, work); }),
            expected());
}

TEST_P(PriceOfAPixel, IsThirtyTimesAsMuchInQuad) {
  RenderJob job;
  job.width = job.height = side;
  job.options = random_.options;
  EXPECT_EQ(spent_by([&](Work& work) { truth::ask_oracle(scene_, camera(), job, {place_}, work); }),
            30 * expected());
  Work work(endless);
  const truth::Oracle oracle(shot(), work);
  const double world = work.spent();
  EXPECT_EQ(world, 30 * 50.0 * static_cast<double>(scene_.shapes.size()));
  oracle.colour(place_.x, place_.y);
  EXPECT_EQ(work.spent() - world, 30 * expected());
}

INSTANTIATE_TEST_SUITE_P(OfRandomScenes, PriceOfAPixel, testing::Range(0U, 40U));

TEST(SpreadPixels, AreEachPixelOnceAndTheFirstOnesEverywhere) {
  for (const auto& [width, height] :
       {std::pair{1, 1}, {2, 1}, {7, 5}, {64, 48}, {100, 100}, {160, 120}, {480, 360}}) {
    std::set<std::pair<int, int>> seen, cells;
    const std::vector<PixelPlace> spread = textbook::spread_pixels(width, height);
    for (std::size_t i = 0; i < spread.size(); ++i) {
      seen.insert({spread[i].x, spread[i].y});
      if (i < 200) cells.insert({8 * spread[i].x / width, 6 * spread[i].y / height});
    }
    EXPECT_EQ(seen.size(), static_cast<std::size_t>(width * height));
    EXPECT_EQ(seen.size(), spread.size());
    EXPECT_LT(seen.rbegin()->first, width);
    if (width >= 64) {
      EXPECT_EQ(cells.size(), 48U) << width << " x " << height;
    }
  }
}

TEST(SpreadPixels, AreNoMoreThanAskedFor) {
  EXPECT_EQ(textbook::spread_pixels(640, 480, 7).size(), 7U);
  EXPECT_EQ(textbook::spread_pixels(2, 3, 7).size(), 6U);
}

TEST(LookAt, StopsByWhatWasCountedOnAnyNumberOfThreads) {
  const auto looked = [](int threads, double units) {
    std::atomic<int> pixels = 0;
    Work work(units);
    const auto look = [&](std::size_t begin, std::size_t end, Work& of_piece) {
      pixels += static_cast<int>(end - begin);
      of_piece.spend(30.0 * static_cast<double>(end - begin));
    };
    const std::size_t n = textbook::look_at(10000, {work, threads, {}}, look);
    EXPECT_EQ(n, static_cast<std::size_t>(pixels));
    EXPECT_EQ(work.spent(), 30.0 * static_cast<double>(n));
    return n;
  };
  EXPECT_EQ(looked(1, 1e9), 10000U);
  EXPECT_EQ(looked(1, 60000), looked(4, 60000));
  EXPECT_GE(looked(2, 60000), 2000U);
  EXPECT_LE(looked(2, 60000), 2020U);
  EXPECT_EQ(looked(2, 1e-9), 1U);
}

}  // namespace
}  // namespace plumb::tests
