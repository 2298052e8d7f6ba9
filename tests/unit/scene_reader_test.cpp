// The course grammar, read strictly: every statement, what separates tokens, defaults.
#include "tracer/format/reader.hpp"
#include "tracer/scene/hierarchy.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace plumb {
namespace {

/// The scene of a text without errors; fails and shows them otherwise.
Scene read(std::string_view text, const Dialect& dialect = {}) {
  const ReadResult result = read_scene(text, dialect);
  for (const Finding& finding : result.findings) {
    EXPECT_NE(finding.severity, Severity::error) << to_string(finding, "text");
  }
  return result.scene;
}

std::vector<std::string> warnings(std::string_view text) {
  std::vector<std::string> messages;
  for (const Finding& finding : read_scene(text).findings) {
    if (finding.severity == Severity::warning) messages.push_back(to_string(finding, "f"));
  }
  return messages;
}

bool any_contains(const std::vector<std::string>& messages, std::string_view part) {
  for (const std::string& message : messages) {
    if (message.find(part) != std::string::npos) return true;
  }
  return false;
}

/// One of everything, nothing left to a default: reads without a finding.
constexpr std::string_view complete =
    "define material red 1 0 0 1 0 0 1 1 1 20\n"
    "define shape sphere ball 0 0 -5 1 red\n"
    "define light lamp 1 2 3 1 1 1 1\n"
    "ambient 0.1 0.1 0.1\n"
    "define camera eye 60 0 0 0 0 0 -1 0 1 0\n"
    "render eye image.ppm 64 48\n";

TEST(SceneReader, ACompleteSceneHasNoFindings) { EXPECT_TRUE(read_scene(complete).findings.empty()); }

TEST(SceneReader, AMaterialHasKaKdKsAndM) {
  const Scene scene = read("define material red 0.1 0.2 0.3 0.4 0.5 0.6 0.7 0.8 0.9 20\n");
  ASSERT_EQ(scene.materials.size(), 1U);
  Material expected;
  expected.name = "red";
  expected.ka = {0.1, 0.2, 0.3};
  expected.kd = {0.4, 0.5, 0.6};
  expected.ks = {0.7, 0.8, 0.9};
  expected.m = 20;
  EXPECT_EQ(scene.materials[0], expected);  // no mirror, nothing transmitted, eta 1
}

TEST(SceneReader, AMaterialTakesMirrorTransmitAndEtaInAnyOrder) {
  for (const char* const text :
       {"define material g 0 0 0 0 0 0 0 0 0 1 mirror 1 2 3 transmit 4 5 6 eta 1.5\n",
        "define material g 0 0 0 0 0 0 0 0 0 1 eta 1.5 transmit 4 5 6 mirror 1 2 3\n"}) {
    const Scene scene = read(text);
    ASSERT_EQ(scene.materials.size(), 1U);
    EXPECT_EQ(scene.materials[0].mirror, Rgbd(1, 2, 3));
    EXPECT_EQ(scene.materials[0].transmit, Rgbd(4, 5, 6));
    EXPECT_EQ(scene.materials[0].eta, 1.5);
    EXPECT_EQ(scene.materials[0].m, 1);
  }
}

TEST(SceneReader, EtaIsRoundedToFloat32) {
  const Scene scene = read("define material g 0 0 0 0 0 0 0 0 0 1 transmit 1 1 1 eta 1.33\n");
  EXPECT_EQ(scene.materials.at(0).eta, static_cast<double>(1.33F));
  EXPECT_NE(scene.materials.at(0).eta, 1.33);
}

TEST(SceneReader, ASphereHasCentreRadiusAndMaterial) {
  const Scene scene = read(
      "define material a 0 0 0 0 0 0 0 0 0 1\ndefine material b 0 0 0 0 0 0 0 0 0 1\n"
      "define shape sphere s 1 -2 3.5 0.25 b\n");
  ASSERT_EQ(scene.shapes.size(), 1U);
  EXPECT_EQ(scene.shapes[0].name, "s");
  EXPECT_EQ(std::get<Sphere>(scene.shapes[0].geometry), (Sphere{{1, -2, 3.5}, 0.25, 1}));
}

TEST(SceneReader, ABoxIsTheSameFromAnyTwoOppositeCorners) {
  for (int flips = 0; flips < 8; ++flips) {
    std::string first;
    std::string second;
    for (int axis = 0; axis < 3; ++axis) {
      const std::string low = std::to_string(-1 - axis) + " ";
      const std::string high = std::to_string(2 + axis) + " ";
      first += (flips >> axis & 1) == 0 ? low : high;
      second += (flips >> axis & 1) == 0 ? high : low;
    }
    const Scene scene =
        read("define material a 0 0 0 0 0 0 0 0 0 1\ndefine shape box b " + first + second + "a\n");
    EXPECT_EQ(std::get<Box>(scene.shapes.at(0).geometry), (Box{{-1, -2, -3}, {2, 3, 4}, 0})) << flips;
  }
}

TEST(SceneReader, ACompositeHasChildrenInTheirOrder) {
  const Scene scene = read(
      "define material a 0 0 0 0 0 0 0 0 0 1\ndefine shape sphere s 0 0 0 1 a\n"
      "define shape box b 0 0 0 1 1 1 a\ndefine shape composite all b s b\n");
  EXPECT_EQ(std::get<Composite>(scene.shapes.at(2).geometry).children, (std::vector<ShapeId>{1, 0, 1}));
}

TEST(SceneReader, OnlyShapesWithoutAParentAreRoots) {
  const Scene scene = read(
      "define material a 0 0 0 0 0 0 0 0 0 1\ndefine shape sphere s 0 0 0 1 a\n"
      "define shape composite inner s\ndefine shape composite outer inner s\ndefine shape box b 0 0 0 1 1 1 "
      "a\n");
  EXPECT_EQ(scene.roots(), (std::vector<ShapeId>{2, 3}));
}

TEST(SceneReader, AChildMayHaveSeveralParents) {
  const Scene scene = read(
      "define material a 0 0 0 0 0 0 0 0 0 1\ndefine shape sphere s 0 0 0 1 a\n"
      "define shape composite left s\ndefine shape composite right s\n");
  EXPECT_EQ(std::get<Composite>(scene.shapes.at(1).geometry).children, (std::vector<ShapeId>{0}));
  EXPECT_EQ(std::get<Composite>(scene.shapes.at(2).geometry).children, (std::vector<ShapeId>{0}));
}

TEST(SceneReader, ALightHasPositionColourAndBrightness) {
  const Scene scene = read("define light lamp 1 2 3 0.5 0.25 1 8\n");
  ASSERT_EQ(scene.lights.size(), 1U);
  EXPECT_EQ(scene.lights[0], (Light{"lamp", {1, 2, 3}, {0.5, 0.25, 1}, 8}));
  EXPECT_EQ(scene.lights[0].intensity(), Rgbd(4, 2, 8));
}

TEST(SceneReader, AmbientAndBackgroundAreColours) {
  const Scene scene = read("ambient 0.1 0.2 0.3\nbackground 0.4 0.5 6\n");
  EXPECT_EQ(scene.ambient, Rgbd(0.1, 0.2, 0.3));
  EXPECT_EQ(scene.background, Rgbd(0.4, 0.5, 6));
}

TEST(SceneReader, AmbientGivenAgainCountsTheLastTimeAndWarns) {
  const std::string text = "ambient 1 1 1\nambient 2 2 2\n";
  EXPECT_EQ(read(text).ambient, Rgbd(2));
  EXPECT_TRUE(any_contains(warnings(text), "f:2:1: warning: 'ambient' is given again; line 1"));
}

TEST(SceneReader, ACameraOfOneNumberLooksAlongMinusZ) {
  const Scene scene = read("define camera eye 60\n");
  ASSERT_EQ(scene.cameras.size(), 1U);
  EXPECT_EQ(scene.cameras[0].name, "eye");
  EXPECT_EQ(scene.cameras[0].fov_x_degrees, 60);
  EXPECT_EQ(scene.cameras[0].eye, Vec3d(0));
  EXPECT_EQ(scene.cameras[0].direction, Vec3d(0, 0, -1));
  EXPECT_EQ(scene.cameras[0].up, Vec3d(0, 1, 0));
}

TEST(SceneReader, ACameraHasEyeDirectionAndUp) {
  const Scene scene = read("define camera eye 60 1 2 3 4 5 6 7 8 10\n");
  EXPECT_EQ(scene.cameras.at(0).eye, Vec3d(1, 2, 3));
  EXPECT_EQ(scene.cameras.at(0).direction, Vec3d(4, 5, 6));
  EXPECT_EQ(scene.cameras.at(0).up, Vec3d(7, 8, 10));
}

TEST(SceneReader, ACameraNeedsNoDefine) {
  EXPECT_EQ(read("camera eye 60\n").cameras, read("define camera eye 60\n").cameras);
}

TEST(SceneReader, EachTransformationIsAStep) {
  const Scene scene = read(std::string(complete) +
                           "transform ball scale 2\ntransform ball scale 1 -2 3\n"
                           "transform ball rotate 90 0 2 0\ntransform ball translate 4 5 6\n");
  // In the order of the lines: the first acts first.
  EXPECT_EQ(scene.shapes.at(0).transform,
            (std::vector<TransformStep>{Scale{{2, 2, 2}}, Scale{{1, -2, 3}}, Rotate{90, {0, 2, 0}},
                                        Translate{{4, 5, 6}}}));
}

TEST(SceneReader, SuccessiveTransformsPreMultiply) {
  const Scene scene =
      read(std::string(complete) + "transform ball scale 2\ntransform ball translate 10 0 0\n");
  const auto m = transform_of<double>(scene.shapes.at(0).transform).matrix;
  // T S takes (1, 0, 0) to 2 * 1 + 10; S T would take it to 2 * (1 + 10).
  EXPECT_EQ(formulas::transform_point(m, Vec3d(1, 0, 0)), Vec3d(12, 0, 0));
}

TEST(SceneReader, ACameraIsTransformedLikeAShape) {
  const Scene scene = read(std::string(complete) + "transform eye translate 0 0 7\n");
  EXPECT_EQ(pose_of<double>(scene.cameras.at(0)).eye, Vec3d(0, 0, 7));
  EXPECT_EQ(pose_of<double>(scene.cameras.at(0)).direction, Vec3d(0, 0, -1));
  EXPECT_TRUE(scene.shapes.at(0).transform.empty());
}

TEST(SceneReader, ARenderHasCameraFileAndSize) {
  const Scene scene = read("define camera eye 60\nrender eye out/picture.png 640 480\n");
  ASSERT_EQ(scene.renders.size(), 1U);
  EXPECT_EQ(scene.renders[0], (RenderRequest{"eye", "out/picture.png", 640, 480}));
}

TEST(SceneReader, OfSeveralRendersAllAreKeptAndAWarningSaysThatTheFirstCounts) {
  const std::string text = "define camera eye 60\nrender eye a.ppm 1 2\nrender eye b.ppm 3 4\n";
  EXPECT_EQ(read(text).renders.size(), 2U);
  EXPECT_EQ(read(text).renders.at(0).file, "a.ppm");
  EXPECT_TRUE(any_contains(warnings(text), "f:3:8: warning: more than one render"));
}

// --- what may be missing -----------------------------------------------------------------------

TEST(SceneReader, WithoutACameraOneAtTheOriginIsTakenWithAWarning) {
  const std::string text = "ambient 1 1 1\nrender default image.ppm 10 10\n";
  const Scene scene = read(text);
  EXPECT_EQ(scene.cameras, (std::vector<Camera>{Camera{}}));
  EXPECT_EQ(scene.cameras.at(0).name, "default");
  EXPECT_TRUE(any_contains(warnings(text), "f:2:1: warning: no camera: one named 'default'"));
}

TEST(SceneReader, WithoutARenderTheFirstCameraIsTakenWithAWarning) {
  const std::string text = "define camera one 60\ndefine camera two 70\n";
  const Scene scene = read(text);
  EXPECT_EQ(scene.renders, (std::vector<RenderRequest>{{"one", "image.ppm", 480, 320}}));
  EXPECT_TRUE(any_contains(warnings(text), "f:2:1: warning: no render: camera 'one', image.ppm, 480 x 320"));
}

TEST(SceneReader, WithoutShapesAWarningSaysSo) {
  EXPECT_TRUE(any_contains(warnings("ambient 1 1 1\n"), "no shapes"));
  EXPECT_FALSE(any_contains(warnings(complete), "no shapes"));
}

TEST(SceneReader, WithoutLightsAWarningSaysSo) {
  EXPECT_TRUE(any_contains(
      warnings("define material a 0 0 0 1 1 1 0 0 0 1\ndefine shape sphere s 0 0 0 1 a\n"), "no lights"));
}

TEST(SceneReader, NegativeColoursAreReadWithAWarning) {
  const std::string text = "define material a 0 0 0 -0.5 0 0 0 0 0 1\n";
  EXPECT_EQ(read(text).materials.at(0).kd, Rgbd(-0.5, 0, 0));
  EXPECT_TRUE(any_contains(warnings(text), "f:1:17: warning: kd of 'a' is negative"));
}

TEST(SceneReader, ColoursThatCountTo255AreReadWithAWarning) {
  const std::string text = "define material a 0 0 0 255 0 0 0 0 0 1\ndefine light l 0 0 0 255 255 255 1\n";
  EXPECT_EQ(read(text).materials.at(0).kd, Rgbd(255, 0, 0));
  EXPECT_TRUE(any_contains(warnings(text), "f:1:17: warning: kd of 'a' is 255, where 1 is white"));
  EXPECT_TRUE(any_contains(warnings(text), "f:2:14: warning: colour of 'l' is 255"));
  EXPECT_FALSE(any_contains(warnings("define light l 0 0 0 1 1 1 50\n"), "white"));
}

TEST(SceneReader, AnIndexWithoutTransmissionIsReadWithAWarning) {
  EXPECT_TRUE(any_contains(warnings("define material a 0 0 0 1 0 0 0 0 0 1 eta 1.5\n"),
                           "f:1:17: warning: eta of 'a' has no effect"));
  EXPECT_FALSE(
      any_contains(warnings("define material a 0 0 0 1 0 0 0 0 0 1 transmit 1 1 1 eta 1.5\n"), "eta"));
}

// --- names ---------------------------------------------------------------------------------------

TEST(SceneReader, NamesMayBeUsedBeforeTheyAreDefined) {
  const Scene scene = read(
      "render eye image.ppm 10 10\ntransform ball translate 1 0 0\ntransform eye translate 0 0 5\n"
      "define shape composite all ball\ndefine shape sphere ball 0 0 0 1 red\n"
      "define material red 1 0 0 1 0 0 0 0 0 1\ndefine camera eye 60\n");
  EXPECT_EQ(std::get<Composite>(scene.shapes.at(0).geometry).children, (std::vector<ShapeId>{1}));
  EXPECT_EQ(scene.shapes.at(1).transform.size(), 1U);
  EXPECT_EQ(scene.cameras.at(0).transform.size(), 1U);
  EXPECT_EQ(scene.renders.at(0).camera, "eye");
}

TEST(SceneReader, DifferentKindsMayHaveTheSameName) {
  const Scene scene = read(
      "define material x 0 0 0 0 0 0 0 0 0 1\ndefine shape sphere x 0 0 0 1 x\ndefine light x 0 0 0 1 1 1 1\n"
      "define camera x 60\n");
  EXPECT_EQ(scene.materials.size() + scene.shapes.size() + scene.lights.size() + scene.cameras.size(), 4U);
}

TEST(SceneReader, AnyTextWithoutBlanksIsAName) {
  const Scene scene =
      read("define material r\xC3\xB6t-1 0 0 0 0 0 0 0 0 0 1\ndefine shape sphere 7 0 0 0 1 r\xC3\xB6t-1\n");
  EXPECT_EQ(scene.materials.at(0).name, "r\xC3\xB6t-1");
  EXPECT_EQ(scene.shapes.at(0).name, "7");
}

// --- what separates tokens ---------------------------------------------------------------------

TEST(SceneReader, CommentsReachToTheEndOfTheLine) {
  const Scene scene = read("# define camera a 60\n  # more\nambient 1 2 3# said\nbackground 4 5 6 # 7 8\n");
  EXPECT_EQ(scene.ambient, Rgbd(1, 2, 3));
  EXPECT_EQ(scene.background, Rgbd(4, 5, 6));
  EXPECT_EQ(scene.cameras.at(0).name, "default");
}

TEST(SceneReader, TabsAndSeveralBlanksSeparateTokens) {
  EXPECT_EQ(read("\tambient\t1  2 \t 3\t\n").ambient, Rgbd(1, 2, 3));
}

TEST(SceneReader, LinesMayEndWithCarriageReturns) {
  std::string crlf;
  for (const char c : complete) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const ReadResult result = read_scene(crlf);
  EXPECT_TRUE(result.findings.empty());
  EXPECT_EQ(result.scene, read(complete));
}

TEST(SceneReader, EachKindOfLineEndCountsAsOneLine) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    const auto said = warnings("ambient 1 1 1" + end + end + "ambient 2 2 2" + end);
    EXPECT_TRUE(any_contains(said, "f:3:1: warning: 'ambient' is given again; line 1"));
  }
}

TEST(SceneReader, AByteOrderMarkIsSkipped) {
  const ReadResult result = read_scene("\xEF\xBB\xBF" + std::string(complete));
  EXPECT_TRUE(result.findings.empty());
  EXPECT_EQ(result.scene, read(complete));
}

TEST(SceneReader, TheLastLineNeedsNoEnd) {
  EXPECT_EQ(read(complete.substr(0, complete.size() - 1)), read(complete));
}

TEST(SceneReader, EmptyLinesCountAsLines) {
  EXPECT_TRUE(any_contains(warnings("\n\nambient 1 1 1\n\nambient 2 2 2\n"), "f:5:1: warning: 'ambient'"));
}

// --- numbers -------------------------------------------------------------------------------------

TEST(SceneReader, NumbersHaveAnySpellingOfADecimal) {
  const Scene scene = read("ambient 1e-3 .5 2.\nbackground 1E+2 -0.0 007\n");
  EXPECT_EQ(scene.ambient, Rgbd(0.001, 0.5, 2));
  EXPECT_EQ(scene.background, Rgbd(100, 0, 7));
}

TEST(SceneReader, ALeadingPlusIsASign) {
  EXPECT_EQ(read("ambient +1 +0.5 +1e2\n").ambient, Rgbd(1, 0.5, 100));
}

TEST(SceneReader, NumbersAreRoundedToTheNearestDouble) {
  // 0.1 + 0.2 = 0.30000000000000004; the digits of 0.3 in full are 0.299999999999999988897769753748...
  const Scene scene = read("ambient 0.30000000000000004 0.3 0.29999999999999998889776975374843459\n");
  EXPECT_EQ(scene.ambient, Rgbd(0.1 + 0.2, 0.3, 0.3));
  EXPECT_NE(scene.ambient.x, scene.ambient.y);
}

TEST(SceneReader, TheOrderOfTheStatementsDoesNotMatter) {
  std::string reversed;
  std::string_view rest = complete;
  while (!rest.empty()) {
    const std::size_t end = rest.find('\n') + 1;
    reversed = std::string(rest.substr(0, end)) + reversed;
    rest.remove_prefix(end);
  }
  EXPECT_EQ(read(reversed), read(complete));
}

TEST(SceneReader, SizesUpToTheLimitAreRead) {
  const Scene scene =
      read("define camera c 60\nrender c a.ppm 65535 1\nrender c b.ppm 1 65535\nrender c d.ppm 1e2 2.0\n");
  EXPECT_EQ(scene.renders.at(0).width, 65535);
  EXPECT_EQ(scene.renders.at(1).height, 65535);
  EXPECT_EQ(scene.renders.at(2).width, 100);
  EXPECT_EQ(scene.renders.at(2).height, 2);
}

TEST(SceneReader, NestingUpToTheLimitIsRead) {
  std::string text = "define material a 0 0 0 0 0 0 0 0 0 1\ndefine shape sphere c0 0 0 0 1 a\n";
  for (std::size_t i = 1; i <= max_nesting; ++i) {
    text += "define shape composite c" + std::to_string(i) + " c" + std::to_string(i - 1) + "\n";
  }
  EXPECT_EQ(read(text).shapes.size(), max_nesting + 1);
}

// --- lines that are read in one go --------------------------------------------------------------------

/// Spheres and boxes in the usual spelling, some of them with one byte that is changed, added or removed.
std::vector<std::string> lines_with_slips(unsigned seed) {
  constexpr std::string_view slips = " \t\f#/+-.,0159eExnaif\xC3_m";
  std::mt19937 random(seed);
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  std::vector<std::string> lines{"define material m 0 0 0 0 0 0 0 0 0 1"};
  for (int i = 0; i < 40; ++i) {
    const std::string name = "s" + std::to_string(below(400));  // now and then one that is taken
    std::string line = below(2) == 0 ? "define shape sphere " + name + " -1.5 2e-3 .25 1e2 m"
                                     : "define shape box " + name + " 1 -2 3.5 -4 5 6 m";
    const std::size_t at = below(line.size());
    const std::size_t kind = below(6);
    if (kind == 0) line[at] = slips[below(slips.size())];
    if (kind == 1) line.insert(at, 1, slips[below(slips.size())]);
    if (kind == 2) line.erase(at, 1);
    lines.push_back(line);
  }
  lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(below(lines.size())),
               "define material n 0 0 0 0 0 0 0 0 0 2");
  return lines;
}

std::string joined(const std::vector<std::string>& lines, const std::string& end) {
  std::string text;
  for (const std::string& line : lines) text += line + end;
  return text;
}

TEST(SceneReader, ACommentAtTheEndOfALineChangesNothing) {
  std::size_t valid = 0, faulty = 0;
  for (unsigned seed = 0; seed < 500; ++seed) {
    const auto lines = lines_with_slips(seed);
    const ReadResult commented = read_scene(joined(lines, " #\n"));  // read word by word
    for (const char* const end : {"\n", "\r\n", "\r"}) {
      const ReadResult plain = read_scene(joined(lines, end));
      std::string findings, expected;
      for (const Finding& f : plain.findings) findings += to_string(f, "text") + f.remedy + "\n";
      for (const Finding& f : commented.findings) expected += to_string(f, "text") + f.remedy + "\n";
      EXPECT_EQ(findings, expected) << joined(lines, "\n");
      EXPECT_EQ(plain.scene, commented.scene) << joined(lines, "\n");
    }
    valid += commented.scene.shapes.size();
    faulty += commented.findings.size();
  }
  EXPECT_GT(valid, 5000U);  // or nothing was tested
  EXPECT_GT(faulty, 1000U);
}

}  // namespace
}  // namespace plumb
