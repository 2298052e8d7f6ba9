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

TEST_F(Stability, OtherRenderersAreSweptToo) {
  const Json flattening = sweep("flattening");
  for (const char* method : {"povray", "povray-rescaled"}) {
    const Json each = row(flattening, method, "double");
    EXPECT_EQ(each["status"], "measured");
    EXPECT_EQ(each["measures"], "pixels");
    EXPECT_TRUE(each["breaks"]["e6"].is_number()) << each["breaks"];
    EXPECT_EQ(each["wrong"].size(), each["curve"].size());
  }
  const Json embree = row(flattening, "embree", "float");
  EXPECT_EQ(embree["measures"], "t");
  const double missed = embree["breaks"]["missed"];
  EXPECT_GT(missed, 1e5);  // because a float has 24 bits for a plate of 2^-24 of its width
  EXPECT_LT(missed, 1e8);
}

TEST_F(Stability, AMissingRendererIsNamedInItsRows) {
  const Outcome outcome = run_plumb({"stability", "--quick", "--condition", "gap", "--json", "-"},
                                    workplace_.directory(), {"PATH=" + workplace_.path("nowhere")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json gap = Json::parse(outcome.out)["conditions"][0];
  const Json missing = row(gap, "povray", "double");
  EXPECT_EQ(missing["status"], "renderer unavailable");
  EXPECT_TRUE(contains(missing["cause"], "apt-get install povray")) << missing["cause"];
  EXPECT_EQ(row(gap, "lecture", "double")["status"], "measured");
}

TEST_F(Stability, ThePageShowsEachFailure) {
  const Outcome outcome = run_plumb({"stability", "--quick", "--condition", "flattening", "--report", "page"},
                                    workplace_.directory());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string page = read_file(workplace_.path("page/stability.html"));
  EXPECT_TRUE(contains(page, "<img alt=\"difference of lecture at ")) << page.substr(0, 2000);
  EXPECT_TRUE(contains(page, "the object&#39;s own space"));
}

TEST_F(Stability, AnUnknownConditionIsNamed) {
  const Outcome outcome = run_plumb({"stability", "--condition", "weather"}, workplace_.directory());
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(contains(outcome.err, "weather") && contains(outcome.err, "grazing")) << outcome.err;
}

}  // namespace
}  // namespace plumb::tests
