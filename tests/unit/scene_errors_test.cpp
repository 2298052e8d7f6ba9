// Mistakes in scene files: each is reported at its line and column, with what is expected and the likely fix.
#include <gtest/gtest.h>

#include <chrono>
#include <ostream>

#include "tracer/format/reader.hpp"

namespace plumb {
namespace {

std::vector<Finding> errors_of(std::string_view text) {
  std::vector<Finding> errors;
  for (const Finding& finding : read_scene(text).findings) {
    if (finding.severity == Severity::error) errors.push_back(finding);
  }
  return errors;
}

std::string all_of(const std::vector<Finding>& findings) {
  std::string text;
  for (const Finding& finding : findings) text += to_string(finding, "text") + "\n";
  return text;
}

/// The text has this one error, at this place, and its message holds all the parts.
void expect_error(std::string_view text, int line, int column, const std::vector<std::string>& parts) {
  const auto errors = errors_of(text);
  ASSERT_EQ(errors.size(), 1U) << all_of(errors);
  EXPECT_EQ(errors[0].line, line) << all_of(errors);
  EXPECT_EQ(errors[0].column, column) << all_of(errors);
  for (const std::string& part : parts) {
    EXPECT_NE(errors[0].message.find(part), std::string::npos) << part << " is missing in\n"
                                                               << all_of(errors);
  }
}

/// A material `red` and a sphere `ball`: two lines to build on.
const std::string start =
    "define material red 1 0 0 1 0 0 1 1 1 20\n"
    "define shape sphere ball 0 0 -5 1 red\n";

TEST(SceneErrors, AnUnknownStatementIsNamedWithTheNearestOne) {
  expect_error(start + "  ambeint 1 1 1\n", 3, 3, {"found 'ambeint'", "expected a statement", "'ambient'?"});
  expect_error(start + "rendr eye a.ppm 1 1\n", 3, 1, {"did you mean 'render'?"});
}

TEST(SceneErrors, AStatementLikeNoOtherGetsNoSuggestion) {
  const std::string text = start + "xyzzy 1 1 1\n";
  expect_error(text, 3, 1, {"found 'xyzzy'", "define, ambient, background, camera, transform or render"});
  EXPECT_EQ(errors_of(text)[0].message.find("did you mean"), std::string::npos);
}

TEST(SceneErrors, AnUnknownKindOfDefinitionIsNamedWithTheNearestOne) {
  expect_error(start + "define materail x 1\n", 3, 8, {"found 'materail'", "did you mean 'material'?"});
}

TEST(SceneErrors, DefineAloneMissesWhatToDefine) {
  expect_error(start + "define\n", 3, 7, {"found the end of the line", "material, shape, light or camera"});
}

TEST(SceneErrors, AnUnknownKindOfShapeIsNamedWithTheNearestOne) {
  expect_error(start + "define shape spere x 0 0 0 1 red\n", 3, 14,
               {"found 'spere'", "did you mean 'sphere'?"});
}

TEST(SceneErrors, ShapesThatTheLectureLacksAreExplained) {
  expect_error(start + "define shape triangle t 0 0 0 1 0 0 0 1 0 red\n", 3, 14,
               {"the lecture has no triangle", "boxes and spheres"});
  expect_error(start + "define shape plane p 0 1 0 0 red\n", 3, 14, {"a large box serves"});
}

TEST(SceneErrors, ABrokenShapeIsNotReportedAgainWhereItIsUsed) {
  expect_error(
      start + "define shape cone c 0 0 0 1 red\ndefine shape composite all ball c\ntransform c scale 2\n", 3,
      14, {"'cone'"});
}

TEST(SceneErrors, AShapeWithoutItsKindIsRecognised) {
  expect_error(start + "define shape ball2 0 0 -5 1 red\n", 3, 14, {"the kind of the shape is missing"});
}

// --- names -------------------------------------------------------------------------------------

TEST(SceneErrors, AnUnknownMaterialIsNamedWithTheNearestOne) {
  expect_error(start + "define shape sphere b 0 0 0 1 rde\n", 3, 31,
               {"found 'rde'", "expected the name of a material that is defined", "did you mean 'red'?"});
}

TEST(SceneErrors, AnUnknownMaterialLikeNoOtherIsToBeDefined) {
  expect_error(start + "define shape box b 0 0 0 1 1 1 turquoise\n", 3, 32,
               {"found 'turquoise'", "define it"});
}

TEST(SceneErrors, AnUndefinedChildIsReportedAtItsPlace) {
  expect_error(start + "define shape composite all ball bal\n", 3, 33, {"found 'bal'", "a shape", "'ball'?"});
}

TEST(SceneErrors, TransformsOfNothingAreReported) {
  expect_error(start + "transform blal scale 2\n", 3, 11, {"found 'blal'", "shape or camera", "'ball'?"});
}

TEST(SceneErrors, ARenderOfAnUnknownCameraIsReported) {
  expect_error(start + "define camera eye 60\nrender eyes a.ppm 10 10\n", 4, 8, {"found 'eyes'", "'eye'?"});
}

TEST(SceneErrors, DuplicatesOfEachKindNameTheEarlierLine) {
  expect_error(start + "define material red 0 0 0 0 0 0 0 0 0 1\n", 3, 17,
               {"'red'", "material", "in line 1"});
  expect_error(start + "define shape box ball 0 0 0 1 1 1 red\n", 3, 18, {"'ball'", "shape", "in line 2"});
  expect_error(start + "define light l 0 0 0 1 1 1 1\ndefine light l 0 0 0 1 1 1 1\n", 4, 14,
               {"'l'", "in line 3"});
  expect_error(start + "define camera c 60\ncamera c 60\n", 4, 8, {"'c'", "camera", "in line 3", "rename"});
}

TEST(SceneErrors, ATransformOfWhatIsBothACameraAndAShapeIsAmbiguous) {
  expect_error(start + "define camera ball 60\ntransform ball scale 2\n", 4, 11,
               {"both a camera and a shape"});
}

TEST(SceneErrors, AMissingNameIsReportedAtTheEndOfTheLine) {
  expect_error(start + "define material\n", 3, 16, {"end of the line", "name of a material"});
  expect_error(start + "define shape\n", 3, 13, {"end of the line", "sphere, box or composite"});
  expect_error(start + "define shape sphere\n", 3, 20, {"end of the line", "name of a shape"});
  expect_error(start + "define shape sphere s\n", 3, 22, {"end of the line", "radius and material"});
  expect_error(start + "define shape box b\n", 3, 19, {"end of the line", "two corners"});
  expect_error(start + "define shape composite c\n", 3, 25, {"end of the line", "children"});
  expect_error(start + "define light\n", 3, 13, {"end of the line", "name of a light"});
  expect_error(start + "define camera\n", 3, 14, {"end of the line", "name of a camera"});
  expect_error(start + "transform\n", 3, 10, {"end of the line", "shape or camera"});
  expect_error(start + "transform ball\n", 3, 15, {"end of the line", "translate, rotate or scale"});
}

// --- numbers -----------------------------------------------------------------------------------

struct BadNumber {
  const char* name;
  const char* text;
  const char* complaint;
};
/// How CTest names the test.
void PrintTo(const BadNumber& number, std::ostream* out) { *out << number.name; }

class BadNumberIn : public testing::TestWithParam<BadNumber> {};

TEST_P(BadNumberIn, AColourIsReportedAtItsPlace) {
  expect_error(start + "ambient 1 " + GetParam().text + " 1\n", 3, 11,
               {"expected a number", GetParam().complaint});
}

TEST_P(BadNumberIn, AMaterialIsReportedAtItsPlace) {
  expect_error(start + "define material m 0 0 0 0 0 0 0 0 0 " + GetParam().text + "\n", 3, 37,
               {"expected a number", GetParam().complaint});
}

TEST_P(BadNumberIn, ATransformIsReportedAtItsPlace) {
  expect_error(start + "transform ball scale " + GetParam().text + "\n", 3, 22,
               {"expected a number", GetParam().complaint});
}

INSTANTIATE_TEST_SUITE_P(
    SceneErrors, BadNumberIn,
    testing::Values(BadNumber{"LowerNan", "nan", "not finite"}, BadNumber{"Nan", "NaN", "not finite"},
                    BadNumber{"Inf", "inf", "not finite"}, BadNumber{"MinusInf", "-inf", "not finite"},
                    BadNumber{"Infinity", "infinity", "not finite"},
                    BadNumber{"TooLarge", "1e999", "outside the range"},
                    BadNumber{"TooNegative", "-1e999", "outside the range"},
                    BadNumber{"TooSmall", "1e-999", "outside the range"},
                    BadNumber{"SquareOverflows", "2e100", "between -1e100 and 1e100"},
                    BadNumber{"DecimalComma", "1,5", "decimal point, no commas"},
                    BadNumber{"Placeholder", "{{X}}", "placeholder"},
                    BadNumber{"UnicodeMinus",
                              "\xE2\x88\x92"
                              "1",
                              "not ASCII"},
                    BadNumber{"FloatSuffix", "0.5f", "drop the 'f'"},
                    BadNumber{"TwoPoints", "1.5.2", "no number"},
                    BadNumber{"Hexadecimal", "0x10", "no number"},
                    BadNumber{"TwoMinuses", "--1", "no number"}, BadNumber{"PlusMinus", "+-1", "no number"},
                    BadNumber{"PlusAlone", "+", "no number"}, BadNumber{"MinusAlone", "-", "no number"},
                    BadNumber{"NoExponent", "1e", "no number"}, BadNumber{"Word", "one", "no number"}),
    [](const auto& instance) { return std::string(instance.param.name); });

TEST(SceneErrors, BytesThatCannotBePrintedAreShownInHexadecimal) {
  expect_error(start +
                   "ambient 1 1 \xE2\x88\x92"
                   "1\n",
               3, 13, {"found '\\xe2\\x88\\x921'"});
}

TEST(SceneErrors, LongWordsAreShortened) {
  expect_error(start + "ambient 1 1 " + std::string(1000, 'x') + "\n", 3, 13,
               {"'" + std::string(40, 'x') + "...'"});
}

TEST(SceneErrors, ColumnsCountBytesAndTabsAsOne) {
  expect_error(start + "\tambient\t1\t1\tx\n", 3, 14, {"'x'"});
}

TEST(SceneErrors, ColumnsAreNotShiftedByAByteOrderMark) {
  expect_error(
      "\xEF\xBB\xBF"
      "ambient 1 1 x\n",
      1, 13, {"'x'"});
}

TEST(SceneErrors, WrongCountsSayWhatWasFoundAndExpected) {
  expect_error(start + "define material m 0 0 0 0 0 0 0 0 0\n", 3, 17, {"found 9 numbers", "10: ka kd ks"});
  expect_error(start + "define material m 0 0 0 0 0 0 0 0 0 1 2\n", 3, 17,
               {"found 11 numbers", "mirror r g b"});
  expect_error(start + "define shape sphere s 0 0 0 red\n", 3, 21,
               {"found 3 numbers", "center x y z and radius"});
  expect_error(start + "define shape sphere s 0 0 0 1 2 red\n", 3, 21, {"found 5 numbers"});
  expect_error(start + "define shape box b 0 0 0 1 1 red\n", 3, 18,
               {"found 5 numbers", "two opposite corners"});
  expect_error(start + "define light l 0 0 0 1 1\n", 3, 14, {"found 5 numbers", "7: position"});
  expect_error(start + "define light l 0 0 0 1 1 1\n", 3, 14, {"found 6 numbers", "--dialect light-color"});
  expect_error(start + "define light l 0 0 0 1 1 1 1 1 1\n", 3, 14, {"found 9 numbers", "--dialect la-ld"});
  expect_error(start + "define light l 0 0 0 1 1 1 1 1 1 1\n", 3, 14,
               {"found 10 numbers", "la-ld-brightness"});
  expect_error(start + "ambient 1 1\n", 3, 1, {"found 2 numbers", "3: r g b"});
  expect_error(start + "background 1 1 1 1\n", 3, 1, {"found 4 numbers", "3: r g b"});
  expect_error(start + "define camera c 60 0 0 0 0 0 -1\n", 3, 15, {"found 7 numbers", "1 or 10: fov-x"});
  expect_error(start + "transform ball translate 1 2\n", 3, 16, {"found 2 numbers", "3: x y z"});
  expect_error(start + "transform ball rotate 1 2 3\n", 3, 16,
               {"found 3 numbers", "4: degrees and the axis"});
  expect_error(start + "transform ball scale 1 2\n", 3, 16, {"found 2 numbers", "1 or 3"});
}

TEST(SceneErrors, TooManyNumbersAreAsWrongAsTooFew) {
  expect_error(start + "define shape box b 0 0 0 1 1 1 1 red\n", 3, 18, {"found 7 numbers"});
  expect_error(start + "define light l 0 0 0 1 1 1 1 1\n", 3, 14, {"found 8 numbers"});
  expect_error(start + "define camera c 60 0 0 0 0 0 -1 0 1 0 1\n", 3, 15, {"found 11 numbers"});
  expect_error(start + "transform ball translate 1 2 3 4\n", 3, 16, {"found 4 numbers"});
  expect_error(start + "transform ball rotate 1 2 3 4 5\n", 3, 16, {"found 5 numbers"});
  expect_error(start + "transform ball scale 1 2 3 4\n", 3, 16, {"found 4 numbers"});
}

TEST(SceneErrors, OneNumberIsNotWrittenAsSeveral) {
  expect_error(start + "transform ball translate 1\n", 3, 16, {"found 1 number,"});
}

TEST(SceneErrors, AMissingMaterialIsRecognised) {
  expect_error(start + "define shape sphere s 0 0 0 1\n", 3, 21,
               {"found 4 numbers", "the material is missing"});
  expect_error(start + "define shape box b 0 0 0 1 1 1\n", 3, 18,
               {"found 6 numbers", "the material is missing"});
}

TEST(SceneErrors, AMaterialKeywordStandsOnceAndWithItsNumbers) {
  const std::string m = start + "define material m 0 0 0 0 0 0 0 0 0 1 ";  // 38 columns
  expect_error(m + "mirror 1 1\n", 3, 39, {"'mirror'", "expected 3 numbers after it"});
  expect_error(m + "eta\n", 3, 39, {"'eta'", "expected 1 number after it"});
  expect_error(m + "eta 1 eta 2\n", 3, 45, {"'eta'", "once"});
  expect_error(m + "mirror 1 1 1 shiny 1\n", 3, 52, {"'shiny'", "mirror, transmit or eta"});
  expect_error(m + "transmit 1 x 1\n", 3, 50, {"'x'", "expected a number"});
}

// --- values that make no sense ---------------------------------------------------------------------

TEST(SceneErrors, ARadiusIsPositive) {
  expect_error(start + "define shape sphere s 0 0 0 0 red\n", 3, 21, {"radius 0", "> 0", "enlarge"});
  expect_error(start + "define shape sphere s 0 0 0 -0 red\n", 3, 21, {"radius", "> 0"});
  expect_error(start + "define shape sphere s 0 0 0 -2 red\n", 3, 21,
               {"radius -2", "> 0", "remove the minus sign", "--dialect loose"});
}

TEST(SceneErrors, AScaleHasNoFactorOfZero) {
  expect_error(start + "transform ball scale 0\n", 3, 16, {"no factor of 0", "no inverse"});
  expect_error(start + "transform ball scale 1 -0 1\n", 3, 16, {"no factor of 0"});
}

TEST(SceneErrors, ARotationHasAnAxis) {
  expect_error(start + "transform ball rotate 90 0 0 0\n", 3, 16, {"axis", "not 0 0 0"});
  expect_error(start + "transform ball rotate 90 0 1e-200 0\n", 3, 16, {"axis", "short"});
}

TEST(SceneErrors, AnUnknownTransformationIsNamedWithTheNearestOne) {
  expect_error(start + "transform ball roate 90 0 1 0\n", 3, 16, {"found 'roate'", "did you mean 'rotate'?"});
}

TEST(SceneErrors, AnExponentIsNotNegative) {
  expect_error(start + "define material m 0 0 0 0 0 0 0 0 0 -1\n", 3, 17, {"'m'", "m = -1", "m >= 0"});
}

TEST(SceneErrors, ARefractiveIndexOfGlassIsPositive) {
  const std::string m = start + "define material g 0 0 0 0 0 0 0 0 0 1 transmit 1 1 1 eta ";
  expect_error(m + "0\n", 3, 17, {"'g'", "refractive index", "> 0", "glass has 1.5"});
  expect_error(m + "-1.5\n", 3, 17, {"'g'", "refractive index -1.5"});
  expect_error(m + "1e-60\n", 3, 17, {"'g'", "> 0"});  // 0 as float32
  expect_error(m + "1e60\n", 3, 17, {"'g'"});          // infinite as float32
}

TEST(SceneErrors, TheFieldOfViewLiesBetween0And180Degrees) {
  for (const char* const fov : {"0", "-60", "180", "360"}) {
    expect_error(start + "define camera c " + fov + "\n", 3, 15, {"0 < fov-x < 180", fov});
  }
}

TEST(SceneErrors, DirectionAndUpOfACameraAreNotParallel) {
  expect_error(start + "define camera c 60 0 0 0 0 1 0 0 -2 0\n", 3, 15, {"'c'", "parallel", "up"});
  expect_error(start + "define camera c 60 0 0 0 0 0 0 0 1 0\n", 3, 15, {"'c'", "direction of 0 0 0"});
  expect_error(start + "define camera c 60 0 0 0 0 0 -1 0 0 0\n", 3, 15, {"'c'", "up vector of 0 0 0"});
}

TEST(SceneErrors, ASizeIsAWholeNumberOfPixelsInRange) {
  const std::string c = start + "define camera c 60\nrender c a.ppm ";
  for (const char* const bad : {"0", "-5", "65536", "10.5", "1e9"}) {
    expect_error(c + bad + " 10\n", 4, 16,
                 {std::string("found '") + bad, "whole number of pixels from 1 to 65535"});
    expect_error(c + "10 " + bad + "\n", 4, 19, {std::string("found '") + bad, "from 1 to 65535"});
  }
  expect_error(c + "65535 65535\n", 4, 16, {"at most 268435456 pixels"});
}

TEST(SceneErrors, BlanksInAFileNameAreRecognised) {
  expect_error(start + "define camera c 60\nrender c image . ppm 480 320\n", 4, 10,
               {"found 'image'", "without blanks: write image.ppm", "--dialect loose"});
}

TEST(SceneErrors, AnotherShapeOfRenderShowsTheGrammar) {
  expect_error(start + "define camera c 60\nrender c 480 320\n", 4, 1, {"render CAMERA FILE XRES YRES"});
  expect_error(start + "define camera c 60\nrender c a.ppm 480\n", 4, 1, {"render CAMERA FILE XRES YRES"});
}

TEST(SceneErrors, SpellingsOfTheLooseDialectAreReportedWithIt) {
  expect_error(start + "// said\n", 3, 1, {"'#' before a comment", "--dialect loose"});
  expect_error(start + "ambient 1 1 1 // said\n", 3, 15, {"'#' before a comment"});
  expect_error(start + "define ambient 1 1 1\n", 3, 1, {"'ambient' without 'define'"});
  expect_error(start + "define amblight 1 1 1\n", 3, 8, {"'ambient r g b'"});
  expect_error(start + "ambient 0.5\n", 3, 1, {"three numbers r g b"});
  expect_error(start + "transform ball rotateX 90\n", 3, 16, {"rotate degrees x y z"});
  expect_error(start + "definematerial m 0 0 0 0 0 0 0 0 0 1\n", 3, 1, {"a blank after 'define'"});
  expect_error(start + "define camera c 60 640 480\n", 3, 15, {"found 3 numbers", "--dialect loose"});
}

// --- the hierarchy ---------------------------------------------------------------------------------

TEST(SceneErrors, ACompositeInItselfIsACycle) {
  expect_error(start + "define shape composite a ball a\n", 3, 24, {"contains itself", "'a' > 'a'"});
}

TEST(SceneErrors, ACycleIsShownWithItsPath) {
  expect_error(
      start + "define shape composite a ball b\ndefine shape composite b c\ndefine shape composite c a\n", 3,
      24, {"contains itself", "'a' > 'b' > 'c' > 'a'"});
}

TEST(SceneErrors, ALongCycleIsShownInPart) {
  std::string text = start;
  constexpr int length = 10000;
  for (int i = 0; i < length; ++i) {
    text += "define shape composite c" + std::to_string(i) + " c" + std::to_string((i + 1) % length) + "\n";
  }
  expect_error(text, 3, 24, {"'c0' > 'c1' > ", "> ..."});
}

TEST(SceneErrors, ACompositeBesideACycleIsNotBlamed) {
  // `outer` leads into the cycle, but is not part of it.
  expect_error(
      start + "define shape composite outer a\ndefine shape composite a b\ndefine shape composite b a\n", 4,
      24, {"'a' > 'b' > 'a'"});
}

TEST(SceneErrors, CompositesNestedTooDeepAreRefused) {
  std::string text = start;
  constexpr int depth = 100000;
  std::string below = "ball";
  for (int i = 0; i < depth; ++i) {
    const std::string name = "c" + std::to_string(i);
    text += "define shape composite " + name + " " + below + "\n";
    below = name;
  }
  expect_error(text, 2 + depth, 24, {"nested 100000 deep", "at most 1000"});
}

TEST(SceneErrors, TooManyInstancesByDoublingAreRefused) {
  std::string text = start;
  std::string below = "ball";
  constexpr int doublings = 200;  // 2^200 spheres
  for (int i = 0; i < doublings; ++i) {
    const std::string name = "c" + std::to_string(i);
    text += "define shape composite " + name + " " + below + " " + below + "\n";
    below = name;
  }
  expect_error(text, 2 + doublings, 24, {"more than 4000000000", "counted each time"});
}

TEST(SceneErrors, TheNumberOfInstancesDoesNotOverflow) {
  std::string text = start;
  std::string below = "ball";
  for (int i = 0; i < 63; ++i) {
    const std::string name = "c" + std::to_string(i);
    text += "define shape composite " + name + " " + below + " " + below + "\n";
    below = name;
  }
  // 2^64 - 1 shapes below c62, composites among them: one more is 0 in 64 bits.
  text += "define shape composite all c62\n";
  expect_error(text, 66, 24, {"more than 4000000000"});
}

TEST(SceneErrors, ManySmallCompositesBesideOneAnotherAreCountedTogether) {
  std::string text = start;
  std::string below = "ball";
  for (int i = 0; i < 29; ++i) {
    const std::string name = "c" + std::to_string(i);
    text += "define shape composite " + name + " " + below + " " + below + "\n";
    below = name;
  }
  // 2^30 - 1 shapes below c28, twice as many below `one` and `two`: only together they are too many.
  text += "define shape composite one c28 c28\ndefine shape composite two c28 c28\n";
  expect_error(text, 33, 24, {"more than 4000000000"});
}

TEST(SceneErrors, TransformsThatOverflowAreRefused) {
  std::string text = start;
  for (int i = 0; i < 4; ++i) text += "transform ball scale 1e99\n";
  expect_error(text, 2, 21, {"'ball'", "overflows", "smaller factors"});
}

// --- files that are no scenes ------------------------------------------------------------------------

TEST(SceneErrors, AnEmptyFileIsNoScene) {
  for (const char* const text : {"", "\n", "   \n\t\n", "# nothing\n", "\xEF\xBB\xBF"}) {
    expect_error(text, 1, 1, {"found no statement", "empty"});
  }
}

TEST(SceneErrors, ABinaryFileIsNoScene) {
  expect_error(std::string("\x7f"
                           "ELF\0\1\2\n\0\0\n",
                           12),
               1, 5, {"zero byte", "binary file"});
}

TEST(SceneErrors, NothingAfterAZeroByteIsRead) {
  expect_error(start + std::string("ambient\0 1 1\n", 13) + "nonsense\n", 3, 8, {"zero byte"});
}

// --- all in one go -----------------------------------------------------------------------------------

TEST(SceneErrors, AllAreReportedInOneGoInTheOrderOfTheFile) {
  const auto errors = errors_of(
      "define shape composite all ball bal\n"      // undefined child: looked up at the end
      "define material red 1 0 0 1 0 0 1 1 1 x\n"  // no number
      "define shape sphere ball 0 0 -5 0 rde\n"    // radius, then the material
      "ambeint 1 1 1\n"                            // statement
      "define camera eye 200\n"                    // field of view
      "transform al scale 0\n"                     // factor 0: the line is not read on
      "transform al scale 1\n"                     // unknown
      "render ey image.ppm 0 10\n");               // size: the line is not read on
  const std::vector<std::pair<int, int>> expected{{1, 33}, {2, 39}, {3, 21}, {3, 35}, {4, 1},
                                                  {5, 15}, {6, 14}, {7, 11}, {8, 21}};
  std::vector<std::pair<int, int>> found;
  for (const Finding& error : errors) found.emplace_back(error.line, error.column);
  EXPECT_EQ(found, expected) << all_of(errors);
}

TEST(SceneErrors, ACycleIsReportedTogetherWithOtherErrors) {
  const auto errors = errors_of("define shape composite a a\nambient 1 1 x\n");
  ASSERT_EQ(errors.size(), 2U) << all_of(errors);
  EXPECT_NE(errors[0].message.find("contains itself"), std::string::npos);
  EXPECT_EQ(errors[1].line, 2);
}

TEST(SceneErrors, OneMistakeGivesOneErrorHoweverOftenTheNameIsUsed) {
  // The material is broken but its name is known.
  expect_error(
      "define material red 1 0 0\ndefine shape sphere a 0 0 0 1 red\ndefine shape sphere b 0 0 0 1 red\n", 1,
      17, {"found 3 numbers"});
}

TEST(SceneErrors, AFindingIsShownAsFileLineColumnAndKind) {
  const auto errors = errors_of("\nambient x 1 1\n");
  ASSERT_EQ(errors.size(), 1U);
  const std::string shown = to_string(errors[0], "dir/a.sdf");
  EXPECT_TRUE(shown.starts_with("dir/a.sdf:2:9: error: found 'x', expected a number")) << shown;
}

TEST(SceneErrors, ErrorsAndWarningsAreSortedTogether) {
  const auto findings =
      read_scene("define material m 0 0 0 -1 0 0 0 0 0 1\nambient 1 1 x\nambient 1 1 1\n").findings;
  ASSERT_GE(findings.size(), 2U);
  for (std::size_t i = 1; i < findings.size(); ++i) {
    EXPECT_LE(std::pair(findings[i - 1].line, findings[i - 1].column),
              std::pair(findings[i].line, findings[i].column));
  }
  EXPECT_EQ(findings[0].severity, Severity::warning);
  EXPECT_EQ(findings[1].severity, Severity::error);
}

/// Seconds to read a text, and how many errors that gives.
std::pair<double, std::size_t> timed(const std::string& text) {
  const auto begin = std::chrono::steady_clock::now();
  const std::size_t errors = errors_of(text).size();
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), errors};
}

constexpr int many = 60000;
// because so many lines take some 0.2 s, with a wide margin for a busy machine and for sanitizers; to compare
// all names with all takes 10 s and more.
constexpr double seconds_for_many = 100;  // no timing, but where a quadratic search would never end

TEST(SceneErrors, ManyUnknownNamesTakeNoQuadraticTime) {
  std::string text = start;
  for (int i = 0; i < many; ++i) {
    text += "define shape sphere s" + std::to_string(i) + " 0 0 0 1 m" + std::to_string(i) + "\n";
  }
  const auto [seconds, errors] = timed(text);
  EXPECT_EQ(errors, static_cast<std::size_t>(many));
  EXPECT_LT(seconds, seconds_for_many);
}

TEST(SceneErrors, ManyTransformsOfBrokenShapesTakeNoQuadraticTime) {
  std::string text = start;
  for (int i = 0; i < many; ++i) {
    const std::string name = "t" + std::to_string(i);
    text += "define shape triangle " + name + " 0\ntransform " + name + " scale 2\n";
  }
  const auto [seconds, errors] = timed(text);
  EXPECT_EQ(errors, static_cast<std::size_t>(many));
  EXPECT_LT(seconds, seconds_for_many);
}

}  // namespace
}  // namespace plumb
