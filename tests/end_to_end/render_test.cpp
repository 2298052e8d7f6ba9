// The commands as a user runs them.
#include "tests/support/run.hpp"

#include <gtest/gtest.h>

namespace plumb::tests {
namespace {

TEST(Program, TellsItsVersion) {
  const Workplace workplace;
  const Outcome outcome = run_plumb({"--version"}, workplace.directory());
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out, "plumb " PLUMB_VERSION "\n");
}

}  // namespace
}  // namespace plumb::tests
