// Which files that are handed in hold a picture of a scene, and what of them is left out.
#include "references/diagnosis/handed_in.hpp"

#include <gtest/gtest.h>

#include "references/comparison/shape_mismatch.hpp"

namespace plumb::tests {
namespace {

PixelRows picture(const std::vector<std::string>& channels, float last = 1) {
  ImageFile file{2, 1, static_cast<int>(channels.size()), Sample::float32, {}, {}};
  file.values.assign(2 * channels.size(), 0.5F);
  file.values.back() = file.values[channels.size() - 1] = last;
  file.contents.channels = channels;
  return rows_of(std::move(file));
}

TEST(HandedIn, ColoursAndGreyArePictures) {
  for (const std::vector<std::string>& channels : {std::vector<std::string>{"R", "G", "B"},
                                                   {"R", "G", "B", "A"},
                                                   {"LeR", "LeG", "LeB"},
                                                   {"Y"},
                                                   {"Y", "A"}}) {
    EXPECT_EQ(diagnosis::complaint_about_contents(picture(channels)), std::nullopt) << channels[0];
    EXPECT_EQ(diagnosis::not_looked_at(picture(channels)), "") << channels[0];
  }
}

TEST(HandedIn, OtherChannelsAreNoColours) {
  EXPECT_EQ(diagnosis::complaint_about_contents(picture({"X", "Y", "Z"})),
            "found the channels X Y Z, expected R G B, or Y for grey");
  for (const std::vector<std::string>& channels :
       {std::vector<std::string>{"Z"}, {"A"}, {"G"}, {"id"}, {"R", "G"}, {"A", "Y"}})
    EXPECT_NE(diagnosis::complaint_about_contents(picture(channels)), std::nullopt) << channels[0];
}

TEST(HandedIn, WhatIsBesideTheColoursIsSaid) {
  EXPECT_EQ(diagnosis::not_looked_at(picture({"R", "G", "B", "A"}, 0.5F)), "channel A");
  EXPECT_EQ(diagnosis::not_looked_at(picture({"R", "G", "B", "Z"})), "channel Z");
  PixelRows parts = picture({"R", "G", "B"});
  parts.contents.not_read.emplace_back("page 1 of 2");
  EXPECT_EQ(diagnosis::not_looked_at(parts), "page 1 of 2");
}

TEST(HandedIn, APartOfAPictureIsNone) {
  PixelRows rows = picture({"R", "G", "B"});
  rows.contents.window = rows.contents.display = Window{3, 4, 2, 1};
  EXPECT_EQ(diagnosis::complaint_about_contents(rows), std::nullopt);
  rows.contents.window = Window{4, 4, 2, 1};
  const std::string complaint = diagnosis::complaint_about_contents(rows).value_or("");
  EXPECT_TRUE(complaint.starts_with("found a data window of 2 x 1 pixels at (4, 4) in a display window"))
      << complaint;
}

TEST(HandedIn, WholeNumbersOf32BitsHaveNoWhite) {
  PixelRows rows = picture({"R", "G", "B"});
  rows.contents.are_whole = {false, true, false};
  EXPECT_NE(diagnosis::complaint_about_contents(rows), std::nullopt);
}

TEST(ShapeMismatch, AdviceCanBeFollowed) {
  const PixelRows rgb = picture({"R", "G", "B"});
  const std::string none = comparison::shape_mismatch(rgb, picture({"X", "Y", "Z"})).value_or("");
  EXPECT_EQ(none.find("--channels"), std::string::npos) << none;
  EXPECT_NE(none.find("no name is in both"), std::string::npos) << none;
  const std::string some = comparison::shape_mismatch(rgb, picture({"R", "G", "Z"})).value_or("");
  EXPECT_NE(some.find("that both have (--channels)"), std::string::npos) << some;
}

}  // namespace
}  // namespace plumb::tests
