// Random scenes with every feature, against POV-Ray.
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <utility>

#include "references/verify.hpp"
#include "tests/support/random_scene.hpp"
#include "tests/support/run.hpp"
#include "tracer/scene/writer.hpp"

namespace plumb::tests {
namespace {

using references::SceneResult;
using references::Status;

/// PLUMB_RANDOM_SCENES sets how many; scripts/test --long asks for more.
unsigned wanted_scenes() {
  constexpr unsigned in_a_short_run = 60;
  const char* const wanted = std::getenv("PLUMB_RANDOM_SCENES");
  return wanted == nullptr ? in_a_short_run : static_cast<unsigned>(std::strtoul(wanted, nullptr, 10));
}

TEST(RandomScenes, AgreeWithPovrayOnEveryPixel) {
  const Workplace workplace;
  setenv("PLUMB_CACHE", workplace.path(".cache").c_str(), 1);
  using OptionsKey = std::pair<int, GlassShadow>;
  std::map<OptionsKey, std::vector<std::string>> scenes;
  for (unsigned seed = 1; seed <= wanted_scenes(); ++seed) {
    const RandomScene random = random_scene(seed);
    scenes[{random.options.depth, random.options.glass_shadow}].push_back(
        workplace.file(std::to_string(seed) + ".sdf", write_scene(random.scene)));
  }
  std::size_t agreed = 0;
  for (const auto& [options, paths] : scenes) {
    references::VerifyOptions verify;
    // 1e-5, not 1e-6: glass seen through glass magnifies the rounding of POV-Ray's float32 colours and eta.
    verify.tolerance = 1e-5;
    verify.render.depth = options.first;
    verify.render.glass_shadow = options.second;
    const auto report = references::verify(paths, verify, {});
    ASSERT_TRUE(report.notice.empty()) << report.notice;
    for (const SceneResult& result : report.scenes) {
      EXPECT_EQ(result.status, Status::agree)
          << result.scene << " depth " << options.first << ": " << result.comparison.pixels_over << " pixels over, "
          << result.message << "\n"
          << read_file(result.scene);
      agreed += result.status == Status::agree ? 1 : 0;
    }
  }
  EXPECT_EQ(agreed, wanted_scenes());
}

}  // namespace
}  // namespace plumb::tests
