// A sample of the campaign of damaged pictures, which tests/fuzz/mutated_pictures runs a million of.
#include "tests/support/end_to_end.hpp"

namespace plumb::tests {
namespace {

TEST(MutatedPictures, EachGetsAVerdictAndNoneCrashes) {
  const Workplace place;
  const auto told = run_shell("/usr/bin/python3 -B '" + source_path("tests/fuzz/mutated_pictures") +
                                  "' --plumb \"$0\" --count 40 --batch 40 --seed 7 --keep kept",
                              place.directory());
  EXPECT_EQ(told.exit_code, 0) << told.output;
  EXPECT_TRUE(contains(told.output, "40 of 40 pictures have a verdict, 0 failures")) << told.output;
}

}  // namespace
}  // namespace plumb::tests
