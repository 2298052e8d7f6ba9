// `plumb compare DIR DIR` and patterns: pairs by name, and what is in none.
#include <nlohmann/json.hpp>

#include "tests/support/end_to_end.hpp"
#include "tracer/image/io.hpp"

namespace plumb::tests {
namespace {

using Json = nlohmann::json;

class CompareSeveral : public testing::Test {
 protected:
  /// A picture of 2 x 1 pixels, the second of this grey of 255.
  void picture(const std::string& name, int grey) const {
    std::filesystem::create_directories(std::filesystem::path(workplace_.path(name)).parent_path());
    Image image(2, 1);
    for (int c = 0; c < 3; ++c) image.pixel(1, 0)[c] = static_cast<float>(grey) / 255;
    write_image(workplace_.path(name), image, default_encoding(name));
  }
  Outcome compare(const std::string& reference, const std::string& test,
                  std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"compare", reference, test});
    return run_plumb(more, workplace_.directory());
  }
  /// The status of each pair, e.g. "a agree, b differ".
  std::string statuses(const std::string& reference, const std::string& test, int exit_code) const {
    const Outcome outcome = compare(reference, test, {"--json", "-"});
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.out << outcome.err;
    const Json json = Json::parse(outcome.out, nullptr, false);
    if (!json.is_object()) return outcome.err;
    std::string text;
    for (const Json& pair : json.at("pairs"))
      text += (text.empty() ? "" : ", ") + pair.at("name").get<std::string>() + " " +
              pair.at("status").get<std::string>();
    return text;
  }

  Workplace workplace_;
};

TEST_F(CompareSeveral, PairsAreThoseOfEqualNames) {
  for (const char* const side : {"ref", "mine"}) {
    picture(std::string(side) + "/b.pfm", 10);
    picture(std::string(side) + "/a.pfm", 20);
    picture(std::string(side) + "/deep/er/a.pfm", 30);
  }
  const Outcome outcome = compare("ref", "mine");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_EQ(outcome.out,
            "image                      size      error     over  result\n"
            "a                           2x1          0        0  agree\n"
            "b                           2x1          0        0  agree\n"
            "deep/er/a                   2x1          0        0  agree\n"
            "3 pairs: 3 agree, 0 differ, 0 in trouble\n");
}

TEST_F(CompareSeveral, TheExitCodeIsThatOfTheWorst) {
  picture("ref/a.pfm", 10);
  picture("mine/a.pfm", 10);
  EXPECT_EQ(statuses("ref", "mine", 0), "a agree");
  picture("ref/b.pfm", 10);
  picture("mine/b.pfm", 11);
  EXPECT_EQ(statuses("ref", "mine", 1), "a agree, b differ");
  workplace_.file("ref/c.pfm", "no picture");
  picture("mine/c.pfm", 1);
  EXPECT_EQ(statuses("ref", "mine", 2), "a agree, b differ, c error");
  picture("ref/d.pfm", 1);
  picture("mine/d.pfm", 1);
  EXPECT_EQ(statuses("ref", "mine", 2), "a agree, b differ, c error, d agree") << "the others go on";
  const Outcome outcome = compare("ref/", "./mine/");
  EXPECT_TRUE(contains(outcome.out, "1 of 2 pixels are over; worst pixel (1, 0)")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "ref/c.pfm")) << outcome.out;
  EXPECT_TRUE(outcome.out.ends_with("4 pairs: 2 agree, 1 differ, 1 in trouble\n")) << outcome.out;
}

TEST_F(CompareSeveral, WhatIsMissingOrSurplusIsTroubleAndNamed) {
  picture("ref/a.pfm", 1);
  picture("mine/a.pfm", 1);
  picture("ref/sub/gone.pfm", 1);
  EXPECT_EQ(statuses("ref", "mine", 2), "a agree, sub/gone error");
  const Outcome missing = compare("ref", "mine");
  EXPECT_TRUE(contains(missing.out, "mine: found no image 'sub/gone', expected one beside ref/sub/gone.pfm"))
      << missing.out;
  picture("mine/sub/gone.pfm", 1);
  EXPECT_EQ(statuses("ref", "mine", 0), "a agree, sub/gone agree");
  picture("mine/new.pfm", 1);
  const Outcome surplus = compare("ref", "mine");
  EXPECT_EQ(surplus.exit_code, 2);
  EXPECT_TRUE(contains(surplus.out, "mine/new.pfm: found no reference 'new' in ref")) << surplus.out;
}

TEST_F(CompareSeveral, AnotherExtensionPairsWhereEachSideHasOne) {
  picture("ref/a.pfm", 255);
  picture("mine/a.png", 255);
  picture("ref/b.pfm", 255);
  picture("ref/b.png", 255);
  picture("mine/b.pfm", 255);
  picture("mine/b.png", 255);
  EXPECT_EQ(statuses("ref", "mine", 0), "a agree, b.pfm agree, b.png agree");
  picture("mine/a.exr", 255);
  EXPECT_EQ(statuses("ref", "mine", 2), "a error, b.pfm agree, b.png agree");
  EXPECT_TRUE(contains(compare("ref", "mine").out, "a: found a.pfm in ref and a.exr, a.png in mine"));
  picture("mine/a.pfm", 255);
  EXPECT_EQ(statuses("ref", "mine", 2), "a.pfm agree, a.exr error, a.png error, b.pfm agree, b.png agree");
}

TEST_F(CompareSeveral, PatternsPairBelowTheirFirstWildcard) {
  for (const char* const name : {"ref/a.pfm", "ref/b.pfm", "ref/note.png", "mine/x/a.pfm", "mine/x/b.pfm"})
    picture(name, 3);
  EXPECT_EQ(statuses("ref/*.pfm", "mine/x/*", 0), "a agree, b agree");
  EXPECT_EQ(statuses("ref/[ab].pfm", "mine/x", 0), "a agree, b agree");
  EXPECT_EQ(statuses("ref/?.pfm", "mine/x/a*", 2), "a agree, b error");
  expect_trouble(compare("ref/*.exr", "mine/*"), {"ref/*.exr", "no file", "pattern"});
}

TEST_F(CompareSeveral, NothingToCompareIsTrouble) {
  std::filesystem::create_directories(workplace_.path("empty"));
  picture("ref/a.pfm", 3);
  expect_trouble(compare("empty", "ref"), {"empty", "no image"});
  expect_trouble(compare("ref", "empty"), {"empty", "no image"});
  expect_trouble(compare("empty", "empty"), {"empty", "no image"});
  expect_trouble(compare("ref", "ref/a.pfm"), {"ref", "is a directory"});
  expect_trouble(compare("ref", "gone"), {"gone"});
}

TEST_F(CompareSeveral, WhatIsNoImageByItsNameIsSaid) {
  picture("ref/a.pfm", 3);
  picture("mine/a.pfm", 3);
  workplace_.file("mine/notes.txt", "");
  workplace_.file("mine/.notes", "");
  const Outcome outcome = compare("ref", "mine");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_TRUE(contains(outcome.out, "mine/notes.txt")) << outcome.out;
  EXPECT_FALSE(contains(outcome.out, ".notes")) << outcome.out;
}

TEST_F(CompareSeveral, JunitHasACaseForEachPair) {
  picture("ref/a.pfm", 1);
  picture("mine/a.pfm", 1);
  picture("ref/b.pfm", 1);
  picture("mine/b.pfm", 2);
  picture("ref/c.pfm", 1);
  EXPECT_EQ(compare("ref", "mine", {"--junit", "j.xml"}).exit_code, 2);
  const std::string xml = read_file(workplace_.path("j.xml"));
  EXPECT_TRUE(contains(xml, "tests=\"3\" failures=\"1\" errors=\"1\"")) << xml;
  EXPECT_TRUE(contains(xml, "<testcase name=\"c\" classname=\"mine against ref\"")) << xml;
  EXPECT_EQ(compare("gone*", "mine", {"--junit", "j.xml"}).exit_code, 2);
  EXPECT_TRUE(contains(read_file(workplace_.path("j.xml")), "no file that this pattern matches"));
}

TEST_F(CompareSeveral, OneReportShowsAllPairs) {
  picture("ref/a.pfm", 1);
  picture("mine/a.pfm", 1);
  picture("ref/b.pfm", 1);
  picture("mine/b.pfm", 2);
  picture("mine/c.pfm", 2);
  const Outcome outcome = compare("ref", "mine", {"--report", "out"});
  EXPECT_TRUE(outcome.out.ends_with("report: out/index.html\n")) << outcome.out << outcome.err;
  const std::string page = read_file(workplace_.path("out/index.html"));
  const std::string open = "id=\"report-data\">";
  const std::size_t begin = page.find(open) + open.size();
  const Json scenes = Json::parse(page.substr(begin, page.find("</script>", begin) - begin)).at("scenes");
  ASSERT_EQ(scenes.size(), 3U);
  EXPECT_EQ(scenes[0].at("result").at("status"), "agree");
  EXPECT_EQ(scenes[1].at("result").at("status"), "differ");
  EXPECT_EQ(scenes[2].at("result").at("status"), "error");
  EXPECT_EQ(scenes[2].at("name"), "c");
}

// --- bounds.json ----------------------------------------------------------------------------------

TEST_F(CompareSeveral, BoundsOfSinglePicturesLieBesideTheReferences) {
  for (const char* const name : {"a", "b", "c"}) {
    picture(std::string("ref/") + name + ".pfm", 100);
    picture(std::string("mine/") + name + ".pfm", 110);
  }
  Image mask(2, 1);
  mask.pixel(1, 0)[0] = 1;
  write_image(workplace_.path("ref/mask.png"), mask, Encoding::srgb);
  workplace_.file(
      "ref/bounds.json",
      R"({"a": {"allow_over": 1, "because": "noise"}, "b": {"ignore": "mask.png", "because": "a clock"}})");
  EXPECT_EQ(statuses("ref", "mine", 1), "a agree, b agree, c differ") << "the mask is no picture to compare";
  const Outcome outcome = compare("ref", "mine");
  EXPECT_TRUE(contains(outcome.out, "agree within the bounds")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "because noise")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "1 pixel ignored, not compared: mask.png; because a clock"))
      << outcome.out;
  const Json json = Json::parse(compare("ref", "mine", {"--json", "-"}).out);
  EXPECT_EQ(json.at("pairs").at(0).at("bounds").at("because"), "noise");
  EXPECT_FALSE(json.at("pairs").at(2).contains("bounds"));
}

TEST_F(CompareSeveral, BoundsWithoutAReasonOrAPictureAreTrouble) {
  picture("ref/a.pfm", 1);
  picture("mine/a.pfm", 1);
  workplace_.file("ref/bounds.json", R"({"a": {"allow_over": 1}})");
  expect_trouble(compare("ref", "mine"), {"ref/bounds.json", "'a'", "because"});
  workplace_.file("ref/bounds.json", R"({"A": {"allow_over": 1, "because": "noise"}})");
  expect_trouble(compare("ref", "mine"), {"ref/bounds.json", "'A'"});
}

// --- the differences as images --------------------------------------------------------------------

TEST_F(CompareSeveral, DifferencesLieInADirectoryOfTheirOwn) {
  picture("ref/a.pfm", 1);
  picture("mine/a.pfm", 1);
  picture("ref/sub/b.pfm", 0);
  picture("mine/sub/b.pfm", 51);
  EXPECT_EQ(compare("ref", "mine", {"--diff", "differences"}).exit_code, 1);
  const ImageFile written = read_image(workplace_.path("differences/sub/b.exr"));
  EXPECT_EQ(written.values, (std::vector<float>{0, 0, 0, 0.2F, 0.2F, 0.2F}));
  EXPECT_TRUE(std::filesystem::exists(workplace_.path("differences/a.exr")));
}

TEST_F(CompareSeveral, DifferencesAreNoInputsOfTheNextRun) {
  picture("ref/a.exr", 1);
  picture("mine/a.exr", 2);
  const std::string before = read_file(workplace_.path("ref/a.exr"));
  for (const char* const place : {"ref", "mine/", "./ref/differences", "mine/x/.."})
    expect_trouble(compare("ref", "mine", {"--diff", place}), {"--diff", place, "among the inputs"});
  EXPECT_EQ(read_file(workplace_.path("ref/a.exr")), before);
  EXPECT_EQ(listing(workplace_.directory()),
            (std::vector<std::string>{"mine", "mine/a.exr", "ref", "ref/a.exr"}));
}

TEST_F(CompareSeveral, TwoOutputsAreNeverOneFile) {
  for (const char* const side : {"ref", "mine"}) picture(std::string(side) + "/a.pfm", 20);
  expect_trouble(compare("ref", "mine", {"--json", "same", "--junit", "./same"}), {"names, too"});
  EXPECT_FALSE(std::filesystem::exists(workplace_.path("same")));
}

TEST_F(CompareSeveral, ALinkToItselfIsNoImage) {
  for (const char* const side : {"ref", "mine"}) picture(std::string(side) + "/a.pfm", 20);
  std::filesystem::create_symlink("loop", workplace_.path("mine/loop"));
  const Outcome outcome = compare("ref", "mine");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "mine/loop")) << outcome.out;
}

TEST_F(CompareSeveral, MetricsAreToldOfEachPair) {
  for (const char* const side : {"ref", "mine"}) picture(std::string(side) + "/a.pfm", 20);
  const Outcome outcome = compare("ref", "mine", {"--metrics"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* const part :
       {"agree\n      peak ", "\n      PSNR         none: nothing differs", "SSIM", "FLIP"})
    EXPECT_TRUE(contains(outcome.out, part)) << outcome.out;
}

TEST_F(CompareSeveral, APatternThatWouldMatchLessThanItSaysIsRefused) {
  picture("ref/deep/er/a.pfm", 20);
  expect_trouble(compare("ref/**/*.pfm", "ref/**/*.pfm"), {"found **", "a directory"});
}

TEST_F(CompareSeveral, HiddenImagesAreSaidToBeLeftOut) {
  for (const char* const side : {"ref", "mine"}) {
    picture(std::string(side) + "/a.pfm", 20);
    picture(std::string(side) + "/.b.pfm", 20);
  }
  const Outcome outcome = compare("ref", "mine");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "not compared")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "ref/.b.pfm, mine/.b.pfm")) << outcome.out;
}

}  // namespace
}  // namespace plumb::tests
