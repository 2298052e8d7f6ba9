// Named ways in which people deviate from the course grammar: each part, and which ones are proposed.
#include "tracer/format/dialect.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <ostream>

#include "tracer/format/reader.hpp"

namespace plumb {
namespace {

/// The scene of a text that reads without errors in a dialect; fails and shows them otherwise.
Scene read(std::string_view text, std::string_view dialect) {
  const ReadResult result = read_scene(text, parse_dialect(dialect));
  for (const Finding& finding : result.findings) {
    EXPECT_NE(finding.severity, Severity::error) << dialect << ": " << to_string(finding, "text");
  }
  return result.scene;
}

Material material(const std::string& after_ks, std::string_view dialect) {
  const Scene scene = read("define material x 0 0 0 0 0 0 0 0 0 " + after_ks + "\n", dialect);
  return scene.materials.empty() ? Material{} : scene.materials[0];
}

bool has_warning(std::string_view text, std::string_view dialect, std::string_view part) {
  for (const Finding& finding : read_scene(text, parse_dialect(dialect)).findings) {
    if (finding.severity == Severity::warning && finding.message.find(part) != std::string::npos) return true;
  }
  return false;
}

// --- names of dialects -------------------------------------------------------------------------

TEST(DialectParts, StrictIsTheDefault) {
  const Dialect dialect = parse_dialect("strict");
  EXPECT_EQ(dialect.material, std::vector{MaterialField::shininess});
  EXPECT_EQ(dialect.order, TransformOrder::pre);
  EXPECT_FALSE(dialect.loose);
  EXPECT_FALSE(dialect.light_color);
  EXPECT_FALSE(dialect.la_ld_brightness);
  EXPECT_EQ(dialect.nine, NineNumbers::refused);
}

TEST(DialectParts, CommasJoinParts) {
  const Dialect dialect = parse_dialect("loose,refl-opacity-ior,post,la-ld");
  EXPECT_TRUE(dialect.loose);
  EXPECT_EQ(dialect.material, (std::vector{MaterialField::shininess, MaterialField::reflection,
                                           MaterialField::opacity, MaterialField::ior}));
  EXPECT_EQ(dialect.order, TransformOrder::post);
  EXPECT_EQ(dialect.nine, NineNumbers::la_ld);
}

TEST(DialectParts, AnUnknownPartIsNamedAndTheKnownOnesAreListed) {
  try {
    parse_dialect("loose,nonsense");
    FAIL() << "nothing was thrown";
  } catch (const std::invalid_argument& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("unknown dialect 'nonsense'"), std::string::npos);
    EXPECT_NE(message.find("brightness-rgb"), std::string::npos);
  }
}

TEST(DialectParts, AFieldStandsOnceInALayout) {
  EXPECT_THROW(parse_dialect("refl-refl"), std::invalid_argument);
  EXPECT_THROW(parse_dialect("m-ior-m"), std::invalid_argument);
  EXPECT_NO_THROW(parse_dialect("refl-skip-skip"));
}

TEST(DialectParts, EmptyPartsAreRefused) {
  EXPECT_THROW(parse_dialect("loose,"), std::invalid_argument);
  EXPECT_THROW(parse_dialect("refl--ior"), std::invalid_argument);
}

TEST(DialectParts, TheHelpNamesEveryPart) {
  const std::string help = describe_dialects();
  for (const char* const name :
       {"strict", "loose", "pre", "post", "trs", "la-ld", "la-ld-brightness", "light-color", "brightness-rgb",
        "refl", "opacity", "transparency", "ior", "gloss", "rough", "skip"}) {
    EXPECT_NE(help.find(name), std::string::npos) << name;
  }
}

// --- fields of a material ------------------------------------------------------------------------

TEST(DialectParts, WithoutADialectExtraNumbersAreRefused) {
  EXPECT_TRUE(read_scene("define material x 0 0 0 0 0 0 0 0 0 20 0.5\n").has_errors());
}

TEST(DialectParts, ReflectionIsTheGreyWeightOfTheMirror) {
  const Material x = material("20 0.25", "refl");
  EXPECT_EQ(x.m, 20);
  EXPECT_EQ(x.mirror, Rgbd(0.25));
  EXPECT_EQ(x.transmit, Rgbd(0));
}

TEST(DialectParts, OpacityOneIsSolid) {
  EXPECT_EQ(material("20 1", "opacity").transmit, Rgbd(0));
  EXPECT_EQ(material("20 0", "opacity").transmit, Rgbd(1));
  EXPECT_EQ(material("20 0.75", "opacity").transmit, Rgbd(0.25));
}

TEST(DialectParts, TransparencyOneIsClear) {
  EXPECT_EQ(material("20 1", "transparency").transmit, Rgbd(1));
  EXPECT_EQ(material("20 0", "transparency").transmit, Rgbd(0));
  EXPECT_EQ(material("20 0.75", "transparency").transmit, Rgbd(0.75));
}

TEST(DialectParts, IorIsTheRefractiveIndex) {
  const Material x = material("20 0.5 1.5", "transparency-ior");
  EXPECT_EQ(x.eta, 1.5);
  EXPECT_EQ(x.transmit, Rgbd(0.5));
}

TEST(DialectParts, GlossRoughAndSkipAreIgnored) {
  for (const char* const dialect : {"gloss-refl", "rough-refl", "skip-refl"}) {
    const Material x = material("20 0.75 0.5", dialect);
    EXPECT_EQ(x.mirror, Rgbd(0.5)) << dialect;
    EXPECT_EQ(x.transmit, Rgbd(0)) << dialect;
    EXPECT_EQ(x.eta, 1) << dialect;
  }
}

TEST(DialectParts, FieldsAreReadInTheirOrder) {
  const Material a = material("20 0.5 1.25 1.5", "refl-skip-ior");
  EXPECT_EQ(a.mirror, Rgbd(0.5));
  EXPECT_EQ(a.eta, 1.5);
  const Material b = material("20 1.5 1.25 0.5", "ior-skip-refl");
  EXPECT_EQ(b, a);
}

TEST(DialectParts, MNeedNotStandFirst) {
  const Material x = material("0.25 1.5 20", "transparency-ior-m");
  EXPECT_EQ(x.m, 20);
  EXPECT_EQ(x.transmit, Rgbd(0.25));
  EXPECT_EQ(x.eta, 1.5);
}

TEST(DialectParts, AMaterialWithoutExtraNumbersHasMAloneInEveryLayout) {
  EXPECT_EQ(material("20", "transparency-ior-m").m, 20);
  EXPECT_EQ(material("20", "refl-opacity-ior").m, 20);
  EXPECT_EQ(material("20", "refl-opacity-ior").transmit, Rgbd(0));  // not opacity 0
}

TEST(DialectParts, TheLastFieldsMayBeMissingAsLongAsMIsThere) {
  EXPECT_EQ(material("20 0.5", "refl-opacity-ior").mirror, Rgbd(0.5));
  EXPECT_EQ(material("20 0.5", "refl-opacity-ior").transmit, Rgbd(0));
  EXPECT_TRUE(
      read_scene("define material x 0 0 0 0 0 0 0 0 0 0.5 1.5\n", parse_dialect("refl-ior-m")).has_errors());
}

TEST(DialectParts, MoreNumbersThanTheLayoutHasAreRefused) {
  EXPECT_TRUE(
      read_scene("define material x 0 0 0 0 0 0 0 0 0 20 0.5 1.5\n", parse_dialect("refl")).has_errors());
}

TEST(DialectParts, KeywordsGoWithEveryLayout) {
  const Material x = material("20 0.5 eta 1.5 transmit 1 0 0", "refl");
  EXPECT_EQ(x.mirror, Rgbd(0.5));
  EXPECT_EQ(x.transmit, Rgbd(1, 0, 0));
  EXPECT_EQ(x.eta, 1.5);
}

TEST(DialectParts, AnOpacityOutsideZeroToOneIsClampedWithAWarning) {
  EXPECT_EQ(material("20 1.5", "opacity").transmit, Rgbd(0));
  EXPECT_EQ(material("20 -1", "opacity").transmit, Rgbd(1));
  EXPECT_TRUE(
      has_warning("define material x 0 0 0 0 0 0 0 0 0 20 1.5\n", "opacity", "outside 0..1: clamped"));
  EXPECT_FALSE(has_warning("define material x 0 0 0 0 0 0 0 0 0 20 1\n", "opacity", "clamped"));
}

// --- lights ------------------------------------------------------------------------------------

TEST(DialectParts, ALightOfSixNumbersHasPositionAndColour) {
  const Scene scene = read("define light l 1 2 3 0.5 0.25 1\n", "light-color");
  EXPECT_EQ(scene.lights.at(0), (Light{"l", {1, 2, 3}, {0.5, 0.25, 1}, 1}));
}

TEST(DialectParts, ALightOfLaAndLdAddsItsLaToTheAmbientLight) {
  const Scene scene = read(
      "define light a 1 2 3 0.25 0 0.5 0.5 0.25 1\ndefine light b 4 5 6 0.5 0.125 0 1 1 1\nambient 1 0 0\n",
      "la-ld");
  EXPECT_EQ(scene.lights.at(0), (Light{"a", {1, 2, 3}, {0.5, 0.25, 1}, 1}));
  EXPECT_EQ(scene.lights.at(1), (Light{"b", {4, 5, 6}, {1, 1, 1}, 1}));
  EXPECT_EQ(scene.ambient, Rgbd(1.75, 0.125, 0.5));
}

TEST(DialectParts, ALightOfTenNumbersHasLaLdAndABrightnessForBoth) {
  const Scene scene = read("define light a 1 2 3 0.25 0 0.5 0.5 0.25 1 4\n", "la-ld-brightness");
  EXPECT_EQ(scene.lights.at(0).intensity(), Rgbd(2, 1, 4));
  EXPECT_EQ(scene.ambient, Rgbd(1, 0, 2));
}

TEST(DialectParts, ABrightnessPerChannelMultipliesTheColour) {
  const Scene scene = read("define light a 1 2 3 0.25 1 0.5 4 2 1\n", "brightness-rgb");
  EXPECT_EQ(scene.lights.at(0).position, Vec3d(1, 2, 3));
  EXPECT_EQ(scene.lights.at(0).intensity(), Rgbd(1, 2, 0.5));
  EXPECT_EQ(scene.ambient, Rgbd(0));
}

TEST(DialectParts, SevenNumbersMeanTheSameInEveryDialect) {
  const std::string text = "define light a 1 2 3 0.25 1 0.5 4\n";
  const Scene strict = read(text, "strict");
  for (const char* const dialect : {"light-color", "la-ld", "la-ld-brightness", "brightness-rgb", "loose"}) {
    EXPECT_EQ(read(text, dialect), strict) << dialect;
  }
}

// --- the order of transforms -------------------------------------------------------------------

/// Translated, then scaled, then turned, as the lines stand.
constexpr std::string_view three_lines =
    "define material a 0 0 0 0 0 0 0 0 0 1\ndefine shape sphere s 0 0 0 1 a\n"
    "transform s translate 10 0 0\ntransform s scale 2 1 1\ntransform s rotate 90 0 0 1\n";

Vec3d image_of_x(std::string_view dialect) {
  const auto m = transform_of<double>(read(three_lines, dialect).shapes.at(0).transform).matrix;
  return formulas::transform_point(m, Vec3d(1, 0, 0));
}

void expect_near(const Vec3d& found, const Vec3d& expected) {
  // because the cosine of the rounded right angle is off by an epsilon, times coordinates up to 22.
  EXPECT_LE(glm::length(found - expected), 44 * std::numeric_limits<double>::epsilon());
}

TEST(DialectParts, PreMultiplyingLinesActInTheirOrder) {
  // (1, 0, 0) is moved to 11, scaled to 22, turned to y.
  expect_near(image_of_x("pre"), {0, 22, 0});
  EXPECT_EQ(image_of_x("pre"), image_of_x("strict"));
}

TEST(DialectParts, PostMultiplyingLinesActInReverse) {
  // Turned to (0, 1, 0), scaled not at all along y, moved to (10, 1, 0).
  expect_near(image_of_x("post"), {10, 1, 0});
}

TEST(DialectParts, TrsScalesThenTurnsThenMovesWhateverTheOrder) {
  // Scaled to 2, turned to (0, 2, 0), moved to (10, 2, 0).
  expect_near(image_of_x("trs"), {10, 2, 0});
}

TEST(DialectParts, TheOrdersAreTheProductsOfTheMatricesOfTheLines) {
  const auto t = formulas::translate(Vec3d(10, 0, 0)).matrix;
  const auto s = formulas::scale(Vec3d(2, 1, 1)).matrix;
  const auto r = formulas::rotate(90.0, Vec3d(0, 0, 1)).matrix;
  const std::array<std::pair<const char*, Mat4<double>>, 3> cases{
      {{"pre", r * s * t}, {"post", t * s * r}, {"trs", t * r * s}}};
  for (const auto& [dialect, expected] : cases) {
    const auto m = transform_of<double>(read(three_lines, dialect).shapes.at(0).transform).matrix;
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 4; ++row) {
        // because three matrices are multiplied in another order, entries up to 20.
        EXPECT_NEAR(m[column][row], expected[column][row], 40 * std::numeric_limits<double>::epsilon())
            << dialect;
      }
    }
  }
}

TEST(DialectParts, TrsKeepsTheOrderOfLinesOfAKind) {
  const Scene scene = read(
      "define material a 0 0 0 0 0 0 0 0 0 1\ndefine shape sphere s 0 0 0 1 a\ntransform s rotate 90 0 0 1\n"
      "transform s translate 1 0 0\ntransform s rotate 90 1 0 0\ntransform s translate 0 1 0\n",
      "trs");
  EXPECT_EQ(scene.shapes.at(0).transform,
            (std::vector<TransformStep>{Rotate{90, {0, 0, 1}}, Rotate{90, {1, 0, 0}}, Translate{{1, 0, 0}},
                                        Translate{{0, 1, 0}}}));
}

TEST(DialectParts, TheOrderIsThatOfCamerasToo) {
  const Scene scene = read("camera c 60\ntransform c translate 1 0 0\ntransform c scale 2\n", "post");
  EXPECT_EQ(pose_of<double>(scene.cameras.at(0)).eye, Vec3d(1, 0, 0));
}

// --- loose spellings -----------------------------------------------------------------------------

/// What only the loose dialect reads, and the strict text of the same scene.
struct Spelling {
  const char* name;
  const char* loose;
  const char* strict;
};
/// How CTest names the test.
void PrintTo(const Spelling& spelling, std::ostream* out) { *out << spelling.name; }

class LooseSpelling : public testing::TestWithParam<Spelling> {};

const std::string ball = "define material red 1 0 0 1 0 0 1 1 1 20\ndefine shape sphere ball 0 0 -5 1 red\n";

TEST_P(LooseSpelling, IsRefusedStrictly) { EXPECT_TRUE(read_scene(ball + GetParam().loose).has_errors()); }

TEST_P(LooseSpelling, IsReadLooselyAsWhatItMeans) {
  EXPECT_EQ(read(ball + GetParam().loose, "loose"), read(ball + GetParam().strict, "strict"));
}

TEST_P(LooseSpelling, TheLooseDialectIsProposedForIt) {
  EXPECT_EQ(propose_dialects(ball + GetParam().loose), std::vector<std::string>{"loose"});
}

INSTANTIATE_TEST_SUITE_P(
    DialectParts, LooseSpelling,
    testing::Values(
        Spelling{"SlashComment", "// said\nambient 1 1 1 // said\n", "ambient 1 1 1\n"},
        Spelling{"DefineAmbient", "define ambient 1 2 3\n", "ambient 1 2 3\n"},
        Spelling{"DefineAmblight", "define amblight 1 2 3\n", "ambient 1 2 3\n"},
        Spelling{"DefineBackground", "define background 1 2 3\n", "background 1 2 3\n"},
        Spelling{"DefineTransform", "define transform ball scale 2\n", "transform ball scale 2\n"},
        Spelling{"DefineRender", "camera c 60\ndefine render c a.ppm 8 9\n",
                 "camera c 60\nrender c a.ppm 8 9\n"},
        Spelling{"Renderer", "camera c 60\nrenderer c a.ppm 8 9\n", "camera c 60\nrender c a.ppm 8 9\n"},
        Spelling{"GreyAmbient", "ambient 0.5\n", "ambient 0.5 0.5 0.5\n"},
        Spelling{"RotateX", "transform ball rotateX 30\n", "transform ball rotate 30 1 0 0\n"},
        Spelling{"RotateY", "transform ball rotatey 30\n", "transform ball rotate 30 0 1 0\n"},
        Spelling{"RotateZ", "transform ball rotateZ 30\n", "transform ball rotate 30 0 0 1\n"},
        Spelling{"LightAmbient", "define light ambient l 0.1 0.2 0.3\n", "ambient 0.1 0.2 0.3\n"},
        Spelling{"LightDiffuse", "define light diffuse l 1 2 3 4 5 6\n", "define light l 1 2 3 4 5 6 1\n"},
        Spelling{"GluedDefine", "definelight l 1 2 3 4 5 6 7\n", "define light l 1 2 3 4 5 6 7\n"},
        Spelling{"NegativeRadius", "define shape sphere s 0 0 0 -2 red\n",
                 "define shape sphere s 0 0 0 2 red\n"},
        Spelling{"BlankInTheFileName", "camera c 60\nrender c image . ppm 8 9\n",
                 "camera c 60\nrender c image.ppm 8 9\n"},
        Spelling{"SizeFirst", "camera c 60\nrender 8 9 c a.ppm\n", "camera c 60\nrender c a.ppm 8 9\n"},
        Spelling{"FileFirst", "camera c 60\nrender a.ppm c 8 9\n", "camera c 60\nrender c a.ppm 8 9\n"},
        Spelling{"NoFile", "camera c 60\nrender c 8 9\n", "camera c 60\nrender c image.ppm 8 9\n"},
        Spelling{"NoCamera", "camera c 60\nrender a.ppm 8 9\n", "camera c 60\nrender c a.ppm 8 9\n"},
        Spelling{"NoSize", "camera c 60\nrender c a.ppm\n", "camera c 60\nrender c a.ppm 480 320\n"},
        Spelling{"Samples", "camera c 60\nrender c a.ppm 8 9 4\n", "camera c 60\nrender c a.ppm 8 9\n"},
        Spelling{"CameraWithResolution", "camera c 60 8 9\n", "camera c 60\nrender c image.ppm 8 9\n"},
        Spelling{"CameraWithResolutionAndRender", "camera c 60 8 9\nrender c a.ppm\n",
                 "camera c 60\nrender c a.ppm 8 9\n"},
        Spelling{"CameraWithEye", "camera c 60 1 2 3\n", "camera c 60 1 2 3 0 0 -1 0 1 0\n"},
        Spelling{"CameraWithPoseAndResolution", "camera c 60 1 2 3 0 0 -1 0 1 0 8 9\n",
                 "camera c 60 1 2 3 0 0 -1 0 1 0\nrender c image.ppm 8 9\n"},
        Spelling{"CameraWithMore", "camera c 60 1 2 3 0 0 -1 0 1 0 7\n", "camera c 60 1 2 3 0 0 -1 0 1 0\n"}),
    [](const auto& instance) { return instance.param.name; });

TEST(DialectParts, WhatTheLooseDialectIgnoresIsSaid) {
  EXPECT_TRUE(
      has_warning(ball + "camera c 60\nrender c a.ppm 8 9 4\n", "loose", "number of samples ignored"));
  EXPECT_TRUE(has_warning(ball + "camera c 60 1 2 3 0 0 -1 0 1 0 7\n", "loose", "is ignored"));
  EXPECT_TRUE(has_warning(ball + "camera c 60 1 2 3\n", "loose", "fov-x and eye"));
  EXPECT_TRUE(has_warning(ball + "define shape sphere s 0 0 0 -2 red\n", "loose", "absolute value"));
}

TEST(DialectParts, TheLooseDialectReadsStrictTextAsBefore) {
  const std::string text =
      ball + "camera c 60\nrender c ./a.ppm 8 9\ntransform ball rotate 30 1 0 0\nambient 1 2 3\n";
  EXPECT_EQ(read(text, "loose"), read(text, "strict"));
}

TEST(DialectParts, TheLooseDialectStillRefusesNonsense) {
  for (const char* const line :
       {"ambient 1 x 1\n", "transform ball scale 0\n", "define shape sphere s 0 0 0 0 red\n",
        "define material m 0 0 0 0 0 0 0 0 0 1 2\n", "camera c 200\n", "render\n1 2\n"}) {
    EXPECT_TRUE(read_scene(ball + line, parse_dialect("loose")).has_errors()) << line;
  }
}

// --- proposals -------------------------------------------------------------------------------------

bool proposes(const std::vector<std::string>& proposals, const std::string& dialect) {
  return std::find(proposals.begin(), proposals.end(), dialect) != proposals.end();
}

TEST(DialectProposals, NothingIsProposedForTheCourseGrammar) { EXPECT_TRUE(propose_dialects(ball).empty()); }

TEST(DialectProposals, NothingIsProposedForAMistakeNoDialectCures) {
  EXPECT_TRUE(propose_dialects(ball + "ambient 1 x 1\n").empty());
  EXPECT_TRUE(propose_dialects(ball + "ambient 1 x 1\ndefine light l 0 0 0 1 1 1\n").empty());
  EXPECT_TRUE(propose_dialects("").empty());
}

TEST(DialectProposals, AllLayoutsOfThreeNumbersAreProposedForGlass) {
  const auto proposals = propose_dialects("define material glass 0 0 0 0 0 0 0 0 0 50 0.5 0.5 1.5\n");
  for (const std::string& layout : known_material_layouts(3)) {
    if (layout.starts_with("ior"))
      continue;  // glass of index 0.5 and an opacity of 0.5 is possible all the same
    EXPECT_TRUE(proposes(proposals, layout)) << layout;
  }
  // Both polarities, as half of the people mean the one and half the other.
  EXPECT_TRUE(proposes(proposals, "refl-opacity-ior"));
  EXPECT_TRUE(proposes(proposals, "refl-transparency-ior"));
}

TEST(DialectProposals, LayoutsThatFitTheNumbersComeFirst) {
  const auto proposals = propose_dialects("define material glass 0 0 0 0 0 0 0 0 0 50 0.2 1.5 0.5\n");
  ASSERT_GE(proposals.size(), 3U);
  // 1.5 is no opacity: what takes it for the index has no warning.
  EXPECT_EQ(proposals[0], "refl-ior-opacity");
  EXPECT_EQ(proposals[1], "refl-ior-transparency");
}

TEST(DialectProposals, LightsOfSixAndTenNumbersHaveOneMeaning) {
  EXPECT_EQ(propose_dialects(ball + "define light l 0 0 0 1 1 1\n"), std::vector<std::string>{"light-color"});
  EXPECT_EQ(propose_dialects(ball + "define light l 0 0 0 1 1 1 1 1 1 1\n"),
            std::vector<std::string>{"la-ld-brightness"});
}

TEST(DialectProposals, SeveralPartsAreProposedTogether) {
  const auto proposals = propose_dialects(
      "// a file of 2015\ndefine material red 0 0 0 0 0 0 0 0 0 50 0.5\ndefine light l 0 0 0 1 1 1 1 1 1\n"
      "render c image . ppm 8 9\ndefine camera c 60\n");
  ASSERT_FALSE(proposals.empty());
  EXPECT_EQ(proposals[0], "la-ld,loose,refl");
}

TEST(DialectProposals, EveryProposalReadsTheTextWithoutErrors) {
  const std::string text =
      ball + "define material glass 0 0 0 0 0 0 0 0 0 50 0.2 1.5 // said\ndefine light l 0 0 0 1 1 1\n";
  const auto proposals = propose_dialects(text);
  ASSERT_GE(proposals.size(), 2U);
  for (const std::string& dialect : proposals) {
    EXPECT_FALSE(read_scene(text, parse_dialect(dialect)).has_errors()) << dialect;
  }
}

TEST(DialectProposals, MaterialsOfDifferentLengthsAreReadByTheLongestLayout) {
  const std::string text =
      "define material a 0 0 0 0 0 0 0 0 0 50\ndefine material b 0 0 0 0 0 0 0 0 0 50 0.2 0.5 1.5\n";
  const auto proposals = propose_dialects(text);
  ASSERT_FALSE(proposals.empty());
  EXPECT_EQ(proposals[0], "refl-opacity-ior");
}

TEST(DialectProposals, NineNumbersOfALightHaveTwoMeanings) {
  const auto proposals = propose_dialects(ball + "define light l 0 0 0 1 1 1 1 1 1\n");
  EXPECT_EQ(proposals, (std::vector<std::string>{"la-ld", "brightness-rgb"}));
}

TEST(DialectProposals, TheNearestDialectsAreThoseThatLeaveTheFewestErrors) {
  EXPECT_EQ(nearest_dialects(ball + "define light l 0 0 0 1 1 1\nambient x 1 1\n"),
            std::vector<std::string>{"light-color"});
  for (const std::string& layout :
       nearest_dialects("define material a 0 0 0 0 0 0 0 0 0 50 0.2 1.5 0.5\nambient x 1 1\n")) {
    EXPECT_TRUE(layout.find('-') != std::string::npos) << layout;
  }
}

TEST(DialectProposals, NoDialectIsNearestWhereNoneHelpsOrOneReadsAll) {
  EXPECT_TRUE(nearest_dialects(ball).empty());
  EXPECT_TRUE(nearest_dialects(ball + "ambient x 1 1\n").empty());
  EXPECT_TRUE(nearest_dialects(ball + "define light l 0 0 0 1 1 1\n").empty());  // light-color reads it
}

}  // namespace
}  // namespace plumb
