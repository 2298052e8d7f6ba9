// What killed runs leave is removed later, and nothing else; what runs at once keeps each other's results.
#include <sys/stat.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/end_to_end.hpp"
#include "tracer/system/leftovers.hpp"

namespace plumb::tests {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class Leftovers : public testing::Test {
 protected:
  Leftovers() {
    fs::create_directories(workplace_.path("scenes"));
    fs::create_directories(workplace_.path("tmp"));
    workplace_.file("scenes/ball.sdf", std::string(ball_scene));
  }
  system::ProcessResult shell(const std::string& command) const {
    return run_shell("TMPDIR=$PWD/tmp; export TMPDIR; " + command, workplace_.directory());
  }
  /// Kills the run, with all it started, as soon as something stands in `place`, and says what.
  std::vector<std::string> kill_when_there(const std::string& arguments, const std::string& place) const {
    const auto result =
        shell("setsid \"$0\" " + arguments + " >/dev/null 2>&1 & for i in $(seq 1000); do ls -d " + place +
              " 2>/dev/null && break; sleep 0.01; done; kill -9 -$!; wait $!");
    return {result.output};
  }
  std::vector<std::string> temporary_names() const {
    std::vector<std::string> found;
    for (const std::string& name : listing(workplace_.directory()))
      if (contains(name, "plumb-")) found.push_back(name);
    return found;
  }

  Workplace workplace_;
};

TEST_F(Leftovers, OfAnUpdateAreRemovedByTheNext) {
  kill_when_there("regress scenes --update ball --because x --size 4000x4000", "scenes/.plumb-*");
  ASSERT_FALSE(temporary_names().empty());
  EXPECT_EQ(shell("\"$0\" regress scenes --update ball --because x").exit_code, 0);
  EXPECT_TRUE(temporary_names().empty()) << temporary_names().front();
}

TEST_F(Leftovers, OfAPictureAreRemovedByTheNext) {
  kill_when_there("render scenes/ball.sdf -o scenes/x.pfm --size 9000x9000", "scenes/.plumb-*");
  ASSERT_FALSE(temporary_names().empty());
  EXPECT_EQ(shell("\"$0\" render scenes/ball.sdf -o scenes/x.pfm").exit_code, 0);
  EXPECT_TRUE(temporary_names().empty()) << temporary_names().front();
}

/// Any start removes what lies where temporary files do.
TEST_F(Leftovers, OfAReferenceRendererAreRemovedByAnyStart) {
  fs::permissions(workplace_.file("povray", "#!/bin/sh\nsleep 60\n"), fs::perms(0755));
  shell(
      "PATH=$PWD:$PATH; setsid \"$0\" verify scenes/ball.sdf >/dev/null 2>&1 & for i in $(seq 500); do ls -d "
      "tmp/plumb-* 2>/dev/null && break; sleep 0.02; done; kill -9 -$!; wait $!");
  ASSERT_FALSE(temporary_names().empty());
  EXPECT_EQ(shell("\"$0\" lint scenes/ball.sdf").exit_code, 0);
  EXPECT_TRUE(temporary_names().empty()) << temporary_names().front();
}

TEST_F(Leftovers, OfARunThatGoesOnStay) {
  const auto result = shell(
      "\"$0\" render scenes/ball.sdf -o scenes/x.pfm --size 6000x6000 & for i in $(seq 1000); do ls -d "
      "scenes/.plumb-* 2>/dev/null && break; sleep 0.01; done; \"$0\" render scenes/ball.sdf -o "
      "scenes/y.pfm; "
      "wait $! && ls scenes");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_TRUE(fs::exists(workplace_.path("scenes/x.pfm"))) << result.output;
}

/// Names that are not whole, or of other kinds of files, are somebody's own.
TEST_F(Leftovers, OfOthersStay) {
  const std::string own = temporary_name();
  const std::string space = own.substr(0, own.find('-', 6) + 1);
  const std::string gone = space + "999999999-1-";
  for (const std::string& name :
       {std::string("plumb-"), std::string("plumb-notes"), std::string(".plumb-1234"), gone, gone + "a.ppm",
        gone + "a b", "x" + gone + "a", own + "mine"})
    workplace_.file("tmp/" + name, "");
  ASSERT_EQ(mkfifo(workplace_.path("tmp/" + gone + "pipe").c_str(), 0600), 0);
  fs::create_symlink("../scenes", workplace_.path("tmp/" + gone + "link"));
  fs::create_directories(workplace_.path("tmp/" + gone + "empty/x"));
  const auto before = listing(workplace_.directory());
  EXPECT_EQ(shell("\"$0\" lint scenes/ball.sdf").exit_code, 0);
  const auto after = listing(workplace_.directory());
  EXPECT_EQ(after.size() + 2, before.size()) << "the empty directory alone goes, with what it holds";
  EXPECT_FALSE(fs::exists(workplace_.path("tmp/" + gone + "empty")));
  EXPECT_TRUE(fs::exists(workplace_.path("scenes/ball.sdf")));
}

TEST_F(Leftovers, OfAnotherUserStay) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can make files of another user";
  const std::string own = temporary_name();
  const std::string name = "tmp/" + own.substr(0, own.find('-', 6) + 1) + "999999999-1-a";
  ASSERT_EQ(chown(workplace_.file(name, "").c_str(), 12345, 12345), 0);
  EXPECT_EQ(shell("\"$0\" lint scenes/ball.sdf").exit_code, 0);
  EXPECT_TRUE(fs::exists(workplace_.path(name)));
}

// --- stored references ----------------------------------------------------------------------------

TEST_F(Leftovers, UpdatesOfReferencesAtTheSameTimeKeepEachOthersRecords) {
  constexpr int updates = 8;
  std::string commands = "PLUMB_REFERENCES=$PWD/stored; export PLUMB_REFERENCES; ";
  for (int i = 0; i < updates; ++i) {
    const std::string name = "s" + std::to_string(i) + ".sdf";
    workplace_.file(name, std::string(ball_scene));
    commands += "\"$0\" references --update " + name + " & ";
  }
  const auto result = shell(commands + "wait");
  const Json records = Json::parse(read_file(workplace_.path("stored/provenance.json")));
  EXPECT_EQ(records.size(), static_cast<std::size_t>(updates)) << result.output;
}

// --- a reference renderer that does not end -------------------------------------------------------

/// A pipe where a file is expected would be waited for without an end.
TEST_F(Leftovers, PipesInPlaceOfPovraysFilesAreNotWaitedFor) {
  fs::permissions(
      workplace_.file(
          "povray",
          "#!/bin/sh\ncase \"$1\" in --version) echo POV-Ray 3.7.0; exit 0 ;; esac\nrm -f out.png "
          "t.state output.txt; mkfifo out.png t.state output.txt; exit 0\n"),
      fs::perms(0755));
  const auto result = shell("PATH=$PWD:$PATH timeout 20 \"$0\" verify scenes/ball.sdf");
  EXPECT_EQ(result.exit_code, 2) << result.output;
  EXPECT_TRUE(contains(result.output, "no regular file")) << result.output;
}

/// What it leaves running keeps its standard output open.
TEST_F(Leftovers, AGrandchildThatHoldsTheOutputIsNotWaitedFor) {
  fs::permissions(workplace_.file("povray",
                                  "#!/bin/sh\ncase \"$1\" in --version) echo POV-Ray 3.7.0; exit 0 ;; esac\n"
                                  "setsid sleep 30 & exit 1\n"),
                  fs::perms(0755));
  const auto result = shell("PATH=$PWD:$PATH timeout 20 \"$0\" verify scenes/ball.sdf");
  EXPECT_EQ(result.exit_code, 2) << result.output;
}

}  // namespace
}  // namespace plumb::tests
