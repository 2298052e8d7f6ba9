// A mapped file that somebody else cuts short while it is looked at.
#include "tracer/system/mapped_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/run.hpp"
#include "tracer/system/cleanup.hpp"

namespace plumb::tests {
namespace {

constexpr std::size_t some_pages = 100'000;

void look_at_a_cut_file(const Workplace& place) {
  const RemovedOnSignal removed(place.path("plumb-half-written"));
  const MappedFile file(place.path("picture"));
  std::filesystem::resize_file(place.path("picture"), 10);
  const volatile char last = file.bytes().back();
  static_cast<void>(last);
}

TEST(MappedFileDeathTest, CutShortItIsTroubleAndNothingIsLeft) {
  testing::FLAGS_gtest_death_test_style = "fast";
  const Workplace place;
  place.file("picture", std::string(some_pages, 'x'));
  place.file("plumb-half-written", "");
  EXPECT_EXIT(look_at_a_cut_file(place), testing::ExitedWithCode(2), "cut short by somebody else");
  EXPECT_FALSE(std::filesystem::exists(place.path("plumb-half-written")));
}

}  // namespace
}  // namespace plumb::tests
