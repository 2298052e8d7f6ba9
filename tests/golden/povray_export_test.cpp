// The exported scene description, letter for letter.
#include "exporters/povray.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "exporters/povray_material.hpp"
#include "tests/support/random_scene.hpp"
#include "tracer/format/reader.hpp"
#include "tracer/format/writer.hpp"
#include "tracer/text/numbers.hpp"

namespace plumb::tests {
namespace {

Scene scene_of(const std::string& text) {
  ReadResult result = read_scene(text);
  if (result.has_errors()) throw std::invalid_argument(to_string(result.findings.front(), "scene"));
  return std::move(result.scene);
}

std::string exported(const Scene& scene, const RenderOptions& options = {}) {
  return exporters::export_povray({scene, scene.cameras.front(), 64, 48, options}).text;
}

std::string exported(const std::string& scene, const RenderOptions& options = {}) {
  return exported(scene_of(scene), options);
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

/// What is to be expected is renewed by `plumb export SCENE --size 64x48 | tail -n +2`, and by looking hard
/// at what changed: then the stored reference images have to be rendered again, too.
void expect_export(const std::string& scene_text, const std::string& expected, bool needs_flat_objects) {
  const Scene scene = scene_of(scene_text);
  const auto result = exporters::export_povray({scene, scene.cameras.front(), 64, 48});
  EXPECT_EQ(result.text, expected);
  EXPECT_EQ(result.needs_flat_objects, needs_flat_objects);
}

// clang-format off
/// A sphere and a light: no background, no ambient light, no caster, no interior.
TEST(PovrayExport, ASphere) {
  expect_export(R"(
define material plain 0 0 0 0.5 0.25 1 0 0 0 0
define shape sphere ball 0 0 -4 1 plain
define light lamp 3 4 0 0.5 0.5 1 2
define camera eye 90
)",
                R"(// Exported by plumb. One unit of the scene is 2048 units here.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 8 adc_bailout 0 }
camera { perspective location <0,0,0> direction <0,0,-0.5000000000000001> right <1,-0,0> up <0,0.75,0> }
light_source { <6144,8192,0>, rgb <1,1,2> }
#declare Material_0 = // plain
  texture { pigment { rgb <0.5,0.25,1> } finish { ambient 0 diffuse 1 } }
sphere { <0,0,-8192>, 2048 texture { Material_0 } } // ball
)", false);
}

/// Glass in front of a box: layers for a coloured highlight, and a black caster of the full shadow beside the glass.
TEST(PovrayExport, GlassWithAFullShadow) {
  expect_export(R"(
define material red 0.5 0 0 0.5 0.25 0.125 0.25 0.25 0.25 8
define material glass 0 0 0 0 0 0 0.5 0 0.25 16 mirror 0.125 0.25 0.5 transmit 0.5 1 0.75 eta 1.5
define shape box block -1 -1 -6 1 1 -4 red
define shape sphere lens 0 0 -3 0.5 glass
define light lamp 0 8 0 1 1 1 1
ambient 0.5 0.5 0.25
background 0.125 0.25 0.5
define camera eye 90
)",
                R"(// Exported by plumb. One unit of the scene is 2048 units here.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 8 adc_bailout 0 }
background { rgb <0.125,0.25,0.5> }
camera { perspective location <0,0,0> direction <0,0,-0.5000000000000001> right <1,-0,0> up <0,0.75,0> }
light_source { <0,16384,0>, rgb <1,1,1> }
#declare Material_0 = // red
  texture { pigment { rgb <1,0.5,0.25> } finish { ambient 0 diffuse 1 } }
  texture { pigment { rgbt <0.5,0,0,0.5> } finish { ambient 0 diffuse 0 emission 1 phong 0.25 phong_size 8 } }
#declare Material_1 = // glass
  texture { pigment { rgbf <1,1152921504606846976,3,1> } finish { ambient 0 diffuse 0 phong 1 phong_size 16 } }
  texture { pigment { rgbf <0.5,8.673617379884035e-19,0.25,1> } finish { ambient 0 diffuse 0 reflection { rgb <0.125,0.25,0.5> } } }
#declare Caster = texture { pigment { rgb 0 } finish { ambient 0 diffuse 0 } }
box { <-2048,-2048,-12288>, <2048,2048,-8192> texture { Material_0 } } // block
sphere { <0,0,-6144>, 1024 texture { Material_1 } interior { ior 1.5 } no_shadow } sphere { <0,0,-6144>, 1024 texture { Caster } no_image no_reflection } // lens
)", false);
}

/// Composites with shared children: each is declared once, and one of a single child is no union.
TEST(PovrayExport, SharedComposites) {
  expect_export(R"(
define material plain 0 0 0 0.5 0.5 0.5 0 0 0 0
define shape sphere ball 0 0 0 1 plain
define shape box block -1 -1 -1 1 1 1 plain
define shape composite pair ball block
define shape composite left ball
define shape composite all pair left
define shape composite again pair
transform block scale 0.5 -2 1
transform pair translate 2 0 0
transform left translate -2 0 0
transform all translate 0 0 -10
transform again scale -1 1 0.25
transform again translate 0 4 -16
define light lamp 0 8 0 1 1 1 1
define camera eye 90
)",
                R"(// Exported by plumb. One unit of the scene is 512 units here.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 8 adc_bailout 0 }
camera { perspective location <0,0,0> direction <0,0,-0.5000000000000001> right <1,-0,0> up <0,0.75,0> }
light_source { <0,4096,0>, rgb <1,1,1> }
#declare Material_0 = // plain
  texture { pigment { rgb <0.5,0.5,0.5> } finish { ambient 0 diffuse 1 } }
#declare Composite_2 = union { // pair
  sphere { <0,0,0>, 512 texture { Material_0 } }
  box { <-512,-512,-512>, <512,512,512> texture { Material_0 } matrix <0.5,0,0,0,-2,0,0,0,1,0,0,0> }
}
#declare Composite_3 = // left
  sphere { <0,0,0>, 512 texture { Material_0 } }
#declare Composite_4 = union { // all
  object { Composite_2 translate <1024,0,0> }
  object { Composite_3 translate <-1024,0,0> }
}
#declare Composite_5 = // again
  object { Composite_2 translate <1024,0,0> }
object { Composite_4 translate <0,0,-5120> } // all
object { Composite_5 matrix <-1,0,0,0,1,0,0,0,0.25,0,2048,-8192> } // again
)", false);
}

/// The eye in two spheres of glass: all casters first, then the glass outermost first.
TEST(PovrayExport, TheEyeInsideGlass) {
  expect_export(R"(
define material clear 0 0 0 0 0 0 0 0 0 0 transmit 1 1 1 eta 1.25
define material dense 0 0 0 0 0 0 0 0 0 0 transmit 0.5 0.5 0.5 eta 1.5
define material plain 0 0 0 0.5 0.5 0.5 0 0 0 0
define shape box wall -4 -4 -9 4 4 -8 plain
define shape sphere inner 0 0 0 1 dense
define shape sphere outer 0 0 0 2 clear
define light lamp 0 6 0 1 1 1 1
define camera eye 90
)",
                R"(// Exported by plumb. One unit of the scene is 1024 units here.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 8 adc_bailout 0 }
camera { perspective location <0,0,0> direction <0,0,-0.5000000000000001> right <1,-0,0> up <0,0.75,0> }
light_source { <0,6144,0>, rgb <1,1,1> }
#declare Material_0 = // clear
  texture { pigment { rgbf <1,1,1,1> } finish { ambient 0 diffuse 0 } }
#declare Material_1 = // dense
  texture { pigment { rgbf <0.5,0.5,0.5,1> } finish { ambient 0 diffuse 0 } }
#declare Material_2 = // plain
  texture { pigment { rgb <0.5,0.5,0.5> } finish { ambient 0 diffuse 1 } }
#declare Caster = texture { pigment { rgb 0 } finish { ambient 0 diffuse 0 } }
sphere { <0,0,0>, 1024 texture { Caster } no_image no_reflection } // inner
sphere { <0,0,0>, 2048 texture { Caster } no_image no_reflection } // outer
sphere { <0,0,0>, 2048 texture { Material_0 } interior { ior 1.25 } no_shadow } // outer
sphere { <0,0,0>, 1024 texture { Material_1 } interior { ior 1.5 } no_shadow } // inner
box { <-4096,-4096,-9216>, <4096,4096,-8192> texture { Material_2 } } // wall
)", true);
}

// clang-format on

TEST(PovrayExport, IsTheSameEveryTime) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const RandomScene random = random_scene(seed);
    EXPECT_EQ(exported(random.scene, random.options), exported(random_scene(seed).scene, random.options))
        << seed;
  }
}

TEST(PovrayExport, IsTheSameForASceneThatWasWrittenAndReadAgain) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const RandomScene random = random_scene(seed);
    EXPECT_EQ(exported(write_scene(random.scene), random.options), exported(random.scene, random.options))
        << seed;
  }
}

// Only what is needed.

constexpr const char* bare = R"(
define material plain 0 0 0 0.5 0.5 0.5 0 0 0 0
define material glass 0 0 0 0 0 0 0 0 0 0 transmit 1 1 1 eta 1.5
define material unused 1 1 1 1 1 1 1 1 1 1 mirror 1 1 1
define shape sphere ball 0 0 -4 1 plain
)";
const std::string glass_ball = "define shape sphere lens 0 0 -7 1 glass\n";
const std::string lamp = "define light lamp 0 8 0 1 1 1 1\n";

TEST(PovrayExport, HoldsNoBlockThatIsNotNeeded) {
  const std::string text = exported(bare);
  for (const char* block :
       {"background", "light_source", "Caster", "interior", "ior", "no_shadow", "no_image", "reflection",
        "phong", "emission", "union", "object", "matrix", "translate", "unused"}) {
    EXPECT_FALSE(has(text, block)) << block << " in\n" << text;
  }
  EXPECT_EQ(count(text, "#declare"), 1U) << text;
}

TEST(PovrayExport, HoldsEachBlockThatIsNeeded) {
  EXPECT_TRUE(has(exported(std::string(bare) + "background 0 0 0.5\n"), "background { rgb <0,0,0.5> }"));
  EXPECT_EQ(count(exported(bare + lamp + "define light other 1 2 3 1 1 1 1\n"), "light_source"), 2U);
  const std::string glass = exported(bare + glass_ball + lamp);
  for (const char* block :
       {"#declare Caster", "interior { ior 1.5 }", "no_shadow", "no_image no_reflection"}) {
    EXPECT_EQ(count(glass, block), 1U) << block << " in\n" << glass;
  }
}

TEST(PovrayExport, GlassCastsAShadowAsTheOptionsSay) {
  const auto with = [](GlassShadow shadow) { return exported(bare + glass_ball + lamp, {8, shadow}); };
  EXPECT_TRUE(has(with(GlassShadow::full), "Caster"));
  EXPECT_FALSE(has(with(GlassShadow::none), "Caster"));
  EXPECT_TRUE(has(with(GlassShadow::none), "no_shadow"));
  EXPECT_FALSE(has(with(GlassShadow::filtered), "Caster"));
  EXPECT_FALSE(has(with(GlassShadow::filtered), "no_shadow"));
}

TEST(PovrayExport, WithoutAnyLightGlassNeedsNoCaster) {
  EXPECT_FALSE(has(exported(bare + glass_ball), "Caster"));
}

TEST(PovrayExport, TheDepthIsMaxTraceLevel) {
  for (const int depth : {1, 8, 256}) {
    EXPECT_TRUE(
        has(exported(bare, {depth, GlassShadow::full}), "max_trace_level " + std::to_string(depth) + " "));
  }
}

TEST(PovrayExport, ASharedCompositeIsDeclaredOnceBeforeItsUse) {
  const std::string text = exported(std::string(bare) + R"(
define shape sphere other 0 2 -4 1 plain
define shape composite two ball other
define shape composite left two
define shape composite right two left
transform two translate 1 0 0
transform left translate 5 0 0
)");
  EXPECT_EQ(count(text, "#declare Composite_"), 3U) << text;
  for (std::size_t at = text.find("object { "); at != std::string::npos;
       at = text.find("object { ", at + 1)) {
    const std::string name = text.substr(at + 9, text.find(' ', at + 9) - at - 9);
    EXPECT_LT(text.find("#declare " + name + " "), at) << name << " in\n" << text;
  }
}

// Layers of texture.

TEST(PovrayExport, AMaterialHasOnlyTheLayersThatItNeeds) {
  for (unsigned i = 0; i < 48; ++i) {
    const bool ka = i % 2 != 0;
    const bool kd = i / 2 % 2 != 0;
    const bool kr = i / 4 % 2 != 0;
    const bool kt = i / 8 % 2 != 0;
    const unsigned ks = i / 16;  // none, grey, coloured
    Material material;
    if (ka) material.ka = {0.5, 0, 0.25};
    if (kd) material.kd = {0, 0.5, 1};
    if (kr) material.mirror = Rgbd(0.5);
    if (kt) material.transmit = {0.5, 1, 0};
    if (ks == 1) material.ks = Rgbd(0.5);
    if (ks == 2) material.ks = {0.5, 0.25, 0};
    material.m = 10;
    const std::size_t shining = (ka ? 1U : 0U) + (kd ? 1U : 0U);
    // Under these: the highlight and its colour; what glass lets through, with a coloured highlight, too; or
    // at least black.
    const std::size_t opaque = ks == 2 ? shining + 2 : std::max<std::size_t>(1, shining);
    const std::size_t glass = ks == 2 ? shining + 2 : shining + 1;
    const std::string text = exporters::povray_texture(material, Rgbd(1));
    EXPECT_EQ(count(text, "texture {"), kt ? glass : opaque) << i << "\n" << text;
    EXPECT_EQ(count(text, "reflection"), kr ? 1U : 0U) << text;
    EXPECT_EQ(count(text, "diffuse 1"), kd ? 1U : 0U) << text;
    EXPECT_EQ(count(text, "phong "), ks == 0 ? 0U : 1U) << text;
    EXPECT_EQ(count(text, "phong "), count(text, "phong_size 10")) << text;
    EXPECT_EQ(count(text, "texture {"), count(text, "finish { ambient 0 ")) << "the default is not 0\n"
                                                                            << text;
  }
}

TEST(PovrayExport, WithoutAmbientLightNothingGlows) {
  Material material;
  material.ka = Rgbd(1);
  material.kd = Rgbd(1);
  EXPECT_EQ(exporters::povray_texture(material, Rgbd(0)),
            "  texture { pigment { rgb <1,1,1> } finish { ambient 0 diffuse 1 } }\n");
}

// Names.

/// The code of an export: everything but comments.
std::string without_comments(const std::string& text) {
  return std::regex_replace(text, std::regex("//[^\n]*"), "");
}

TEST(PovrayExport, NamesOfASceneNeverReachTheCode) {
  const Scene plain = scene_of(bare + glass_ball + lamp + R"(
define shape composite pair ball lens
transform pair translate 1 0 0
)");
  for (const char* name :
       {"}#declare", "*/", "/*", "\"#include", "#include \"/etc/passwd\"", "a\n#declare B=1;\n",
        "a\r#fopen F \"x\" write", "\\", "//", "?", "", "\xC3\xA4\xE2\x80\xA8", "'", "#debug",
        "aVeryLongNameThatGoesOnAndOnAndOnAndOnAndOnAndOnAndOnAndOnAndOnAndOn"}) {
    Scene evil = plain;
    for (Material& material : evil.materials) material.name = name;
    for (Shape& shape : evil.shapes) shape.name = name;
    for (Light& light : evil.lights) light.name = name;
    for (Camera& camera : evil.cameras) camera.name = name;
    for (RenderRequest& render : evil.renders) render.file = render.camera = name;
    const std::string text = exported(evil);
    EXPECT_EQ(without_comments(text), without_comments(exported(plain))) << name;
    std::istringstream lines(text.substr(text.find('\n') + 1));
    for (std::string line; std::getline(lines, line);) {
      const std::size_t at = line.find("//");
      if (at == std::string::npos) continue;
      EXPECT_TRUE(std::regex_match(line.substr(at), std::regex("// [A-Za-z0-9_?-]{0,40}"))) << line;
    }
  }
}

// Numbers.

TEST(PovrayExport, NumbersAreTheShortestThatReadBackTheSame) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const std::string text = without_comments(exported(random_scene(seed).scene));
    const std::regex number("[<,] ?(-?[0-9][0-9.e+-]*)");
    std::size_t numbers = 0;
    for (std::sregex_iterator it(text.begin(), text.end(), number), end; it != end; ++it, ++numbers) {
      const std::string written = (*it)[1];
      EXPECT_EQ(to_text(std::strtod(written.c_str(), nullptr)), written) << "seed " << seed;
    }
    EXPECT_GT(numbers, 20U);
    EXPECT_FALSE(has(text, "nan") || has(text, "inf")) << text;
  }
}

TEST(PovrayExport, LengthsAreScaledByAPowerOfTwoWhichRoundsNothing) {
  const Scene scene = scene_of(std::string(bare) + "define shape sphere odd 0.1 0.3 -4.7 0.7 plain\n");
  const double scale = exporters::export_space(scene, scene.cameras.front()).scale;
  int exponent = 0;
  EXPECT_EQ(std::frexp(scale, &exponent), 0.5);
  const auto scaled = [&](double length) { return to_text(scale * length); };
  EXPECT_TRUE(has(exported(scene), "sphere { <" + scaled(0.1) + "," + scaled(0.3) + "," + scaled(-4.7) +
                                       ">, " + scaled(0.7) + " texture"))
      << exported(scene);
}

TEST(PovrayExport, ScenesOfEverySizeSpanAboutTheSame) {
  for (const double size : {1e-9, 1e-6, 1.0, 1e6, 1e9}) {
    Scene scene = scene_of(bare);
    std::get<Sphere>(scene.shapes[0].geometry) = {{0, 0, -4 * size}, size, 0};
    const auto space = exporters::export_space(scene, scene.cameras.front());
    EXPECT_GE(space.scale * 5 * size, 8192) << size;
    EXPECT_LT(space.scale * 5 * size, 32768) << size;
    EXPECT_EQ(space.center, Vec3d(0)) << size;
  }
}

TEST(PovrayExport, ASceneFarOffIsMovedToTheOrigin) {
  Scene scene = scene_of(bare);
  std::get<Sphere>(scene.shapes[0].geometry).center = {1e5, 0, -4};
  scene.cameras[0].eye = {1e5, 0, 0};
  const auto space = exporters::export_space(scene, scene.cameras.front());
  EXPECT_NEAR(space.center.x, 1e5, 5);
  EXPECT_TRUE(has(exported(scene), "location <0,0,")) << exported(scene);
}

TEST(PovrayExport, AnEyeAloneGivesAnExportToo) {
  const std::string text = exported("define camera eye 45\nbackground 1 0 0\n");
  EXPECT_TRUE(has(text, "camera {") && has(text, "background {")) << text;
}

}  // namespace
}  // namespace plumb::tests
