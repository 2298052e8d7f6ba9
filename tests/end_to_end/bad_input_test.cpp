// Input that is wrong, huge or hostile: a clear error, exit code 2, nothing half-written. And what looks
// wrong but is right.
#include <sys/stat.h>
#include <unistd.h>

#include <sstream>

#include "tests/support/end_to_end.hpp"

namespace plumb::tests {
namespace {

constexpr int nesting_far_too_deep = 100'000;
constexpr int longest_line = 1'000'000;

/// Lines after those of ball_scene.
std::string with(const std::string& lines) { return std::string(ball_scene) + lines; }

std::string with_radius(const std::string& radius) {
  return replaced(ball_scene, "-3 1 red", "-3 " + radius + " red");
}

std::string many(char c) { return std::string(longest_line, c); }

/// Composites one in the other; the parent in the line after its child, or before it.
std::string nested(int depth, bool parents_first = false) {
  std::string text(ball_scene);
  for (int i = 0; i < depth; ++i) {
    const int child = parents_first ? i + 1 : i - 1;
    const bool has_composite = child >= 0 && child < depth;
    text += "define shape composite c" + std::to_string(i) + " " +
            (has_composite ? "c" + std::to_string(child) : "ball") + "\n";
  }
  return text;
}

struct BadScene {
  std::string name;
  std::string (*text)();
  std::string place;               ///< LINE:COLUMN
  std::vector<std::string> words;  ///< of the message
};
void PrintTo(const BadScene& scene, std::ostream* out) { *out << scene.name; }

const std::vector<BadScene>& bad_scenes() {
  static const std::vector<BadScene> scenes{
      {"Empty", [] { return std::string(); }, "1:1", {"empty", "expected a scene"}},
      {"OnlyComments", [] { return std::string("\n# nothing\n\n"); }, "1:1", {"no statement"}},
      {"Binary",
       [] {
         return std::string(
             "\x7f"
             "ELF\x02\x01\x01\0\0\0\0\0\xff\xfe",
             14);
       },
       "1:8",
       {"zero byte", "binary file"}},
      {"BinaryWithoutZeros",
       [] { return std::string("\x89PNG\r\n\x1a\n\xff\xfe\x80"); },
       "1:1",
       {"'\\x89PNG'", "expected a statement"}},
      {"AWordOfAMillionCharacters", [] { return with(many('x')); }, "8:1", {"'xxxx", "expected a statement"}},
      {"ANameOfAMillionCharacters",
       [] { return with("define shape sphere " + many('n') + " 0 0 0 0 red\n"); },
       "8:21",
       {"radius", "'nnnn"}},
      {"ANumberOfAMillionDigits",
       [] { return with("ambient 0 0 1" + many('0')); },
       "8:13",
       {"'1000", "number"}},
      {"ALineOfHalfAMillionNumbers",
       [] {
         std::string line = "ambient";
         for (int i = 0; i < longest_line / 2; ++i) line += " 1";
         return with(line);
       },
       "8:1",
       {"500000 numbers", "3: r g b"}},
      {"ACycleOfNamesOfAMillionCharacters",
       [] {
         return with("define shape composite " + many('n') + " a\ndefine shape composite a " + many('n'));
       },
       "8:24",
       {"contains itself"}},
      {"AHundredThousandNestedComposites",
       [] { return nested(nesting_far_too_deep); },
       "100007:24",
       {"nested 100000 deep", "at most 1000"}},
      {"AHundredThousandNestedCompositesParentsFirst",
       [] { return nested(nesting_far_too_deep, true); },
       "8:24",
       {"nested 100000 deep", "at most 1000"}},
      {"NestedOneTooDeep", [] { return nested(1001); }, "1008:24", {"nested 1001 deep", "at most 1000"}},
      {"MoreInstancesThanAtoms",
       [] {
         std::string text = with("define shape composite c0 ball ball\n");
         for (int i = 1; i < 300; ++i) {
           const std::string child = " c" + std::to_string(i - 1);
           text += "define shape composite c" + std::to_string(i) + child + child + "\n";
         }
         return text;
       },
       "307:24",
       {"more than 4000000000 spheres, boxes and composites"}},
      {"CompositeInItself",
       [] { return with("define shape composite a a\n"); },
       "8:24",
       {"contains itself", "'a' > 'a'"}},
      {"CompositeCycle",
       [] {
         return with(
             "define shape composite a b\ndefine shape composite b c ball\ndefine shape composite c a\n");
       },
       "8:24",
       {"contains itself", "'a' > 'b' > 'c' > 'a'"}},
      {"Nan", [] { return with_radius("nan"); }, "2:33", {"'nan'", "not finite"}},
      {"MinusNan", [] { return with_radius("-NaN"); }, "2:33", {"'-NaN'", "not finite"}},
      {"NanWithPayload", [] { return with_radius("nan(7)"); }, "2:33", {"'nan(7)'", "number"}},
      {"Infinity", [] { return with_radius("inf"); }, "2:33", {"'inf'", "not finite"}},
      {"MinusInfinity", [] { return with_radius("-Infinity"); }, "2:33", {"'-Infinity'", "not finite"}},
      {"TooLarge", [] { return with_radius("1e999"); }, "2:33", {"'1e999'", "range of a double"}},
      {"TooSmall", [] { return with_radius("1e-999"); }, "2:33", {"'1e-999'", "range of a double"}},
      {"NanColour", [] { return with("ambient 0 nan 0\n"); }, "8:11", {"'nan'", "not finite"}},
      {"InfiniteTransform",
       [] { return with("transform ball translate 0 inf 0\n"); },
       "8:28",
       {"'inf'", "not finite"}},
      {"TransformThatOverflows",
       [] {
         return with(
             "transform ball scale 1e99\ntransform ball scale 1e99\ntransform ball scale 1e99\ntransform "
             "ball scale 1e99\n");
       },
       "2:21",
       {"'ball'", "overflows"}},
      {"DecimalComma", [] { return with_radius("1,5"); }, "2:33", {"'1,5'", "decimal point"}},
      {"ZeroRadius", [] { return with_radius("0"); }, "2:21", {"radius", "'ball'", "> 0"}},
      {"MinusZeroRadius", [] { return with_radius("-0.0"); }, "2:21", {"radius", "'ball'", "> 0"}},
      {"NegativeRadius",
       [] { return with_radius("-1"); },
       "2:21",
       {"radius -1", "'ball'", "minus sign", "loose"}},
      {"ZeroScale", [] { return with("transform ball scale 0\n"); }, "8:16", {"'scale'", "factor of 0"}},
      {"ZeroScaleOfOneAxis",
       [] { return with("transform ball scale 1 0 1\n"); },
       "8:16",
       {"'scale'", "factor of 0"}},
      {"ZeroAxis", [] { return with("transform ball rotate 30 0 0 0\n"); }, "8:16", {"'rotate'", "axis"}},
      {"DuplicateShape",
       [] { return with("define shape box ball 0 0 0 1 1 1 red\n"); },
       "8:18",
       {"'ball'", "shape", "line 2", "rename"}},
      {"DuplicateMaterial",
       [] { return with("define material red 1 1 1 1 1 1 1 1 1 1\n"); },
       "8:17",
       {"'red'", "material", "line 1", "rename"}},
      {"DuplicateLight",
       [] { return with("define light key 0 0 0 1 1 1 1\n"); },
       "8:14",
       {"'key'", "light", "line 3", "rename"}},
      {"DuplicateCamera",
       [] { return with("define camera eye 50\n"); },
       "8:15",
       {"'eye'", "camera", "line 6", "rename"}},
      {"UndefinedChild",
       [] { return with("define shape composite c bal\n"); },
       "8:26",
       {"'bal'", "did you mean 'ball'?"}},
      {"UndefinedChildLikeNothing",
       [] { return with("define shape composite c ball elephant\n"); },
       "8:31",
       {"'elephant'", "shape that is defined"}},
      {"UndefinedMaterial",
       [] { return with("define shape sphere b 0 0 0 1 rde\n"); },
       "8:31",
       {"'rde'", "did you mean 'red'?"}},
      {"UndefinedTarget",
       [] { return with("transform ghost scale 2\n"); },
       "8:11",
       {"'ghost'", "shape or camera that is defined"}},
      {"UndefinedCamera",
       [] { return replaced(ball_scene, "render eye", "render eyes"); },
       "7:8",
       {"'eyes'", "'eye'"}},
      {"SizeOfABillionSquared",
       [] { return replaced(ball_scene, "32 24", "1000000000 1000000000"); },
       "7:20",
       {"'1000000000'", "65535"}},
      {"SizeWithTooManyPixels",
       [] { return replaced(ball_scene, "32 24", "60000 60000"); },
       "7:20",
       {"268435456 pixels"}},
      {"SizeZero",
       [] { return replaced(ball_scene, "32 24", "0 24"); },
       "7:20",
       {"'0'", "whole number of pixels"}},
      {"SizeNegative",
       [] { return replaced(ball_scene, "32 24", "32 -24"); },
       "7:23",
       {"'-24'", "whole number"}},
      {"SizeWithAFraction",
       [] { return replaced(ball_scene, "32 24", "32 24.5"); },
       "7:23",
       {"'24.5'", "whole"}},
      {"UnknownStatement", [] { return with("teapot 1\n"); }, "8:1", {"'teapot'", "expected a statement"}},
      {"UnknownShape",
       [] { return with("define shape cone c 1 2\n"); },
       "8:14",
       {"'cone'", "the lecture has no cone"}},
      {"FileNameWithBlanks",
       [] { return replaced(ball_scene, "out.ppm", "image . ppm"); },
       "7:12",
       {"image.ppm", "loose"}},
      {"DirectionOfLengthZero",
       [] { return replaced(ball_scene, "0 0 -1", "0 0 0"); },
       "6:15",
       {"'eye'", "direction of 0 0 0"}},
  };
  return scenes;
}

class BadInput : public testing::TestWithParam<BadScene> {
 protected:
  void SetUp() override {
    workplace_.file("bad.sdf", GetParam().text());
    for (const char* const name : {"image.pfm", "out.ppm", "scene.pov", "result.json"}) {
      workplace_.file(name, "old");
    }
    before_ = listing(workplace_.directory());
  }
  void TearDown() override {
    EXPECT_EQ(listing(workplace_.directory()), before_);
    for (const char* const name : {"image.pfm", "out.ppm", "scene.pov"}) {
      EXPECT_EQ(read_file(workplace_.path(name)), "old") << name;
    }
  }
  Outcome run(const std::vector<std::string>& arguments) const {
    return run_plumb(arguments, workplace_.directory());
  }
  static void expect_the_error(const std::string& said) {
    const BadScene& scene = GetParam();
    const std::string place = "bad.sdf:" + scene.place + ": error: ";
    expect_own_words(said, {place});
    const std::string line = said.substr(std::min(said.find(place), said.size()));
    expect_own_words(line.substr(0, line.find('\n')), scene.words);
    EXPECT_LT(said.size(), 5000U) << "a message, not the file";
  }

  Workplace workplace_;
  std::vector<std::string> before_;
};
INSTANTIATE_TEST_SUITE_P(Every, BadInput, testing::ValuesIn(bad_scenes()),
                         [](const auto& test) { return test.param.name; });

TEST_P(BadInput, IsAClearErrorOfRender) {
  const Outcome outcome = run({"render", "bad.sdf", "-o", "image.pfm"});
  EXPECT_EQ(outcome.exit_code, 2);
  expect_the_error(outcome.err);
  EXPECT_EQ(outcome.out, "");
}

TEST_P(BadInput, IsAClearErrorOfRenderToTheNameInTheScene) {
  EXPECT_EQ(run({"render", "bad.sdf"}).exit_code, 2);
}

TEST_P(BadInput, IsAClearErrorOfExport) {
  const Outcome outcome = run({"export", "bad.sdf", "-o", "scene.pov"});
  EXPECT_EQ(outcome.exit_code, 2);
  expect_the_error(outcome.err);
  EXPECT_EQ(outcome.out, "");
}

TEST_P(BadInput, IsAClearErrorOfVerify) {
  const Outcome outcome = run({"verify", "--stored", "bad.sdf"});  // it never comes to the renderer
  EXPECT_EQ(outcome.exit_code, 2);
  expect_the_error(outcome.out);
}

TEST_P(BadInput, IsAClearErrorOfLint) {
  const Outcome outcome = run({"lint", "bad.sdf"});
  EXPECT_EQ(outcome.exit_code, 2);
  expect_the_error(outcome.out);
}

// --- files that are none ------------------------------------------------------------------------

class NoScene : public testing::TestWithParam<Word> {
 protected:
  Outcome run(const std::string& path) const {
    return run_plumb({GetParam().text, path}, workplace_.directory());
  }
  void expect_trouble_of(const std::string& path, const std::vector<std::string>& parts) const {
    const auto before = listing(workplace_.directory());
    const Outcome outcome = run(path);
    EXPECT_EQ(outcome.exit_code, 2);
    expect_own_words(outcome.out + outcome.err, parts);
    EXPECT_EQ(listing(workplace_.directory()), before);
  }

  Workplace workplace_;
};
INSTANTIATE_TEST_SUITE_P(For, NoScene,
                         testing::Values(Word{"render"}, Word{"export"}, Word{"verify"}, Word{"lint"}),
                         [](const auto& test) { return std::string(test.param.text); });

TEST_P(NoScene, AMissingFileIsNamed) { expect_trouble_of("missing.sdf", {"missing.sdf", "No such file"}); }

TEST_P(NoScene, ADirectoryIsNamed) {
  std::filesystem::create_directory(workplace_.path("scenes.sdf"));
  expect_trouble_of("scenes.sdf", {"scenes.sdf", "is a directory"});
  expect_trouble_of(".", {"is a directory"});
}

TEST_P(NoScene, AnEmptyNameIsTrouble) { expect_trouble_of("", {"cannot be read"}); }

TEST_P(NoScene, APathThroughAFileIsNamed) {
  workplace_.file("ball.sdf", std::string(ball_scene));
  expect_trouble_of("ball.sdf/scene.sdf", {"ball.sdf/scene.sdf", "cannot be read"});
}

TEST_P(NoScene, ALoopOfLinksIsNamed) {
  std::filesystem::create_symlink("loop.sdf", workplace_.path("loop.sdf"));
  expect_trouble_of("loop.sdf", {"loop.sdf", "cannot be read"});
}

TEST_P(NoScene, AFileThatMayNotBeReadIsNamed) {
  if (geteuid() == 0) GTEST_SKIP() << "root may read everything";
  workplace_.file("secret.sdf", std::string(ball_scene));
  ASSERT_EQ(chmod(workplace_.path("secret.sdf").c_str(), 0), 0);
  expect_trouble_of("secret.sdf", {"secret.sdf", "Permission denied"});
}

TEST_P(NoScene, TheNullDeviceIsEmpty) { expect_trouble_of("/dev/null", {"/dev/null:1:1", "empty"}); }

TEST_P(NoScene, AHoleOfATerabyteIsTooLarge) {
  workplace_.file("hole.sdf", "");
  std::error_code error;
  std::filesystem::resize_file(workplace_.path("hole.sdf"), std::uintmax_t{1} << 40U, error);
  if (error) GTEST_SKIP() << "this file system has no sparse files of that size: " << error.message();
  expect_trouble_of("hole.sdf", {"hole.sdf", "larger than 1 GiB"});
}

TEST(EndlessFile, IsTooLarge) {
  const Workplace workplace;
  expect_trouble(run_plumb({"export", "/dev/zero"}, workplace.directory()),
                 {"/dev/zero", "larger than 1 GiB"});
  expect_trouble(run_plumb({"compare", "/dev/zero", "/dev/zero"}, workplace.directory()),
                 {"/dev/zero", "a device that does not end"});
}

// --- options ------------------------------------------------------------------------------------

class HugeSize : public testing::TestWithParam<Word> {};
INSTANTIATE_TEST_SUITE_P(For, HugeSize, testing::Values(Word{"render"}, Word{"export"}, Word{"verify"}),
                         [](const auto& test) { return std::string(test.param.text); });

TEST_P(HugeSize, IsRefused) {
  const Workplace workplace;
  workplace.file("ball.sdf", std::string(ball_scene));
  const auto before = listing(workplace.directory());
  for (const char* const size : {"1000000000x1000000000", "65535x65535", "99999999999999999999x1"}) {
    expect_trouble(run_plumb({GetParam().text, "ball.sdf", "--size", size}, workplace.directory()),
                   {"--size", size});
  }
  EXPECT_EQ(listing(workplace.directory()), before);
}

// --- many findings ------------------------------------------------------------------------------

TEST(ManyFindings, RenderShowsTheFirstAndPointsToLint) {
  const Workplace workplace;
  std::string text(ball_scene);
  for (int i = 0; i < 100; ++i) text += "teapot\n";
  workplace.file("bad.sdf", text);
  const Outcome outcome = run_plumb({"render", "bad.sdf"}, workplace.directory());
  expect_trouble(outcome, {"bad.sdf:8:1: error: ", "95 more", "plumb lint bad.sdf"});
  EXPECT_FALSE(contains(outcome.err, "bad.sdf:100:1"));
}

/// A name is compared with every other to find the one that was meant; there may be many.
TEST(ManyFindings, ThousandsOfUndefinedNamesAreReportedSoon) {
  const Workplace workplace;
  std::string text(ball_scene);
  for (int i = 0; i < 4000; ++i) {
    const std::string n = std::to_string(i);
    text += "define material m" + n + " 0 0 0 0 0 0 0 0 0 1\n";
    text += "define shape sphere s" + n + " 0 0 -3 1 material_" + n + "\n";
  }
  workplace.file("bad.sdf", text);
  const auto result = run_shell("ulimit -t 100; exec \"$0\" lint bad.sdf | tail -n 1", workplace.directory());
  EXPECT_TRUE(contains(result.output, "4000 errors")) << result.output;
}

TEST(ManyFindings, ARenderLineThatIsWrongIsNotCalledMissing) {
  const Workplace workplace;
  workplace.file("bad.sdf", replaced(ball_scene, "32 24", "0 24"));
  const Outcome outcome = run_plumb({"lint", "bad.sdf"}, workplace.directory());
  EXPECT_FALSE(contains(outcome.out, "no render")) << outcome.out;
}

/// What a terminal would take for a command is shown as \xNN.
TEST(ManyFindings, NoControlCharacterReachesTheTerminal) {
  const std::string name = "a\x1b[31m\x07";
  const std::vector<std::string> scenes{
      with(name + "\n"),
      with("define shape composite " + name + " b\ndefine shape composite b " + name + "\n"),
      with("define shape composite b " + name + "\n"),
      with("define shape sphere " + name + " 0 0 0 1 red\ntransform " + name + " scale 1e300\ntransform " +
           name + " scale 1e300\n"),
      with("define camera " + name + " 50 0 0 0 0 0 0 0 1 0\n"),
      replaced(ball_scene, "out.ppm", name + ".jpg"),
      replaced(ball_scene, "render eye", "render " + name)};
  for (const std::string& scene : scenes) {
    const Workplace workplace;
    workplace.file("bad.sdf", scene);
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"render"}, {"lint"}, {"verify", "--stored"}}) {
      std::vector<std::string> arguments = command;
      arguments.emplace_back("bad.sdf");
      const Outcome outcome = run_plumb(arguments, workplace.directory());
      const std::string said = outcome.out + outcome.err;
      EXPECT_EQ(said.find_first_of("\x1b\x07"), std::string::npos) << command.front() << ": " << said;
    }
  }
}

// --- a disk that fills up -------------------------------------------------------------------------

class FullDisk : public testing::Test {
 protected:
  void SetUp() override {
    workplace_.file("ball.sdf", std::string(ball_scene));
    workplace_.file("a.pfm", "PF\n1 1\n-1\n" + std::string(12, '\0'));
  }
  void TearDown() override {
    struct stat info {};
    ASSERT_EQ(stat("/dev/full", &info), 0);
    EXPECT_TRUE(S_ISCHR(info.st_mode)) << "/dev/full is no device any more";
  }
  system::ProcessResult shell(const std::string& command) const {
    return run_shell(command, workplace_.directory());
  }

  Workplace workplace_;
};

TEST_F(FullDisk, ImagesAreNotWritten) {
  for (const char* const name : {"full.ppm", "full.pfm", "full.png", "full.exr"}) {
    std::filesystem::create_symlink("/dev/full", workplace_.path(name));
    SCOPED_TRACE(name);
    expect_trouble(run_plumb({"render", "ball.sdf", "-o", name}, workplace_.directory()),
                   {name, "cannot be written"});
    EXPECT_TRUE(std::filesystem::is_symlink(workplace_.path(name)));
  }
  EXPECT_EQ(listing(workplace_.directory()),
            (std::vector<std::string>{"a.pfm", "ball.sdf", "full.exr", "full.pfm", "full.png", "full.ppm"}));
}

TEST_F(FullDisk, AnExportIsNotWritten) {
  expect_trouble(run_plumb({"export", "ball.sdf", "-o", "/dev/full"}, workplace_.directory()),
                 {"/dev/full", "No space left"});
}

TEST_F(FullDisk, ResultsAreNotWritten) {
  const std::vector<std::vector<std::string>> commands{
      {"verify", "ball.sdf", "--size", "8x8", "--json", "/dev/full"},
      {"lint", "ball.sdf", "--json", "/dev/full"},
      {"compare", "a.pfm", "a.pfm", "--json", "/dev/full"}};
  for (const auto& command : commands) {
    expect_trouble(run_plumb(command, workplace_.directory()), {"/dev/full", "No space left"});
  }
}

class FullStandardOutput : public FullDisk, public testing::WithParamInterface<Word> {};
INSTANTIATE_TEST_SUITE_P(Of, FullStandardOutput,
                         testing::Values(Word{"render ball.sdf -o -"}, Word{"render ball.sdf"},
                                         Word{"export ball.sdf"}, Word{"lint ball.sdf"},
                                         Word{"lint ball.sdf --json -"}, Word{"compare a.pfm a.pfm"},
                                         Word{"compare a.pfm a.pfm --json -"},
                                         Word{"verify ball.sdf --size 8x8"},
                                         Word{"verify ball.sdf --size 8x8 --json -"}),
                         [](const auto& test) {
                           std::string name = test.param.text;
                           std::erase_if(name, [](unsigned char c) { return std::isalnum(c) == 0; });
                           return name + (std::string(test.param.text).ends_with("-") ? "Dash" : "");
                         });

TEST_P(FullStandardOutput, IsTrouble) {
  expect_trouble(shell("\"$0\" " + std::string(GetParam().text) + " > /dev/full"),
                 {"standard output", "No space left"});
}

class FileSizeLimit : public FullDisk, public testing::WithParamInterface<Word> {};
INSTANTIATE_TEST_SUITE_P(Of, FileSizeLimit,
                         testing::Values(Word{"ppm"}, Word{"pfm"}, Word{"png"}, Word{"exr"}),
                         [](const auto& test) { return std::string(test.param.text); });

/// As on a disk that fills up: the first bytes can be written, the last cannot.
TEST_P(FileSizeLimit, LeavesTheOldImageAndNothingElse) {
  // Noise, so that it stays large when it is compressed.
  std::string noise(ball_scene);
  for (int i = 0; i < 40; ++i) {
    const std::string n = std::to_string(i);
    noise += "define shape sphere s" + n + " " + std::to_string(i % 8 - 4) + " " + std::to_string(i / 8 - 2) +
             " -5 0.6 red\n";
  }
  workplace_.file("noise.sdf", noise);
  const std::string name = std::string("image.") + GetParam().text;
  workplace_.file(name, "old");
  const auto before = listing(workplace_.directory());
  const std::vector<std::pair<std::string, std::string>> cases{
      {"0", "16x12"}, {"0", "120x90"}, {"1", "120x90"}, {"8", "120x90"}};
  for (const auto& [blocks, size] : cases) {
    SCOPED_TRACE(blocks + " blocks for " + size);
    // The harness writes the messages to a file, too: they go through a pipe.
    const auto result = shell("mkfifo .pipe; cat .pipe > said & (ulimit -f " + blocks +
                              "; exec \"$0\" render noise.sdf --size " + size + " -o " + name +
                              " 2> .pipe); code=$?; wait; rm .pipe; exit $code");
    EXPECT_EQ(result.exit_code, 2);
    expect_own_words(read_file(workplace_.path("said")), {name, "cannot be written"});
    std::filesystem::remove(workplace_.path("said"));
    EXPECT_TRUE(read_file(workplace_.path(name)) == "old") << "the old image is lost";
    workplace_.file(name, "old");
    EXPECT_EQ(listing(workplace_.directory()), before);
  }
}

TEST_F(FullDisk, FileSizeLimitOfAnExportLeavesTheOldFile) {
  workplace_.file("scene.pov", "old");
  const auto before = listing(workplace_.directory());
  const auto result = shell("ulimit -f 1; exec \"$0\" export ball.sdf -o scene.pov");
  expect_trouble(result, {"scene.pov", "cannot be written"});
  EXPECT_EQ(read_file(workplace_.path("scene.pov")), "old");
  EXPECT_EQ(listing(workplace_.directory()), before);
}

// --- looks wrong, is right ------------------------------------------------------------------------

class LegalInput : public testing::Test {
 protected:
  /// Renders, exports and lints it, with no word of complaint.
  void expect_to_work(const std::string& path) const {
    SCOPED_TRACE(path);
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"render", "-o", "got.pfm", "--size", "16x12", "--", path},
          std::vector<std::string>{"export", "-o", "got.pov", "--", path},
          std::vector<std::string>{"lint", "--", path}}) {
      const Outcome outcome = run_plumb(command, workplace_.directory());
      EXPECT_EQ(outcome.exit_code, 0) << command.front() << outcome.out << outcome.err;
      EXPECT_EQ(outcome.err, "") << command.front();
    }
  }
  /// Like expect_to_work, and POV-Ray agrees.
  void expect_to_agree(const std::string& path) const {
    expect_to_work(path);
    const Outcome outcome = run_plumb({"verify", "--size", "16x12", "--", path}, workplace_.directory());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  }

  Workplace workplace_;
};

TEST_F(LegalInput, NestingOf500CompositesWorks) {
  workplace_.file("deep.sdf", nested(500));
  expect_to_agree("deep.sdf");
}

TEST_F(LegalInput, NestingOf1000CompositesWorksWithParentsFirst) {
  workplace_.file("deep.sdf", nested(1000, true));
  expect_to_work("deep.sdf");
}

TEST_F(LegalInput, AHundredLightsWork) {
  std::string text(ball_scene);
  for (int i = 0; i < 100; ++i) {
    text += "define light l" + std::to_string(i) + " " + std::to_string(i % 10 - 5) + " 5 " +
            std::to_string(i / 10) + " 0.01 0.02 0.01 1\n";
  }
  workplace_.file("lights.sdf", text);
  expect_to_agree("lights.sdf");
}

TEST_F(LegalInput, ACommentOfAMillionCharactersWorks) {
  workplace_.file("comment.sdf", with("# " + many('x') + "\n"));
  expect_to_work("comment.sdf");
}

TEST_F(LegalInput, ALineOfAMillionBlanksWorks) {
  workplace_.file("blanks.sdf",
                  with("ambient" + many(' ') + "1" + many('\t') + "1 1" + many(' ') + "\n") + many('\n'));
  const Outcome outcome = run_plumb({"lint", "blanks.sdf"}, workplace_.directory());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out;
}

TEST_F(LegalInput, ACompositeOfAHundredThousandSharedChildrenWorks) {
  std::string line = "define shape composite c";
  for (int i = 0; i < 100'000; ++i) line += " ball";
  workplace_.file("shared.sdf", with(line));
  const Outcome outcome = run_plumb({"lint", "shared.sdf"}, workplace_.directory());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out;
}

TEST_F(LegalInput, TheLastLineNeedsNoNewline) {
  std::string text(ball_scene);
  text.pop_back();
  workplace_.file("cut.sdf", text);
  expect_to_work("cut.sdf");
  const std::string cut = read_file(workplace_.path("got.pfm"));
  workplace_.file("whole.sdf", std::string(ball_scene));
  expect_to_work("whole.sdf");
  EXPECT_TRUE(cut == read_file(workplace_.path("got.pfm")));
}

TEST_F(LegalInput, WindowsLineEndsAndAByteOrderMarkAreRead) {
  std::string text = "\xEF\xBB\xBF";
  for (const char c : ball_scene) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  workplace_.file("windows.sdf", text);
  expect_to_work("windows.sdf");
  EXPECT_EQ(run_plumb({"render", "windows.sdf"}, workplace_.directory()).out, "out.ppm\n");
}

TEST_F(LegalInput, APipeIsRead) {
  workplace_.file("ball.sdf", std::string(ball_scene));
  for (const char* const command : {"lint pipe.sdf", "export pipe.sdf -o got.pov",
                                    "render pipe.sdf -o got.pfm", "verify pipe.sdf --size 8x8"}) {
    const auto result = run_shell("mkfifo pipe.sdf; cat ball.sdf > pipe.sdf & \"$0\" " +
                                      std::string(command) + "; code=$?; wait; rm pipe.sdf; exit $code",
                                  workplace_.directory());
    EXPECT_EQ(result.exit_code, 0) << command << result.output;
  }
  expect_to_work("ball.sdf");
}

TEST_F(LegalInput, StandardInputIsReadByItsDevice) {
  workplace_.file("ball.sdf", std::string(ball_scene));
  const auto result = run_shell("\"$0\" lint /dev/stdin < ball.sdf; cat ball.sdf | \"$0\" lint /dev/stdin",
                                workplace_.directory());
  EXPECT_EQ(result.output, "/dev/stdin: 0 errors, 0 warnings\n/dev/stdin: 0 errors, 0 warnings\n");
}

TEST_F(LegalInput, AnyPathWorks) {
  const std::vector<std::string> names{"with blank.sdf",
                                       "Kügelchen-球.sdf",
                                       "\"quoted\" 'twice'.sdf",
                                       "$(touch pwned);`touch pwned`&.sdf",
                                       "-dash.sdf",
                                       "--size.sdf",
                                       "*.sdf",
                                       "no extension",
                                       "%s%n%d.sdf",
                                       "\\back\\slash.sdf"};
  for (const std::string& name : names) {
    workplace_.file(name, std::string(ball_scene));
    expect_to_work(name);
  }
  std::vector<std::string> command{"verify", "--size", "8x8", "--"};
  command.insert(command.end(), names.begin(), names.end());
  const Outcome outcome = run_plumb(command, workplace_.directory());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(workplace_.path("pwned")));
}

TEST_F(LegalInput, APathThatIsNoUtf8IsStillValidJson) {
  const std::string name = "latin-\xfc.sdf";
  workplace_.file(name, std::string(ball_scene));
  expect_to_work(name);
  const Outcome outcome = run_plumb({"lint", "--json", "-", name}, workplace_.directory());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "latin-\xEF\xBF\xBD.sdf")) << outcome.out;
}

/// Names may hold any character but blanks and '#': neither a shell nor POV-Ray may take them for theirs.
TEST_F(LegalInput, NamesAreNeverCommands) {
  const std::string code = "$(touch${IFS}pwned);`touch${IFS}pwned`|&>pwned<\"'*/}//\\";
  workplace_.file("names.sdf", "define material " + code + " 0.4 0.1 0.1 0.6 0.2 0.1 0.3 0.2 0.1 20\n" +
                                   "define shape sphere " + code + " 0 0 -3 1 " + code + "\n" +
                                   "define shape composite }#declare " + code + "\n" +
                                   "define shape composite }#include\"/etc/passwd\" " + code + "\n");
  // '#' begins a comment: the composites above lack their children.
  EXPECT_EQ(run_plumb({"lint", "names.sdf"}, workplace_.directory()).exit_code, 2);
  workplace_.file("names.sdf", "define material " + code + " 0.4 0.1 0.1 0.6 0.2 0.1 0.3 0.2 0.1 20\n" +
                                   "define shape sphere " + code + " 0 0 -3 1 " + code + "\n" +
                                   "define shape composite }\"*/union{ " + code + "\n" + "define light " +
                                   code + " 4 6 2 1 1 1 1\n" + "define camera eye;" + code + " 60\n" +
                                   "render eye;" + code + " $(touch)`;&.ppm 32 24\n");
  expect_to_agree("names.sdf");
  const Outcome outcome = run_plumb({"render", "names.sdf"}, workplace_.directory());
  EXPECT_EQ(outcome.out, "$(touch)`;&.ppm\n") << outcome.err;
  EXPECT_EQ(listing(workplace_.directory()),
            (std::vector<std::string>{"$(touch)`;&.ppm", "got.pfm", "got.pov", "names.sdf"}));
}

}  // namespace
}  // namespace plumb::tests
