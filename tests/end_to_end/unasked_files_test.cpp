// Files whose names plumb chooses, and what the head of an export says.
#include "references/system/digest.hpp"
#include "tests/support/end_to_end.hpp"

namespace plumb::tests {
namespace {

namespace fs = std::filesystem;

class Unasked : public testing::TestWithParam<Word> {
 protected:
  Unasked() { workplace_.file("s.sdf", replaced(ball_scene, "out.ppm", name())); }
  static std::string name() { return std::string("out.") + GetParam().text; }
  Outcome render(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"render", "s.sdf"});
    return run_plumb(more, workplace_.directory());
  }
  std::string bytes() const { return read_file(workplace_.path(name())); }

  Workplace workplace_;
};
INSTANTIATE_TEST_SUITE_P(As, Unasked, testing::Values(Word{"ppm"}, Word{"pfm"}, Word{"png"}, Word{"exr"}),
                         [](const auto& test) { return std::string(test.param.text); });

TEST_P(Unasked, APictureOfSomebodyElseStays) {
  for (const std::string& theirs : {std::string("theirs"), std::string()}) {
    workplace_.file(name(), theirs);
    expect_trouble(render(), {name(), "-o"});
    EXPECT_EQ(bytes(), theirs);
    EXPECT_EQ(listing(workplace_.directory()), (std::vector<std::string>{name(), "s.sdf"}));
  }
  EXPECT_EQ(render({"-o", name()}).exit_code, 0) << "asked for, it is replaced";
  EXPECT_GT(bytes().size(), 100U);
}

TEST_P(Unasked, PlumbsOwnIsReplacedAndNamed) {
  const Outcome first = render();
  EXPECT_EQ(first.exit_code, 0) << first.err;
  EXPECT_EQ(first.out, name() + "\n");
  const std::string before = bytes();
  workplace_.file("s.sdf", replaced(replaced(ball_scene, "out.ppm", name()), "0 0 -3", "0 0.1 -3"));
  EXPECT_EQ(render().exit_code, 0);
  EXPECT_TRUE(bytes() != before);
  EXPECT_EQ(listing(workplace_.directory()), (std::vector<std::string>{name(), "s.sdf"}));
}

TEST_P(Unasked, PlumbsOwnThatWasChangedSinceStays) {
  ASSERT_EQ(render().exit_code, 0);
  std::string changed = bytes();
  changed.back() = static_cast<char>(changed.back() ^ 1);
  workplace_.file(name(), changed);
  expect_trouble(render(), {name(), "-o"});
  EXPECT_TRUE(bytes() == changed);
}

TEST_P(Unasked, LinksAndDirectoriesStay) {
  workplace_.file("far", "theirs");
  fs::create_symlink("far", workplace_.path(name()));
  expect_trouble(render(), {name(), "-o"});
  EXPECT_EQ(read_file(workplace_.path("far")), "theirs");
  fs::remove(workplace_.path(name()));
  fs::create_symlink("nowhere", workplace_.path(name()));
  expect_trouble(render(), {name(), "-o"});
  fs::remove(workplace_.path(name()));
  fs::create_directory(workplace_.path(name()));
  expect_trouble(render(), {name(), "-o"});
}

TEST_P(Unasked, WhatComesWhileItIsRenderedStays) {
  const auto result = run_shell(
      "\"$0\" render s.sdf --size 3000x3000 & for i in $(seq 1000); do ls -d .plumb-* 2>/dev/null && break; "
      "sleep 0.01; done; echo theirs > " +
          name() + "; wait $!; echo code $?",
      workplace_.directory());
  EXPECT_TRUE(contains(result.output, "code 2")) << result.output;
  EXPECT_EQ(bytes(), "theirs\n");
}

// --- the head of an export ------------------------------------------------------------------------

class ExportHead : public testing::Test {
 protected:
  std::string first_line(std::vector<std::string> more) const {
    more.insert(more.begin(), "export");
    const Outcome outcome = run_plumb(more, workplace_.directory());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const bool is_file = fs::exists(workplace_.path("x y.pov"));
    const std::string text = is_file ? read_file(workplace_.path("x y.pov")) : outcome.out;
    return text.substr(0, text.find('\n'));
  }
  Workplace workplace_;
};

TEST_F(ExportHead, IsTheCommandThatRendersIt) {
  workplace_.file("ball.sdf", std::string(ball_scene));
  EXPECT_EQ(first_line({"ball.sdf"}),
            "// povray +Iball.pov +Oball.png +W32 +H24 +FN16 -D -A File_Gamma=1.0 +WT2 -GD -GR");
  const std::string line = first_line({"ball.sdf", "-o", "x y.pov", "--size", "8x6"});
  EXPECT_TRUE(line.starts_with("// povray '+I\"x y.pov\"' '+O\"x y.png\"' +W8 +H6 ")) << line;
  const auto result = run_shell(line.substr(3), workplace_.directory());
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_TRUE(fs::exists(workplace_.path("x y.png"))) << result.output;
}

TEST_F(ExportHead, NamesOfFilesDoNotEndTheComment) {
  workplace_.file("a\nb.sdf", std::string(ball_scene));
  EXPECT_TRUE(first_line({"a\nb.sdf"}).ends_with(" -GR"));
}

/// The stored reference images are found by the text without it.
TEST_F(ExportHead, IsNotPartOfWhatStoredReferencesAreKeptFor) {
  const std::string provenance = read_file(source_path("references/images/provenance.json"));
  const auto result =
      run_shell("\"$0\" export " + source_path("tests/scenes/phong.sdf") + " | tail -n +2 | sha256sum",
                workplace_.directory());
  EXPECT_TRUE(contains(provenance, result.output.substr(0, result.output.find(' ')))) << result.output;
}

/// What a command reads, and what would be written over it: option, file, and the rest of the command.
struct Overwriting {
  std::string option, file;
  std::vector<std::string> command;
};

TEST(OwnInputs, AreNeverOverwritten) {
  const Workplace place;
  place.file("s.sdf", std::string(ball_scene));
  place.file("other.sdf", std::string(ball_scene));
  fs::create_directories(place.path("scenes/baselines"));
  place.file("scenes/baselines/baselines.json", "{}");
  place.file("scenes/s.sdf", std::string(ball_scene));
  for (const char* const picture : {"a.pfm", "b.pfm"})
    ASSERT_EQ(run_plumb({"render", "s.sdf", "-o", picture}, place.directory()).exit_code, 0);
  const std::vector<Overwriting> all{
      {"-o", "s.sdf", {"export", "s.sdf"}},
      {"--json", "b.pfm", {"compare", "a.pfm", "b.pfm"}},
      {"--junit", "a.pfm", {"compare", "a.pfm", "b.pfm"}},
      {"--diff", "a.pfm", {"compare", "a.pfm", "b.pfm"}},
      {"--json", "./s.sdf", {"diagnose", "s.sdf", "a.pfm"}},
      {"--json", "s.sdf", {"verify", "s.sdf"}},
      {"--json", "other.sdf", {"lint", "s.sdf"}},
      {"--stats-json", "s.sdf", {"render", "s.sdf", "-o", "c.pfm"}},
      {"--svg", "s.sdf", {"chart", "s.sdf"}},
      {"--csv", "a.pfm", {"judge", "--images", ".", "--scenes", "scenes"}},
      {"--json", "scenes/s.sdf", {"regress", "scenes"}},
      {"--junit", "scenes/baselines/baselines.json", {"regress", "scenes"}},
  };
  for (const Overwriting& one : all) {
    const std::string before = read_file(place.path(one.file));
    std::vector<std::string> words = one.command;
    words.insert(words.end(), {one.option, one.file});
    SCOPED_TRACE(one.command.front() + " " + one.option);
    expect_trouble(run_plumb(words, place.directory()), {one.option.substr(1), one.file, "input"});
    EXPECT_EQ(read_file(place.path(one.file)), before);
  }
  EXPECT_EQ(run_plumb({"export", "s.sdf", "-o", "new.pov"}, place.directory()).exit_code, 0);
  EXPECT_EQ(run_plumb({"export", "s.sdf", "-o", "new.pov"}, place.directory()).exit_code, 0);
  EXPECT_EQ(run_plumb({"lint", "s.sdf", "--json", "new.json"}, place.directory()).exit_code, 0);
  EXPECT_EQ(run_plumb({"lint", "s.sdf", "--json", "new.json"}, place.directory()).exit_code, 0);
}

}  // namespace
}  // namespace plumb::tests
