// The fault catalogue: every fault can be seen, and none of them is there when none is asked for.
#include "references/faults/fault.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "tests/support/run.hpp"
#include "tracer/format/reader.hpp"

namespace plumb::tests {
namespace {

Scene scene_of(const std::string& file) {
  return read_scene(read_file(tests::source_path("tests/scenes/" + file))).scene;
}

textbook::RenderJob small_job() {
  textbook::RenderJob job;
  job.width = 80;
  job.height = 60;
  return job;
}

Image rendered(const std::string& file, const std::vector<const faults::Fault*>& faults) {
  const Scene scene = scene_of(file);
  return faults::render_with(scene, scene.camera(scene.renders.front().camera), small_job(), faults);
}

/// How many components differ by more than 1e-4, or are not finite.
long changed(const Image& right, const Image& wrong) {
  long count = 0;
  for (std::size_t i = 0; i < right.rgb.size(); ++i)
    count += std::abs(double{right.rgb[i]} - double{wrong.rgb[i]}) <= 1e-4 ? 0 : 1;
  return count;
}

const faults::Fault* fault(const std::string& id) {
  const faults::Fault* found = faults::find_fault(id);
  EXPECT_NE(found, nullptr) << id;
  return found;
}

TEST(Faults, IdsAreUniqueAndPlain) {
  std::set<std::string_view> ids;
  for (const faults::Fault& f : faults::fault_catalogue()) {
    EXPECT_TRUE(ids.insert(f.id).second) << f.id;
    EXPECT_TRUE(std::all_of(f.id.begin(), f.id.end(), [](char c) {
      return c == '-' || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    })) << f.id;
    EXPECT_EQ(faults::find_fault(f.id), &f);
  }
  EXPECT_EQ(faults::find_fault("no-such-fault"), nullptr);
}

TEST(Faults, EveryEntryOfTheCatalogueIsThere) {
  std::set<int> entries;
  for (const faults::Fault& f : faults::fault_catalogue()) entries.insert(f.catalogue);
  for (int entry = 1; entry <= 37; ++entry) EXPECT_EQ(entries.count(entry), 1U) << entry;
  for (const int entry : {38, 39, 42, 43, 44}) EXPECT_EQ(entries.count(entry), 1U) << entry;
  std::set<int> of_families;
  for (const faults::Fault& f : faults::geometry_families()) of_families.insert(f.catalogue);
  EXPECT_EQ(of_families.count(40), 1U);
  EXPECT_GE(faults::fault_catalogue().size(), 45U);
}

TEST(Faults, EveryFaultSaysWhatItIs) {
  for (const faults::Fault& f : faults::fault_catalogue()) {
    for (const std::string_view text : {f.slide, f.explanation, f.wrong, f.right, f.how_common, f.shown_by})
      EXPECT_FALSE(text.empty()) << f.id;
    EXPECT_TRUE(f.explanation.ends_with(".")) << f.id;
    EXPECT_NE(f.wrong, f.right) << f.id;
    EXPECT_NE(f.apply != nullptr, f.after != nullptr) << f.id << " is one change, before or after the render";
  }
}

TEST(Faults, EveryMemberOfAFamilySaysWhatItIsAndIsSeen) {
  std::set<std::string> members;
  for (const auto* family : {&faults::geometry_families(), &faults::shading_families()}) {
    for (const faults::Fault& f : *family) {
      const std::string name = std::string(f.id) + " " + std::to_string(f.value);
      EXPECT_TRUE(members.insert(name).second) << name;
      EXPECT_TRUE(f.explanation.ends_with(".")) << name;
      EXPECT_NE(f.wrong, f.right) << name;
      EXPECT_NE(f.apply != nullptr, f.after != nullptr) << name;
      const Image right = rendered(std::string{f.shown_by}, {});
      const Image wrong = rendered(std::string{f.shown_by}, {&f});
      const bool is_the_scenes_own = right.rgb == wrong.rgb;
      EXPECT_TRUE(!is_the_scenes_own || !std::isnan(f.value)) << name << " in " << f.shown_by;
    }
  }
}

TEST(Faults, ALightForEachObjectIsHiddenByThatObjectAlone) {
  const std::string shadow = "shadow.sdf";
  const Scene scene = scene_of(shadow);
  const Image right = rendered(shadow, {}), each = rendered(shadow, {fault("light-once-per-object")});
  const Image open = rendered(shadow, {fault("shadows-missing")});
  const double objects = static_cast<double>(scene.roots().size());
  ASSERT_GT(objects, 1);
  const Image unlit = rendered(shadow, {fault("diffuse-missing"), fault("specular-missing")});
  std::size_t lit = 0, hidden = 0;
  for (std::size_t i = 0; i < right.rgb.size(); ++i) {
    const double ambient = unlit.rgb[i];
    const double light = double{open.rgb[i]} - ambient;
    if (light < 1e-3) continue;
    const bool is_lit = std::abs(double{right.rgb[i]} - double{open.rgb[i]}) < 1e-6;
    const double times = (double{each.rgb[i]} - ambient) / light;
    EXPECT_NEAR(times, std::round(times), 1e-3);
    EXPECT_EQ(std::lround(times) == std::lround(objects), is_lit);
    EXPECT_LE(std::lround(times), std::lround(objects));
    (is_lit ? lit : hidden) += 1;
  }
  EXPECT_GT(lit, 100U);
  EXPECT_GT(hidden, 20U);
}

TEST(Faults, EveryFaultIsSeenInTheSceneThatItNames) {
  for (const faults::Fault& f : faults::fault_catalogue()) {
    const std::string scene{f.shown_by};
    EXPECT_GT(changed(rendered(scene, {}), rendered(scene, {&f})), 0) << f.id << " in " << scene;
  }
}

TEST(Faults, NoFaultsGiveTheRenderBitForBit) {
  for (const auto& entry : std::filesystem::directory_iterator(tests::source_path("tests/scenes"))) {
    if (entry.path().extension() != ".sdf") continue;
    const std::string file = entry.path().filename().string();
    const Scene scene = scene_of(file);
    const Image right = textbook::render(scene, scene.camera(scene.renders.front().camera), small_job());
    EXPECT_EQ(rendered(file, {}).rgb, right.rgb) << file;
  }
}

TEST(Faults, FaultsLeaveNothingBehind) {
  const std::vector<const faults::Fault*> with_state{
      fault("depth-counter-shared"), fault("one-blocker-darkens-all"), fault("specular-toward-light")};
  const std::string scene = "combined-everything.sdf";
  const Image before = rendered(scene, {});
  const Image wrong = rendered(scene, with_state);
  EXPECT_EQ(rendered(scene, with_state).rgb, wrong.rgb);
  EXPECT_EQ(rendered(scene, {}).rgb, before.rgb);
}

TEST(Faults, PixelCornerAndAspectGoTogetherInAnyOrder) {
  const std::string scene = "camera-model.sdf";
  const Image both = rendered(scene, {fault("pixel-corner"), fault("aspect-ignored")});
  EXPECT_EQ(both.rgb, rendered(scene, {fault("aspect-ignored"), fault("pixel-corner")}).rgb);
  EXPECT_GT(changed(both, rendered(scene, {fault("aspect-ignored")})), 0);
  EXPECT_GT(changed(both, rendered(scene, {fault("pixel-corner")})), 0);
}

TEST(Faults, ExchangesAreUndoneByThemselves) {
  const std::string scene = "prototype-401.sdf";
  for (const char* id : {"upside-down", "left-right-swapped", "red-blue-exchanged"})
    EXPECT_EQ(rendered(scene, {fault(id), fault(id)}).rgb, rendered(scene, {}).rgb) << id;
}

}  // namespace
}  // namespace plumb::tests
