// `plumb compare --report`: the page is written whatever the outcome, and says what it does not show.
#include <nlohmann/json.hpp>

#include "tests/support/end_to_end.hpp"

namespace plumb::tests {
namespace {

using Json = nlohmann::json;

class CompareReport : public testing::Test {
 protected:
  Outcome compare(const std::string& reference, const std::string& test, const std::string& directory) const {
    return run_plumb({"compare", reference, test, "--report", directory}, workplace_.directory());
  }
  /// The only scene of the page.
  Json scene(const std::string& directory) const {
    const std::string page = read_file(workplace_.path(directory + "/index.html"));
    const std::string open = "id=\"report-data\">";
    const std::size_t begin = page.find(open) + open.size();
    return Json::parse(page.substr(begin, page.find("</script>", begin) - begin)).at("scenes").at(0);
  }

  Workplace workplace_;
};

TEST_F(CompareReport, SaysWhatTheCommandSays) {
  workplace_.file("a.ppm", "P3 2 1 255 0 0 0  255 255 255\n");
  workplace_.file("b.ppm", "P3 2 1 255 0 0 0  255 0 255\n");
  const Outcome outcome = compare("a.ppm", "b.ppm", "new/folder");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_TRUE(outcome.out.ends_with("differ\nreport: new/folder/index.html\n")) << outcome.out;
  const Json found = scene("new/folder");
  EXPECT_EQ(found.at("name"), "b.ppm");
  EXPECT_EQ(found.at("width"), 2);
  EXPECT_EQ(found.at("result").at("status"), "differ");
  EXPECT_EQ(found.at("result").at("pixels_over"), 1);
  EXPECT_EQ(found.at("result").at("worst").at("x"), 1);
  EXPECT_EQ(found.at("causes"), Json::array({"over"}));
  EXPECT_FALSE(found.at("result").contains("not_compared")) << "on a page that is why there are no figures";
  EXPECT_EQ(compare("a.ppm", "a.ppm", "same").exit_code, 0);
  EXPECT_EQ(scene("same").at("causes"), Json::array());
}

TEST_F(CompareReport, ThePlaceIsNotSaidAmongJson) {
  workplace_.file("a.ppm", "P3 1 1 255 0 0 0\n");
  const Outcome outcome =
      run_plumb({"compare", "a.ppm", "a.ppm", "--report", "out/", "--json", "-"}, workplace_.directory());
  EXPECT_TRUE(Json::accept(outcome.out)) << outcome.out;
  EXPECT_TRUE(contains(compare("a.ppm", "a.ppm", "out/").out, "\nreport: out/index.html\n"));
}

TEST_F(CompareReport, GreyIsShownAndSaid) {
  const std::string white{0, 0, '\x80', '\x3f'};
  workplace_.file("grey.pfm", "Pf\n1 1\n-1.0\n" + white);
  const Outcome outcome = compare("grey.pfm", "grey.pfm", "out");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "shown as grey")) << outcome.err;
  EXPECT_TRUE(contains(scene("out").at("result").at("message"), "shown as grey"));
}

TEST_F(CompareReport, APlaceThatIsNoDirectoryIsNamed) {
  workplace_.file("a.ppm", "P3 1 1 255 0 0 0\n");
  workplace_.file("plain", "");
  expect_trouble(compare("a.ppm", "a.ppm", "plain"), {"plain: cannot be made a directory"});
  EXPECT_EQ(read_file(workplace_.path("plain")), "");
}

}  // namespace
}  // namespace plumb::tests
