// What a report concludes of a result: never more than the figures say.
#include "references/report/conclusion.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace plumb::tests {
namespace {

using Json = nlohmann::ordered_json;
using report::conclusion_of;

Json result(const char* status, std::size_t over, std::size_t unexplained) {
  return {{"status", status}, {"width", 20},
          {"height", 16},     {"pixels_over", over},
          {"non_finite", 0},  {"budget", {{"silhouette", over - unexplained}, {"unexplained", unexplained}}},
          {"unverified", 0}};
}

TEST(Conclusion, NamesAProofOnlyWhereThereIsOne) {
  EXPECT_EQ(conclusion_of(result("agree", 0, 0)), "Yours is right: no pixel is over the tolerance.");
  EXPECT_EQ(conclusion_of(result("agree", 4, 0)),
            "Yours is right: each of the 4 pixels over the tolerance is explained by a proof.");
  EXPECT_EQ(conclusion_of(result("agree", 320, 320)),
            "Yours is right: 320 pixels are over the tolerance, as the bounds allow.");
}

TEST(Conclusion, SaysWhatIsUnverified) {
  Json json = result("agree", 4, 0);
  json["unverified"] = 4;
  EXPECT_EQ(conclusion_of(json),
            "Yours is right: each of the 4 pixels over the tolerance is explained by a proof, 4 of them "
            "unverified.");
  json["status"] = "differ";
  EXPECT_EQ(conclusion_of(json),
            "Yours differs: 4 of 320 pixels are over the tolerance, 4 of them unverified.");
}

TEST(Conclusion, CountsOnlyWhatWasCompared) {
  Json json = result("differ", 24, 24);
  json["bounds"] = {{"pixels_compared", 25}, {"pixels_ignored", 295}};
  EXPECT_EQ(conclusion_of(json),
            "Yours differs: 24 of 25 pixels that were compared are over the tolerance, 24 of them "
            "unexplained.");
  json = result("agree", 0, 0);
  json["bounds"] = {{"pixels_compared", 25}, {"pixels_ignored", 295}};
  EXPECT_EQ(conclusion_of(json),
            "Yours is right: no pixel is over the tolerance, of the 25 that were compared.");
}

}  // namespace
}  // namespace plumb::tests
