// Slides "Verfolgen von Strahlen", "Schatten", "Spiegelung, Brechung", "Objekttransformation" and "Composite,
// DAG": the textbook tracer as a whole.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "tests/support/random_scene.hpp"
#include "tests/support/reals.hpp"
#include "tracer/format/reader.hpp"
#include "tracer/textbook/render.hpp"
#include "tracer/textbook/tracer.hpp"

namespace plumb::textbook {
namespace {

using Exact = long double;

Scene read(const std::string& text) {
  const ReadResult result = read_scene(text);
  for (const Finding& finding : result.findings) {
    EXPECT_NE(finding.severity, Severity::error) << to_string(finding, "text") << "\n" << text;
  }
  return result.scene;
}

/// A material of nothing but ka (the ambient light of `eye` is 1), and more after its m.
std::string glow(const std::string& name, const std::string& rgb, const std::string& more = "") {
  return "define material " + name + " " + rgb + " 0 0 0 0 0 0 1 " + more + "\n";
}

/// Looks along -z from the origin, in ambient light of 1; black behind all.
const std::string eye = "ambient 1 1 1\ncamera eye 60\n";

/// What the ray through the middle of the picture sees.
template <class Real>
Rgb<Real> look(const std::string& text, const RenderOptions& options = {},
               const FormulaTable<Real>& formulas = {}) {
  const Scene scene = read(text);
  const World<Real> world(scene, formulas);
  return Tracer<Real>(world, scene.cameras.at(0), 1, 1, options).raycast(0, 0);
}

template <class Real>
std::vector<Rgb<Real>> picture(const Scene& scene, int width, int height,
                               const FormulaTable<Real>& formulas = {}, const RenderOptions& options = {}) {
  const World<Real> world(scene, formulas);
  const Tracer<Real> tracer(world, scene.cameras.at(0), width, height, options);
  std::vector<Rgb<Real>> pixels;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) pixels.push_back(tracer.raycast(x, y));
  }
  return pixels;
}

Image rendered(const Scene& scene, int width, int height, RealType real = RealType::float64, int threads = 1,
               const RenderOptions& options = {}) {
  RenderJob job;
  job.width = width;
  job.height = height;
  job.options = options;
  job.real = real;
  job.threads = threads;
  return render(scene, scene.cameras.at(0), job);
}

RenderOptions depth(int levels) {
  RenderOptions options;
  options.depth = levels;
  return options;
}

template <class Real>
void expect_near(const Rgb<Real>& found, const Rgb<Real>& expected, double tolerance) {
  for (int channel = 0; channel < 3; ++channel) {
    EXPECT_LE(std::abs(found[channel] - expected[channel]), static_cast<Real>(tolerance))
        << "channel " << channel << ": found " << found[channel] << ", expected " << expected[channel];
  }
}

template <class Real>
class TextbookTracer : public testing::Test {};
TYPED_TEST_SUITE(TextbookTracer, tests::Reals);

// --- Verfolgen von Strahlen ----------------------------------------------------------------------

TYPED_TEST(TextbookTracer, TheNearestHitWinsWhateverTheOrderOfTheShapes) {
  const std::array<std::string, 3> spheres{"define shape sphere near 0 0 -5 1 red\n",
                                           "define shape sphere middle 0 0 -10 1 green\n",
                                           "define shape box far -9 -9 -31 9 9 -30 blue\n"};
  std::array<std::size_t, 3> order{0, 1, 2};
  do {
    const std::string text = eye + glow("red", "1 0 0") + glow("green", "0 1 0") + glow("blue", "0 0 1") +
                             spheres[order[0]] + spheres[order[1]] + spheres[order[2]];
    EXPECT_EQ(look<TypeParam>(text), Rgb<TypeParam>(1, 0, 0));
  } while (std::next_permutation(order.begin(), order.end()));
}

TYPED_TEST(TextbookTracer, DistancesAreComparedInTheWorldNotInTheSpacesOfTheObjects) {
  // At t = 49 and at t = 900, which is 9 lengths of the large sphere's own space.
  EXPECT_EQ(
      look<TypeParam>(eye + glow("red", "1 0 0") + glow("blue", "0 0 1") +
                      "define shape sphere small 0 0 -50 1 red\ndefine shape sphere large 0 0 0 1 blue\n"
                      "transform large scale 100\ntransform large translate 0 0 -1000\n"),
      Rgb<TypeParam>(1, 0, 0));
}

TYPED_TEST(TextbookTracer, ARayThatHitsNothingSeesTheBackground) {
  EXPECT_EQ(look<TypeParam>(eye + "background 0.25 0.5 4\n" + glow("red", "1 0 0") +
                            "define shape sphere behind 0 0 5 1 red\n"),
            Rgb<TypeParam>(0.25, 0.5, 4));
}

TYPED_TEST(TextbookTracer, OfTwoSurfacesInOnePlaceTheFirstOfTheFileIsSeen) {
  const std::string red = "define shape sphere a 0 0 -5 1 red\n";
  const std::string blue = "define shape sphere b 0 0 -5 1 blue\n";
  const std::string start = eye + glow("red", "1 0 0") + glow("blue", "0 0 1");
  EXPECT_EQ(look<TypeParam>(start + red + blue), Rgb<TypeParam>(1, 0, 0));
  EXPECT_EQ(look<TypeParam>(start + blue + red), Rgb<TypeParam>(0, 0, 1));
}

TYPED_TEST(TextbookTracer, SurfacesThatRoundingAlonePutsApartAreInOnePlace) {
  // Turned and turned back, the blue ones are where the red ones are but for the rounding of the matrices.
  const Scene scene =
      read(eye + glow("red", "1 0 0") + glow("blue", "0 0 1") +
           "define shape box a -3 -1 -9 -0.5 1 -7 red\ndefine shape sphere b 1 0 -8 1.5 red\n"
           "define shape box c -3 -1 -9 -0.5 1 -7 blue\ndefine shape sphere d 1 0 -8 1.5 blue\n"
           "transform c rotate 30 1 2 3\ntransform c rotate -30 1 2 3\n"
           "transform d rotate 70 3 1 2\ntransform d rotate -70 3 1 2\n");
  const auto pixels = picture<TypeParam>(scene, 48, 32);
  EXPECT_EQ(std::count(pixels.begin(), pixels.end(), Rgb<TypeParam>(0, 0, 1)), 0);
  EXPECT_GT(std::count(pixels.begin(), pixels.end(), Rgb<TypeParam>(1, 0, 0)), 300);
}

// --- Ambient, Vollstaendiges Modell --------------------------------------------------------------

/// Seen from (0, 5, 5), the point (0, 0, 0) on a floor at y = 0, without ambient light.
const std::string above_the_floor =
    "camera eye 60 0 5 5 0 -1 -1 0 1 0\ndefine material matte 0 0 0 0.5 0.25 1 0 0 0 1\n"
    "define shape box floor -9 -1 -9 9 0 9 matte\n";
const std::string lamp = "define light lamp 0 10 0 1 1 1 1\n";

/// because the point is off by some 4 roundings of 7 units, and n.l by the square of that over 10 units; n.l,
/// product and sum round by 4 halves of an epsilon.
template <class Real>
constexpr double floor_tolerance = tests::ulps<Real>(2);

TYPED_TEST(TextbookTracer, ALightRightAboveGivesItsFullDiffuseLight) {
  expect_near(look<TypeParam>(above_the_floor + lamp), Rgb<TypeParam>(0.5, 0.25, 1),
              floor_tolerance<TypeParam>);
}

TYPED_TEST(TextbookTracer, LightsAreAddedAndColouredButAmbientLightCountsOnce) {
  const std::string text =
      "ambient 0.5 0.5 0.5\ncamera eye 60 0 5 5 0 -1 -1 0 1 0\ndefine material matte 0.5 0.5 0.5 0.5 0.25 1 "
      "0 0 0 1\n"
      "define shape box floor -9 -1 -9 9 0 9 matte\n" +
      lamp + "define light blue 0 4 0 0 0 1 0.5\n";
  // 0.25 + 0.5, 0.25 + 0.25, 0.25 + 1 + 0.5.
  expect_near(look<TypeParam>(text), Rgb<TypeParam>(0.75, 0.5, 1.75), floor_tolerance<TypeParam> * 2);
}

TYPED_TEST(TextbookTracer, ALightBelowTheFloorGivesNothing) {
  EXPECT_EQ(look<TypeParam>(above_the_floor + "define light lamp 0 -10 0 1 1 1 1\n"), Rgb<TypeParam>(0));
}

// --- Schatten ------------------------------------------------------------------------------------

constexpr std::array all_shadows{GlassShadow::full, GlassShadow::none, GlassShadow::filtered};

RenderOptions shadow_of_glass(GlassShadow shadow) {
  RenderOptions options;
  options.glass_shadow = shadow;
  return options;
}

TYPED_TEST(TextbookTracer, AnOpaqueObjectBetweenPointAndLightHidesIt) {
  for (const GlassShadow shadow : all_shadows) {
    EXPECT_EQ(look<TypeParam>(above_the_floor + lamp + "define shape sphere blocker 0 3 0 1 matte\n",
                              shadow_of_glass(shadow)),
              Rgb<TypeParam>(0));
  }
}

TYPED_TEST(TextbookTracer, AnObjectBeyondTheLightHidesNothing) {
  for (const GlassShadow shadow : all_shadows) {
    expect_near(look<TypeParam>(above_the_floor + lamp + "define shape sphere above 0 12 0 1 matte\n",
                                shadow_of_glass(shadow)),
                Rgb<TypeParam>(0.5, 0.25, 1), floor_tolerance<TypeParam>);
  }
}

TYPED_TEST(TextbookTracer, AnObjectBesideTheWayOfTheLightHidesNothing) {
  expect_near(look<TypeParam>(above_the_floor + lamp + "define shape sphere beside 1.5 3 0 1 matte\n"),
              Rgb<TypeParam>(0.5, 0.25, 1), floor_tolerance<TypeParam>);
}

TYPED_TEST(TextbookTracer, OneHiddenLightDoesNotHideTheOther) {
  // The second light shines past the blocker: from (0, 8, -8), at 45 degrees.
  const TypeParam cosine = std::sqrt(TypeParam(0.5));
  expect_near(look<TypeParam>(above_the_floor + lamp + "define light other 0 8 -8 1 1 1 1\n" +
                              "define shape sphere blocker 0 6 0 1 matte\n"),
              cosine * Rgb<TypeParam>(0.5, 0.25, 1),
              // because the point is off by 4 roundings of 7 units, of a light 11 units away, on a slope.
              tests::ulps<TypeParam>(8));
}

const std::string glass_above =
    "define material glass 0 0 0 0 0 0 0 0 0 1 transmit 0.5 0.25 1 eta 1.5\n"
    "define shape box sheet -1 2 -1 1 3 1 glass\n";

TYPED_TEST(TextbookTracer, GlassHidesTheLightAsInTheLecture) {
  EXPECT_EQ(look<TypeParam>(above_the_floor + lamp + glass_above), Rgb<TypeParam>(0));
}

TYPED_TEST(TextbookTracer, GlassWithoutShadowHidesNothing) {
  expect_near(look<TypeParam>(above_the_floor + lamp + glass_above, shadow_of_glass(GlassShadow::none)),
              Rgb<TypeParam>(0.5, 0.25, 1), floor_tolerance<TypeParam>);
}

TYPED_TEST(TextbookTracer, FilteringGlassMultipliesTheLightAtEverySurface) {
  // Two surfaces: (0.5, 0.25, 1)^2 * (0.5, 0.25, 1).
  expect_near(look<TypeParam>(above_the_floor + lamp + glass_above, shadow_of_glass(GlassShadow::filtered)),
              Rgb<TypeParam>(0.125, 0.015625, 1), floor_tolerance<TypeParam>);
}

TYPED_TEST(TextbookTracer, GlassBeyondTheLightFiltersNothing) {
  // A light inside the sheet: only its lower surface lies between.
  expect_near(look<TypeParam>(above_the_floor + "define light lamp 0 2.5 0 1 1 1 1\n" + glass_above,
                              shadow_of_glass(GlassShadow::filtered)),
              Rgb<TypeParam>(0.25, 0.0625, 1),
              floor_tolerance<TypeParam> * 10);  // because it is 4 times nearer
}

TYPED_TEST(TextbookTracer, WhatIsOpaqueBehindGlassStillHidesTheLight) {
  for (const GlassShadow shadow : all_shadows) {
    EXPECT_EQ(
        look<TypeParam>(above_the_floor + lamp + glass_above + "define shape sphere blocker 0 6 0 1 matte\n",
                        shadow_of_glass(shadow)),
        Rgb<TypeParam>(0));
  }
}

TYPED_TEST(TextbookTracer, ASurfaceDoesNotShadeItself) {
  // Every pixel of a sphere that is lit from the eye has light: no acne at grazing angles either.
  const Scene scene = read(
      "camera eye 30\ndefine material white 0 0 0 1 1 1 0 0 0 1\ndefine shape sphere ball 0 0 -5 1 white\n"
      "define light lamp 0 0 0 1 1 1 1\nbackground 2 2 2\n");
  const auto pixels = picture<TypeParam>(scene, 64, 64);
  EXPECT_EQ(std::count(pixels.begin(), pixels.end(), Rgb<TypeParam>(0)), 0);
  EXPECT_GT(std::count_if(pixels.begin(), pixels.end(), [](const auto& p) { return p.x < 2; }), 1000);
}

// --- Spiegelung, recursion -----------------------------------------------------------------------

TYPED_TEST(TextbookTracer, AMirrorShowsWhatTheReflectedRaySees) {
  // A mirror turned by 45 degrees about y has the normal (1, 0, 1): from -z to +x.
  const std::string text =
      eye + glow("silver", "0 0 0", "mirror 0.5 0.25 1") + glow("white", "1 1 1") + glow("red", "1 0 0") +
      "define shape box mirror -2 -2 -0.1 2 2 0.1 silver\ntransform mirror rotate 45 0 1 0\n"
      "transform mirror translate 0 0 -10\ndefine shape sphere right 10 0 -10 1 white\n"
      "define shape sphere left -10 0 -10 1 red\n";
  EXPECT_EQ(look<TypeParam>(text), Rgb<TypeParam>(0.5, 0.25, 1));
}

TYPED_TEST(TextbookTracer, AtDepthOneAMirrorIsBlackNotTheBackground) {
  const std::string text = eye + "background 1 1 1\n" + glow("silver", "0 0 0", "mirror 1 1 1") +
                           "define shape sphere s 0 0 -5 1 silver\n";
  EXPECT_EQ(look<TypeParam>(text, depth(1)), Rgb<TypeParam>(0));
  EXPECT_EQ(look<TypeParam>(text, depth(2)), Rgb<TypeParam>(1));
}

TYPED_TEST(TextbookTracer, BetweenTwoMirrorsEveryLevelAddsOneReflection) {
  const std::string text =
      eye + glow("silver", "0.5 0.5 0.5", "mirror 0.5 0.5 0.5") +
      "define shape box front -1 -1 -5 1 1 -4 silver\ndefine shape box back -1 -1 4 1 1 5 silver\n";
  for (int levels = 1; levels <= 20; ++levels) {
    // 1/2 + 1/4 + ... + 2^-D = 1 - 2^-D: exact.
    EXPECT_EQ(look<TypeParam>(text, depth(levels)), Rgb<TypeParam>(1 - std::ldexp(TypeParam(1), -levels)))
        << levels;
  }
}

// --- Brechung --------------------------------------------------------------------------------------

TYPED_TEST(TextbookTracer, ASheetOfGlassShiftsTheRay) {
  // From 0 at 30 degrees to a sheet from z = -1 to -3 of index 1.5: sin t = 1/3, tan t = 1 / sqrt(8). Behind
  // it the ray is parallel again: at z = -5 it has come 3 tan 30 + 2 / sqrt(8) to the right; unbent, 5
  // tan 30.
  const double bent = (1 + 2) * std::tan(std::numbers::pi / 6) + 2 / std::sqrt(8.0);
  const double unbent = 5 * std::tan(std::numbers::pi / 6);
  ASSERT_GT(unbent - bent, 0.3);
  const std::string text =
      "ambient 1 1 1\ncamera eye 60 0 0 0 0.5 0 " + std::to_string(-std::sqrt(0.75)) + " 0 1 0\n" +
      glow("glass", "0 0 0", "transmit 0.5 0.25 1 eta 1.5") + glow("white", "1 1 1") + glow("red", "1 0 0") +
      "define shape box sheet -9 -9 -3 9 9 -1 glass\n" + "define shape sphere there " + std::to_string(bent) +
      " 0 -5 0.01 white\n" + "define shape sphere straight_on " + std::to_string(unbent) + " 0 -5 0.1 red\n";
  // Two surfaces: (0.5, 0.25, 1)^2.
  EXPECT_EQ(look<TypeParam>(text), Rgb<TypeParam>(0.25, 0.0625, 1));
}

TYPED_TEST(TextbookTracer, AnEyeInsideGlassLooksOutByTheIndexOfTheGlass) {
  // At 30 degrees out of a box up to z = -1 of index 1.5: sin t = 0.75.
  const double sine = 0.75;
  const double x = std::tan(std::numbers::pi / 6) + 4 * sine / std::sqrt(1 - sine * sine);
  const std::string text = "ambient 1 1 1\ncamera eye 60 0 0 0 0.5 0 " + std::to_string(-std::sqrt(0.75)) +
                           " 0 1 0\n" + glow("glass", "0 0 0", "transmit 0.5 0.5 0.5 eta 1.5") +
                           glow("white", "1 1 1") +
                           "define shape box around -9 -9 -1 9 9 1 glass\ndefine shape sphere there " +
                           std::to_string(x) + " 0 -5 0.01 white\n";
  EXPECT_EQ(look<TypeParam>(text), Rgb<TypeParam>(0.5));
}

/// From within glass of index 1.5 the ray meets the face z = -1 at 60 degrees (critical are 41.8), and is
/// reflected to the face x = 4, which it meets at 30 degrees and leaves.
const std::string trapped =
    "ambient 1 1 1\nbackground 1 1 1\ncamera eye 60 0 0 0 0.8660254037844386 0 -0.5 0 1 0\n";
const std::string around_the_eye = "define shape box glass -4 -4 -1 4 4 1 glass\n";

TYPED_TEST(TextbookTracer, TotalReflectionHasWeightOneAndReplacesMirrorAndRefraction) {
  const std::string text =
      trapped + glow("glass", "0.25 0.25 0.25", "transmit 0.125 0.125 0.125 mirror 0.5 0.5 0.5 eta 1.5") +
      around_the_eye;
  EXPECT_EQ(look<TypeParam>(text, depth(1)), Rgb<TypeParam>(0.25));
  EXPECT_EQ(look<TypeParam>(text, depth(2)), Rgb<TypeParam>(0.25 + 0.25));
}

TYPED_TEST(TextbookTracer, AfterTotalReflectionTheRayIsStillInsideTheGlass) {
  // Once out through x = 4 it sees the background with the weight of that surface alone.
  const std::string text =
      trapped + glow("glass", "0.25 0.25 0.25", "transmit 0.125 0.125 0.125 eta 1.5") + around_the_eye;
  EXPECT_EQ(look<TypeParam>(text, depth(3)), Rgb<TypeParam>(0.25 + 0.25 + 0.125));
}

std::string row_of_boxes(int count, const std::string& material) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    const std::string n = std::to_string(i);
    text += "define shape box b" + n + " -1 -1 " + std::to_string(-2 - 2 * i) + " 1 1 " +
            std::to_string(-1 - 2 * i) + " " + material + "\n";
  }
  return text;
}

TYPED_TEST(TextbookTracer, SurfacesOfRatioOneCountNoDepth) {
  const std::string text = eye + glow("air", "0 0 0", "transmit 0.5 0.5 0.5 eta 1") + glow("white", "1 1 1") +
                           row_of_boxes(3, "air") + "define shape box wall -9 -9 -100 9 9 -99 white\n";
  // Six surfaces, each of weight 1/2.
  EXPECT_EQ(look<TypeParam>(text, depth(2)), Rgb<TypeParam>(std::ldexp(TypeParam(1), -6)));
}

TYPED_TEST(TextbookTracer, ASurfaceOfRatioOneIsBlackOnTheLastLevel) {
  const std::string text =
      eye + "background 1 1 1\n" + glow("air", "0 0 0", "transmit 1 1 1 eta 1") + row_of_boxes(1, "air");
  EXPECT_EQ(look<TypeParam>(text, depth(1)), Rgb<TypeParam>(0));
}

TYPED_TEST(TextbookTracer, EqualGlassInGlassIsCrossedUnbentAndWithoutDepth) {
  const std::string text =
      eye + glow("glass", "0 0 0", "transmit 1 1 1 eta 1.5") + glow("white", "1 1 1") +
      "define shape box outer -2 -2 -6 2 2 -2 glass\ndefine shape box inner -1 -1 -5 1 1 -3 glass\n"
      "define shape box wall -9 -9 -100 9 9 -99 white\n";
  // Two surfaces bend (into the outer, out of it), two do not: the wall is seen on the third level.
  EXPECT_EQ(look<TypeParam>(text, depth(2)), Rgb<TypeParam>(0));
  EXPECT_EQ(look<TypeParam>(text, depth(3)), Rgb<TypeParam>(1));
}

TYPED_TEST(TextbookTracer, ThroughGlassOfIndexOneAllIsSeenAsWithoutIt) {
  const std::string behind =
      "ambient 1 1 1\ncamera eye 60\n" + glow("red", "1 0.5 0.25") + glow("blue", "0 0.5 1") +
      "define shape sphere ball 1 0.5 -20 4 red\ndefine shape box box -6 -6 -22 -1 3 -16 blue\n";
  const std::string glass =
      glow("air", "0 0 0", "transmit 1 1 1 eta 1") +
      "define shape sphere lens 0.5 0 -6 2 air\ndefine shape box cube -3 -3 -9 0 0 -4 air\n"
      "transform cube rotate 30 1 1 0\n";
  const auto plain = picture<TypeParam>(read(behind), 32, 32);
  EXPECT_EQ(picture<TypeParam>(read(behind + glass), 32, 32), plain);
  EXPECT_GT(std::count(plain.begin(), plain.end(), Rgb<TypeParam>(1, 0.5, 0.25)), 20);
}

TYPED_TEST(TextbookTracer, AThousandSurfacesOfRatioOneAreCrossedAndMoreAreRefused) {
  const std::string start = eye + "background 1 1 1\n" + glow("air", "0 0 0", "transmit 1 1 1 eta 1");
  EXPECT_EQ(look<TypeParam>(start + row_of_boxes(500, "air")), Rgb<TypeParam>(1));
  // One more: the eye is in a box, too.
  EXPECT_THROW(
      look<TypeParam>(start + "define shape box around -1 -1 -0.5 1 1 0.5 air\n" + row_of_boxes(500, "air")),
      std::runtime_error);
}

// --- Objekttransformation, Composite, DAG ----------------------------------------------------------

TYPED_TEST(TextbookTracer, ASharedChildIsTheSameAsTwoCopies) {
  // Powers of two and one translation a path: neither way of writing it rounds anything else.
  const std::string start =
      "ambient 0.2 0.2 0.2\nbackground 0.1 0.2 0.3\ncamera eye 60\ndefine light key 4 8 5 1 1 1 1\n"
      "define material red 1 0.2 0.2 1 0.2 0.2 0.5 0.5 0.5 20\n"
      "define material silver 0.1 0.1 0.1 0.2 0.2 0.2 0.5 0.5 0.5 50 mirror 0.5 0.5 0.5\n";
  const Scene dag =
      read(start +
           "define shape sphere ball 0.5 0.25 0 0.5 red\ndefine shape box cube -1 -1 -1 0 0 0 silver\n"
           "transform ball scale 2 1 1\ndefine shape composite pair ball cube\n"
           "define shape composite left pair\ndefine shape composite right pair\n"
           "transform left scale 1 2 1\ntransform left translate -2 0 -8\n"
           "transform right scale -0.5\ntransform right translate 2 0 -6\n");
  const Scene flat =
      read(start +
           "define shape sphere ball1 0.5 0.25 0 0.5 red\ndefine shape box cube1 -1 -1 -1 0 0 0 silver\n"
           "define shape sphere ball2 0.5 0.25 0 0.5 red\ndefine shape box cube2 -1 -1 -1 0 0 0 silver\n"
           "transform ball1 scale 2 1 1\ntransform ball1 scale 1 2 1\ntransform ball1 translate -2 0 -8\n"
           "transform cube1 scale 1 2 1\ntransform cube1 translate -2 0 -8\n"
           "transform ball2 scale 2 1 1\ntransform ball2 scale -0.5\ntransform ball2 translate 2 0 -6\n"
           "transform cube2 scale -0.5\ntransform cube2 translate 2 0 -6\n");
  const auto pixels = picture<TypeParam>(dag, 48, 32);
  EXPECT_EQ(pixels, picture<TypeParam>(flat, 48, 32));
  const Rgb<TypeParam> background(dag.background);
  EXPECT_GT(std::count_if(pixels.begin(), pixels.end(), [&](const auto& p) { return p != background; }), 100);
}

TYPED_TEST(TextbookTracer, TheNormalComesThroughTheMatricesOfAllNestedComposites) {
  // A plate faces z; turned by 45 degrees about x its normal is (0, -1, 1); twice as long along y (0, -1/2,
  // 1); turned by 90 degrees about z (1/2, 0, 1). The light at the eye shines along z: n.l = 2 / sqrt(5).
  const std::string text =
      "camera eye 60\ndefine material white 0 0 0 1 1 1 0 0 0 1\ndefine light lamp 0 0 0 1 1 1 1\n"
      "define shape box plate -2 -2 -0.125 2 2 0.125 white\ntransform plate rotate 45 1 0 0\n"
      "define shape composite inner plate\ntransform inner scale 1 2 1\n"
      "define shape composite outer inner\ntransform outer rotate 90 0 0 1\ntransform outer translate 0 0 "
      "-5\n";
  // because two rotations are off by 4 epsilons each, and normalising and the product add 4.
  expect_near(look<TypeParam>(text), Rgb<TypeParam>(2 / std::sqrt(TypeParam(5))), tests::ulps<TypeParam>(12));
}

/// An ellipsoid of half axes 2, 1, 1/2 about (0.25, -0.5, -8), and a light at (3, 4, 0).
const std::string ellipsoid =
    "camera eye 40\ndefine material white 0 0 0 1 1 1 0 0 0 1\nbackground 5 5 5\ndefine light lamp 3 4 0 1 1 "
    "1 1\n"
    "define shape sphere ball 0 0 0 1 white\ntransform ball scale 2 1 0.5\ntransform ball translate 0.25 "
    "-0.5 -8\n";

/// Its implicit equation q(p) = sum (p_i - c_i)^2 / a_i^2 - 1 and its gradient, in the world, by hand.
struct Ellipsoid {
  Vec3<Exact> center{Exact(0.25), Exact(-0.5), -8};
  Vec3<Exact> axes{2, 1, Exact(0.5)};

  /// b^2 - a c of the quadratic equation along t d from the origin.
  Exact discriminant(const Vec3<Exact>& d) const {
    const Vec3<Exact> e = d / axes;
    const Vec3<Exact> o = -center / axes;
    return glm::dot(o, e) * glm::dot(o, e) - glm::dot(e, e) * (glm::dot(o, o) - 1);
  }
  Vec3<Exact> hit(const Vec3<Exact>& d) const {
    const Vec3<Exact> e = d / axes;
    const Vec3<Exact> o = -center / axes;
    return d * ((-glm::dot(o, e) - std::sqrt(discriminant(d))) / glm::dot(e, e));
  }
  Vec3<Exact> normal(const Vec3<Exact>& p) const { return glm::normalize((p - center) / (axes * axes)); }
};

constexpr int width = 60;
constexpr int height = 40;

/// Of the pixel, by the camera of the lecture: eye at 0, along -z, a plane of width 1.
Vec3<Exact> direction(int x, int y) {
  const Exact distance = Exact(0.5) / std::tan(20 * std::numbers::pi_v<Exact> / 180);
  return glm::normalize(Vec3<Exact>((x + Exact(0.5)) / width - Exact(0.5),
                                    (Exact(height) / 2 - y - Exact(0.5)) / width, -distance));
}

TYPED_TEST(TextbookTracer, AScaledSphereHasTheOutlineOfAnEllipsoid) {
  const auto pixels = picture<TypeParam>(read(ellipsoid), width, height);
  int hits = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Exact discriminant = Ellipsoid{}.discriminant(direction(x, y));
      // because b^2 and a c are at most 16^2 * 4 = 1024 and take 13 roundings of half an epsilon.
      if (std::abs(discriminant) < static_cast<Exact>(tests::ulps<TypeParam>(7)) * 1024) continue;
      const bool is_hit = pixels[static_cast<std::size_t>(y * width + x)] != Rgb<TypeParam>(5);
      EXPECT_EQ(is_hit, discriminant > 0) << x << " " << y;
      hits += is_hit ? 1 : 0;
    }
  }
  EXPECT_GT(hits, 300);
  EXPECT_LT(hits, width * height - 300);
}

TYPED_TEST(TextbookTracer, TheNormalsOfAScaledSphereAreTheGradientsOfTheEllipsoid) {
  const auto pixels = picture<TypeParam>(read(ellipsoid), width, height);
  int lit = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Vec3<Exact> d = direction(x, y);
      if (Ellipsoid{}.discriminant(d) < Exact(0.05)) continue;  // near the outline rounding moves the hit
      const Vec3<Exact> point = Ellipsoid{}.hit(d);
      const Vec3<Exact> n = Ellipsoid{}.normal(point);
      const Exact lambert = std::max(Exact(0), glm::dot(n, glm::normalize(Vec3<Exact>(3, 4, 0) - point)));
      // because 13 roundings of the coefficients, up to 1024, move t by that over twice the root of 0.05 and
      // over d.d / a^2 > 1 / 4, and n turns by at most max a / min a^2 = 8 a unit; a shadow's edge lies at
      // n.l = 0.
      const double tolerance = tests::ulps<TypeParam>(7) * 1024 / (2 * std::sqrt(0.05)) * 8;
      EXPECT_NEAR(static_cast<double>(pixels[static_cast<std::size_t>(y * width + x)].y),
                  static_cast<double>(lambert), tolerance)
          << x << " " << y;
      lit += lambert > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(lit, 200);
}

// --- the whole picture -----------------------------------------------------------------------------

TEST(TextbookRender, AnyNumberOfThreadsGivesTheSamePicture) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const auto random = tests::random_scene(seed);
    const Image one = rendered(random.scene, 40, 30, RealType::float64, 1, random.options);
    EXPECT_EQ(rendered(random.scene, 40, 30, RealType::float64, 2, random.options).rgb, one.rgb) << seed;
    EXPECT_EQ(rendered(random.scene, 40, 30, RealType::float64, 7, random.options).rgb, one.rgb) << seed;
    EXPECT_EQ(rendered(random.scene, 40, 30, RealType::float64, 0, random.options).rgb, one.rgb) << seed;
  }
}

TEST(TextbookRender, MoreThreadsThanRowsAreNoTrouble) {
  const auto random = tests::random_scene(3);
  EXPECT_EQ(rendered(random.scene, 5, 2, RealType::float64, 64).rgb, rendered(random.scene, 5, 2).rgb);
}

TEST(TextbookRender, ProgressRisesToOne) {
  const auto random = tests::random_scene(3);
  RenderJob job;
  job.width = 4;
  job.height = 10;
  job.threads = 3;
  std::vector<double> reported;
  job.progress = [&](double done) { reported.push_back(done); };
  render(random.scene, random.scene.cameras.at(0), job);
  ASSERT_EQ(reported.size(), 10U);
  EXPECT_TRUE(std::is_sorted(reported.begin(), reported.end()));
  EXPECT_EQ(reported.back(), 1);
}

TEST(TextbookRender, AnErrorInAThreadReachesTheCaller) {
  const Scene scene = read(eye + glow("air", "0 0 0", "transmit 1 1 1 eta 1") + row_of_boxes(501, "air"));
  EXPECT_THROW(rendered(scene, 3, 9, RealType::float64, 4), std::runtime_error);
}

TEST(TextbookRender, TheReplaceableFormulasOfTheLectureGiveThePictureOfTheFixedOnes) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const auto random = tests::random_scene(seed);
    const Image fixed = rendered(random.scene, 24, 16, RealType::float64, 1, random.options);
    const auto replaceable = picture<double>(random.scene, 24, 16, {}, random.options);
    for (std::size_t i = 0; i < replaceable.size(); ++i) {
      for (int channel = 0; channel < 3; ++channel) {
        ASSERT_EQ(fixed.rgb[3 * i + static_cast<std::size_t>(channel)],
                  static_cast<float>(replaceable[i][channel]))
            << "seed " << seed << " pixel " << i;
      }
    }
  }
}

/// Pixels of which a channel differs by more than the tolerance.
int differing(const Image& a, const Image& b, float tolerance) {
  int count = 0;
  for (std::size_t i = 0; i < a.rgb.size(); i += 3) {
    float most = 0;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      most = std::max(most, std::abs(a.rgb[i + channel] - b.rgb[i + channel]));
    }
    count += most <= tolerance ? 0 : 1;
  }
  return count;
}

TEST(TextbookRender, DoubleAndLongDoubleAgree) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const auto random = tests::random_scene(seed);
    const Image a = rendered(random.scene, 32, 24, RealType::float64, 1, random.options);
    const Image b = rendered(random.scene, 32, 24, RealType::long_double, 1, random.options);
    // because colours up to 8 are rounded to float32, by 2^-22; double's own error, 1e-16 enlarged by some
    // 10^3 at every one of up to 9 curved surfaces, is rarely seen. A pixel whose ray passes an edge within
    // 1e-13 would differ, one in 10^10.
    EXPECT_EQ(differing(a, b, 1e-6F), 0) << seed;
  }
}

TEST(TextbookRender, DoubleAndQuadAgree) {
  for (unsigned seed = 21; seed <= 25; ++seed) {
    const auto random = tests::random_scene(seed);
    const Image a = rendered(random.scene, 16, 12, RealType::float64, 1, random.options);
    const Image b = rendered(random.scene, 16, 12, RealType::quad, 1, random.options);
    // because of what DoubleAndLongDoubleAgree says
    EXPECT_EQ(differing(a, b, 1e-6F), 0) << seed;
  }
}

TEST(TextbookRender, FloatAndDoubleAgreeExceptAtEdges) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const auto random = tests::random_scene(seed);
    RenderOptions options = random.options;
    options.depth = std::min(options.depth, 2);  // deeper, curved glass enlarges float's error without bound
    const Image a = rendered(random.scene, 32, 24, RealType::float32, 1, options);
    const Image b = rendered(random.scene, 32, 24, RealType::float64, 1, options);
    // because float is off by 1e-7 times some 10^3 of distance, curvature and an exponent of up to 400; an
    // edge is uncertain by 1e-5 pixels: one or two in a picture for all that.
    EXPECT_LE(differing(a, b, 2e-3F), 2) << seed;
  }
}

/// The scene with every length multiplied.
Scene scaled(Scene scene, double by) {
  const auto scale_steps = [&](std::vector<TransformStep>& steps) {
    for (TransformStep& step : steps) {
      if (auto* t = std::get_if<Translate>(&step)) t->by *= by;
    }
  };
  for (plumb::Shape& shape : scene.shapes) {
    scale_steps(shape.transform);
    if (auto* s = std::get_if<plumb::Sphere>(&shape.geometry)) {
      s->center *= by;
      s->radius *= by;
    }
    if (auto* b = std::get_if<plumb::Box>(&shape.geometry)) {
      b->min *= by;
      b->max *= by;
    }
  }
  for (plumb::Light& light : scene.lights) light.position *= by;
  for (Camera& camera : scene.cameras) {
    camera.eye *= by;
    scale_steps(camera.transform);
  }
  return scene;
}

TEST(TextbookRender, EveryScaleGivesTheSamePicture) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const auto random = tests::random_scene(seed);
    for (const RealType real : {RealType::float32, RealType::float64}) {
      const Image plain = rendered(random.scene, 24, 16, real, 1, random.options);
      for (const int exponent : {-20, 20}) {
        const Image other =
            rendered(scaled(random.scene, std::ldexp(1, exponent)), 24, 16, real, 1, random.options);
        EXPECT_EQ(other.rgb, plain.rgb) << seed;  // because a power of two rounds nothing
      }
    }
  }
}

// --- replacing one formula ---------------------------------------------------------------------------

template <class Real>
class ReplacedFormula : public testing::Test {
 protected:
  FormulaTable<Real> table_;
};
TYPED_TEST_SUITE(ReplacedFormula, tests::Reals);

const std::string ball_before_a_wall =
    eye + glow("red", "1 0 0") + glow("blue", "0 0 1") + "background 4 4 4\n" +
    "define shape sphere ball 0 0 -5 1 red\ndefine shape box wall -9 -9 -11 9 9 -10 blue\n";

TYPED_TEST(ReplacedFormula, SpheresThatAreNeverMetVanishAndBoxesStay) {
  using Real = TypeParam;
  this->table_.intersect_sphere = [](const Ray<Real>&, const Vec3<Real>&, Real, bool) -> std::optional<Real> {
    return std::nullopt;
  };
  EXPECT_EQ(look<Real>(ball_before_a_wall), Rgb<Real>(1, 0, 0));
  EXPECT_EQ(look<Real>(ball_before_a_wall, {}, this->table_), Rgb<Real>(0, 0, 1));
}

TYPED_TEST(ReplacedFormula, WhenNothingIsMetAllIsBackground) {
  using Real = TypeParam;
  this->table_.intersect_sphere = [](const Ray<Real>&, const Vec3<Real>&, Real, bool) -> std::optional<Real> {
    return std::nullopt;
  };
  this->table_.intersect_box = [](const Ray<Real>&, const Corners<Real>&,
                                  Face) -> std::optional<FaceHit<Real>> { return std::nullopt; };
  const auto pixels = picture<Real>(read(ball_before_a_wall), 8, 8, this->table_);
  EXPECT_EQ(std::count(pixels.begin(), pixels.end(), Rgb<Real>(4)), 64);
}

TYPED_TEST(ReplacedFormula, ANormalThatIsNotTurnedDarkensTheInsideAlone) {
  using Real = TypeParam;
  this->table_.facing_normal = [](const Vec3<Real>& n, const Vec3<Real>&) { return n; };
  const std::string lit =
      "define material white 0 0 0 1 1 1 0 0 0 1\ndefine light lamp 0 0 0 1 1 1 1\ncamera eye 60\n";
  const std::string outside = lit + "define shape sphere ball 0 0 -5 1 white\n";
  const std::string inside = lit + "define shape sphere room 0 0 0 5 white\n";
  EXPECT_EQ(picture<Real>(read(outside), 16, 16, this->table_), picture<Real>(read(outside), 16, 16));
  // because n.l is 1 but for 4 roundings of the unit vectors.
  expect_near(look<Real>(inside), Rgb<Real>(1), tests::ulps<Real>(2));
  EXPECT_EQ(look<Real>(inside, {}, this->table_), Rgb<Real>(0));
}

const std::string shiny = "ambient 0.5 0.5 0.5\ncamera eye 40\ndefine light lamp 3 4 0 1 0.5 0.25 1\n";
const std::string shiny_ball = "define shape sphere ball 0 0 -5 1 m\n";

TYPED_TEST(ReplacedFormula, WithoutSpecularFactorTheKsIsGone) {
  using Real = TypeParam;
  this->table_.specular_factor = [](const Vec3<Real>&, const Vec3<Real>&, const Vec3<Real>&, Real) {
    return Real(0);
  };
  const Scene with = read(shiny + "define material m 0.1 0.2 0.3 0.4 0.5 0.6 0.7 0.8 0.9 5\n" + shiny_ball);
  const Scene without = read(shiny + "define material m 0.1 0.2 0.3 0.4 0.5 0.6 0 0 0 5\n" + shiny_ball);
  EXPECT_EQ(picture<Real>(with, 16, 16, this->table_), picture<Real>(without, 16, 16));
  EXPECT_NE(picture<Real>(with, 16, 16), picture<Real>(without, 16, 16));
}

TYPED_TEST(ReplacedFormula, WithoutBlockersThereAreNoShadows) {
  using Real = TypeParam;
  this->table_.blocks_light = [](Real, Real) { return false; };
  const std::string blocker = "define shape sphere blocker 0 6 0 1 matte\n";  // above the picture
  const Scene with = read(above_the_floor + lamp + blocker);
  const Scene without = read(above_the_floor + lamp);
  EXPECT_EQ(picture<Real>(with, 16, 16, this->table_), picture<Real>(without, 16, 16));
  EXPECT_NE(picture<Real>(with, 16, 16), picture<Real>(without, 16, 16));
}

TYPED_TEST(ReplacedFormula, AWrongMirrorChangesMirrorsAlone) {
  using Real = TypeParam;
  this->table_.mirror_direction = [](const Vec3<Real>& d, const Vec3<Real>&) { return -d; };
  const std::string white = glow("white", "1 1 1") + "define shape box behind -9 -9 8 9 9 9 white\n";
  const Scene matte =
      read(shiny + white + "define material m 0.1 0.2 0.3 0.4 0.5 0.6 0.7 0.8 0.9 5\n" + shiny_ball);
  const Scene mirror = read(
      shiny + white + "define material m 0.1 0.2 0.3 0.4 0.5 0.6 0.7 0.8 0.9 5 mirror 1 1 1\n" + shiny_ball);
  EXPECT_EQ(picture<Real>(matte, 16, 16, this->table_), picture<Real>(matte, 16, 16));
  EXPECT_NE(picture<Real>(mirror, 16, 16, this->table_), picture<Real>(mirror, 16, 16));
}

TYPED_TEST(ReplacedFormula, AWrongTransformOfNormalsChangesTheShadingButNoOutline) {
  using Real = TypeParam;
  this->table_.transform_normal = [](const Mat4<Real>&, const Vec3<Real>& n) { return n; };
  const auto right = picture<Real>(read(ellipsoid), 24, 16);
  const auto wrong = picture<Real>(read(ellipsoid), 24, 16, this->table_);
  int changed = 0;
  for (std::size_t i = 0; i < right.size(); ++i) {
    EXPECT_EQ(right[i] == Rgb<Real>(5), wrong[i] == Rgb<Real>(5)) << i;
    changed += right[i] == wrong[i] ? 0 : 1;
  }
  EXPECT_GT(changed, 10);
}

TYPED_TEST(ReplacedFormula, TheFullAngleForTheHalfOneIsAnotherFieldOfView) {
  using Real = TypeParam;
  this->table_.image_plane_distance = [](Real fov) { return formulas::image_plane_distance(2 * fov); };
  const std::string rest = glow("red", "1 0 0") + "ambient 1 1 1\ndefine shape sphere ball 1 1 -5 1 red\n";
  EXPECT_EQ(picture<Real>(read("camera eye 40\n" + rest), 16, 16, this->table_),
            picture<Real>(read("camera eye 80\n" + rest), 16, 16));
}

}  // namespace
}  // namespace plumb::textbook
