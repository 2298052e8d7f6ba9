// The scenes of the engine's benchmark (tests/bench/engine) are what it says they are.
#include "tests/support/end_to_end.hpp"
#include "tracer/format/reader.hpp"
#include "tracer/scene/hierarchy.hpp"

namespace plumb::tests {
namespace {

void make_scene(const std::string& name, const Workplace& to) {
  const auto made = run_shell(
      "python3 -B '" + source_path("tests/bench/engine/make-scenes") + "' --scenes " + name, to.directory());
  ASSERT_EQ(made.exit_code, 0) << made.output;
}

std::uint64_t instances(const Scene& scene) {
  std::uint64_t count = 0;
  const auto below = count_instances(scene);
  for (const ShapeId root : scene.roots()) count += below[root];
  return count;
}

TEST(EngineBench, ScenesHoldTheObjectsThatTheirNamesSay) {
  const Workplace place;
  const std::vector<std::pair<std::string, std::uint64_t>> expected{{"lecture", 10},
                                                                    {"room", 10},
                                                                    {"random-10", 10},
                                                                    {"random-1000", 1000},
                                                                    {"instances-10x1000", 10'000},
                                                                    {"sphereflake-91", 92},  // and the floor
                                                                    {"sphereflake-7381", 7382}};
  for (const auto& [name, count] : expected) {
    make_scene(name, place);
    std::string warnings;
    const Scene scene =
        load_scene(place.path(name + ".sdf"), {}, [&](const std::string& line) { warnings += line; });
    EXPECT_EQ(instances(scene), count) << name;
    EXPECT_EQ(warnings, "") << name;
    EXPECT_EQ(scene.renders.front().width, 640) << name;
  }
}

TEST(EngineBench, ScenesAreTheSameEveryTime) {
  const Workplace one, other;
  for (const Workplace* place : {&one, &other}) make_scene("random-100", *place);
  EXPECT_EQ(read_file(one.path("random-100.sdf")), read_file(other.path("random-100.sdf")));
}

}  // namespace
}  // namespace plumb::tests
