// `plumb stability` finds again where methods are known to fail.
#include <nlohmann/json.hpp>

#include "tests/support/end_to_end.hpp"

namespace plumb::tests {
namespace {

using Json = nlohmann::json;

class Stability : public testing::Test {
 protected:
  Json sweep(const std::string& condition) const {
    const Outcome outcome =
        run_plumb({"stability", "--quick", "--condition", condition, "--json", "-"}, workplace_.directory());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(Json::accept(outcome.out)) << outcome.out;
    return Json::parse(outcome.out, nullptr, false)["conditions"][0];
  }
  static Json row(const Json& condition, const std::string& method, const std::string& real) {
    for (const Json& row : condition["rows"]) {
      if (row["method"] == method && row["real"] == real) return row;
    }
    ADD_FAILURE() << method << " " << real;
    return {};
  }

  Workplace workplace_;
};

TEST_F(Stability, TheNaiveQuadraticMissesFarSpheresInFloat) {
  const Json distance = sweep("distance");
  // because float has 24 bits: squares of 4096 radii hide one radius
  const double missed = row(distance, "sphere-naive", "float")["breaks"]["missed"];
  EXPECT_GT(missed, 100);
  EXPECT_LT(missed, 4096);
  const double in_double = row(distance, "sphere-naive", "double")["breaks"]["missed"];
  EXPECT_GT(in_double, 1e4 * missed);
  for (const Json& each : distance["rows"]) {
    EXPECT_FALSE(each["cause"].get<std::string>().empty()) << each;
    EXPECT_FALSE(each["remedy"].get<std::string>().empty()) << each;
  }
}

TEST_F(Stability, AnInterruptedRunResumesWithTheSameRows) { EXPECT_EQ(sweep("grazing"), sweep("grazing")); }

TEST_F(Stability, AnUnknownConditionIsNamed) {
  const Outcome outcome = run_plumb({"stability", "--condition", "weather"}, workplace_.directory());
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(contains(outcome.err, "weather") && contains(outcome.err, "grazing")) << outcome.err;
}

}  // namespace
}  // namespace plumb::tests
