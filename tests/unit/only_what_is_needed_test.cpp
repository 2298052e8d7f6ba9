// Exported scenes and compiled scenes hold what a scene needs and nothing else: everything is counted.
#include <gtest/gtest.h>

#include <ostream>
#include <regex>
#include <stdexcept>

#include "exporters/povray.hpp"
#include "tracer/engine/compile.hpp"
#include "tracer/engine/render.hpp"
#include "tracer/format/reader.hpp"

namespace plumb::tests {
namespace {

Scene scene_of(const std::string& text) {
  ReadResult result = read_scene(text);
  if (result.has_errors()) throw std::invalid_argument(to_string(result.findings.front(), "scene"));
  return std::move(result.scene);
}

/// How often each thing stands in an exported scene.
struct ExportCounts {
  int layers = 0, interiors = 0, no_shadows = 0, lights = 0, matrices = 0, translates = 0, unions = 0,
      casters = 0, materials = 0;
  bool operator==(const ExportCounts&) const = default;
};

std::ostream& operator<<(std::ostream& out, const ExportCounts& c) {
  return out << "layers " << c.layers << " interiors " << c.interiors << " no_shadows " << c.no_shadows
             << " lights " << c.lights << " matrices " << c.matrices << " translates " << c.translates
             << " unions " << c.unions << " casters " << c.casters << " materials " << c.materials;
}

int count(const std::string& text, const char* pattern) {
  const std::regex part(pattern);
  return static_cast<int>(std::distance(std::sregex_iterator(text.begin(), text.end(), part), {}));
}

ExportCounts counted(const std::string& scene_text, const RenderOptions& options = {}) {
  const Scene scene = scene_of(scene_text);
  const std::string text = exporters::export_povray({scene, scene.cameras.front(), 64, 48, options}).text;
  return {count(text, "texture \\{ pigment"),
          count(text, "interior"),
          count(text, "no_shadow"),
          count(text, "light_source"),
          count(text, "matrix <"),
          count(text, "translate <"),
          count(text, "union"),
          count(text, "no_image"),
          count(text, "#declare Material_")};
}

const std::string ball = "define shape sphere ball 0 0 -4 1 m\n";
const std::string lamp = "define light lamp 3 5 0 1 1 1 1\n";
const std::string ambient = "ambient 1 1 1\n";

std::string material(const std::string& rest) { return "define material m " + rest + "\n"; }

// ---- exports: layers of a material

struct LayerCase {
  const char* name;
  const char* material;  ///< ka kd ks m ...
  int layers;            ///< under ambient light and a lamp
};
void PrintTo(const LayerCase& c, std::ostream* out) { *out << c.name; }

class Layers : public testing::TestWithParam<LayerCase> {};
INSTANTIATE_TEST_SUITE_P(
    Every, Layers,
    testing::Values(LayerCase{"Black", "0 0 0  0 0 0  0 0 0  1", 1},
                    LayerCase{"AmbientAlone", "1 1 1  0 0 0  0 0 0  1", 1},
                    LayerCase{"DiffuseAlone", "0 0 0  1 1 1  0 0 0  1", 1},
                    LayerCase{"GreyHighlightAlone", "0 0 0  0 0 0  1 1 1  9", 1},
                    LayerCase{"AmbientAndDiffuse", "1 1 1  1 1 1  0 0 0  1", 2},
                    LayerCase{"AllWithAGreyHighlight", "1 1 1  1 1 1  1 1 1  9", 2},
                    LayerCase{"AColouredHighlightAlone", "0 0 0  0 0 0  1 0 0  9", 2},
                    LayerCase{"AllWithAColouredHighlight", "1 1 1  1 1 1  1 0 0  9", 4},
                    LayerCase{"MirrorAlone", "0 0 0  0 0 0  0 0 0  1 mirror 1 1 1", 1},
                    LayerCase{"GlassAlone", "0 0 0  0 0 0  0 0 0  1 transmit 1 1 1", 1},
                    LayerCase{"GlassWithAGreyHighlight", "0 0 0  0 0 0  1 1 1  9 transmit 1 1 1", 1},
                    LayerCase{"GlassWithAColouredHighlight", "0 0 0  0 0 0  1 0 0  9 transmit 1 1 1", 2},
                    LayerCase{"GlassWithAll", "1 1 1  1 1 1  1 0 0  9 transmit 1 1 1", 4}),
    [](const auto& test) { return test.param.name; });

TEST_P(Layers, OfTheExportAreThoseThatTheMaterialNeeds) {
  const bool casts = std::string(GetParam().material).find("transmit") != std::string::npos;
  const ExportCounts counts = counted(material(GetParam().material) + ball + lamp + ambient);
  EXPECT_EQ(counts.layers - (casts ? 1 : 0), GetParam().layers);  // a caster has one of its own
}

TEST(OnlyWhatIsNeeded, WithoutLightsAnExportHasNoLayersForThem) {
  const std::string all = material("1 1 1  1 1 1  1 0 0  9");
  EXPECT_EQ(counted(all + ball + ambient), (ExportCounts{.layers = 1, .materials = 1}));
  EXPECT_EQ(counted(all + ball), (ExportCounts{.layers = 1, .materials = 1}));
  EXPECT_EQ(counted(all + ball + lamp), (ExportCounts{.layers = 3, .lights = 1, .materials = 1}));
}

TEST(OnlyWhatIsNeeded, ALightOfNoLightIsInNeither) {
  const std::string dark = "define light dark 3 5 0 1 1 1 0\n";
  const std::string scene = material("1 1 1  1 1 1  1 1 1  9") + ball + ambient;
  EXPECT_EQ(counted(scene + dark), counted(scene));
  EXPECT_EQ(counted(scene + dark + lamp), counted(scene + lamp));
  EXPECT_EQ(engine::compile<double>(scene_of(scene + dark + lamp)).lights.size(), 1U);
}

TEST(OnlyWhatIsNeeded, InteriorFlagsAndCasterAreThoseOfGlass) {
  const std::string opaque = material("0 0 0  1 1 1  0 0 0  1") + ball + lamp;
  EXPECT_EQ(counted(opaque), (ExportCounts{.layers = 1, .lights = 1, .materials = 1}));
  const std::string glass = material("0 0 0  0 0 0  1 1 1  9 transmit 1 1 1 eta 1.5") + ball;
  const auto with = [&](GlassShadow shadow) { return counted(glass + lamp, {.glass_shadow = shadow}); };
  ExportCounts wanted{
      .layers = 2, .interiors = 1, .no_shadows = 1, .lights = 1, .casters = 1, .materials = 1};
  EXPECT_EQ(with(GlassShadow::full), wanted);
  wanted.layers = 1;
  wanted.casters = 0;
  EXPECT_EQ(with(GlassShadow::none), wanted);
  wanted.no_shadows = 0;
  EXPECT_EQ(with(GlassShadow::filtered), wanted);
}

TEST(OnlyWhatIsNeeded, TransformsOfAnExportAreThoseThatDoSomething) {
  const std::string scene = material("0 0 0  1 1 1  0 0 0  1") + ball + lamp;
  EXPECT_EQ(counted(scene + "transform ball scale 1\n").matrices, 0);
  EXPECT_EQ(counted(scene + "transform ball rotate 0 0 1 0\ntransform ball translate 0 0 0\n").matrices, 0);
  const ExportCounts moved = counted(scene + "transform ball translate 1 0 0\n");
  EXPECT_EQ(moved.matrices, 0);
  EXPECT_EQ(moved.translates, 1);
  const ExportCounts many = counted(scene + "transform ball scale 2\ntransform ball translate 1 0 0\n");
  EXPECT_EQ(many.matrices, 1);
  EXPECT_EQ(many.translates, 0);
}

TEST(OnlyWhatIsNeeded, UnionsAreThoseOfCompositesWithSeveralParts) {
  const std::string two = material("0 0 0  1 1 1  0 0 0  1") + "define shape sphere a 0 0 -4 1 m\n" +
                          "define shape box b 2 0 -4 3 1 -5 m\n";
  EXPECT_EQ(counted(two).unions, 0);
  EXPECT_EQ(counted(two + "define shape composite one a\n").unions, 0);
  EXPECT_EQ(counted(two + "define shape composite both a b\n").unions, 1);
  const std::string shared =
      "define shape composite pair a b\ndefine shape composite left pair\n"
      "define shape composite right pair\ntransform right translate 9 0 0\n";
  EXPECT_EQ(counted(two + shared).unions, 1);
}

TEST(OnlyWhatIsNeeded, MaterialsOfNoShapeAreInNeither) {
  const std::string unused =
      "define material unused 1 1 1 1 1 1 1 0 0 9 mirror 1 1 1 transmit 1 1 1 eta 1.5\n";
  const std::string scene = unused + material("0 0 0  1 1 1  0 0 0  1") + ball + lamp;
  EXPECT_EQ(counted(scene), (ExportCounts{.layers = 1, .lights = 1, .materials = 1}));
  const auto compiled = engine::compile<double>(scene_of(scene));
  ASSERT_EQ(compiled.materials.size(), 1U);
  EXPECT_EQ(compiled.materials[0].kd, Rgbd(1));
  EXPECT_EQ(compiled.sphere_labels.at(0).material, 0U);
  EXPECT_FALSE(compiled.mirrors || compiled.transmits);
}

// ---- what the engine makes of a scene

/// What its arrays hold.
struct CompiledCounts {
  std::size_t spheres = 0, boxes = 0, placed = 0, members = 0, groups = 1, materials = 1, lights = 0;
  bool mirrors = false, transmits = false, needs_instances = false;
  bool operator==(const CompiledCounts&) const = default;
};

std::ostream& operator<<(std::ostream& out, const CompiledCounts& c) {
  return out << "spheres " << c.spheres << " boxes " << c.boxes << " placed " << c.placed << " members "
             << c.members << " groups " << c.groups << " materials " << c.materials << " lights " << c.lights
             << " mirrors " << c.mirrors << " transmits " << c.transmits << " needs_instances "
             << c.needs_instances;
}

CompiledCounts compiled(const std::string& text, const engine::Settings& settings = {}) {
  const auto c = engine::compile<double>(scene_of(text), settings);
  return {c.spheres.size(),   c.boxes.size(),  c.placed.size(), c.members.size(), c.groups.size(),
          c.materials.size(), c.lights.size(), c.mirrors,       c.transmits,      c.needs_instances};
}

const std::string plain = material("0 0 0  1 1 1  0 0 0  1");
const std::string block = "define shape box block 1 0 -4 2 1 -5 m\n";

TEST(OnlyWhatIsNeeded, SpheresAndBoxesAreCompiledApart) {
  EXPECT_EQ(compiled(plain + ball), (CompiledCounts{.spheres = 1}));
  EXPECT_EQ(compiled(plain + block), (CompiledCounts{.boxes = 1}));
  EXPECT_EQ(compiled(plain + ball + block + lamp), (CompiledCounts{.spheres = 1, .boxes = 1, .lights = 1}));
}

TEST(OnlyWhatIsNeeded, OnlyWhatCannotBeFoldedIsCompiledWithAMatrix) {
  const std::string both = plain + ball + block;
  const auto placed = [&](const std::string& transforms) { return compiled(both + transforms).placed; };
  EXPECT_EQ(placed(""), 0U);
  EXPECT_EQ(
      placed("transform ball rotate 30 1 1 0\ntransform ball scale 2\ntransform ball translate 1 2 3\n"), 0U);
  EXPECT_EQ(placed("transform block scale 1 2 3\ntransform block translate 1 2 3\n"), 0U);
  EXPECT_EQ(placed("transform ball scale 1 2 1\n"), 1U);
  EXPECT_EQ(placed("transform ball scale 1 2 1\ntransform block rotate 30 0 1 0\n"), 2U);
}

TEST(OnlyWhatIsNeeded, SharingIsCompiledWhereWritingItOutIsLarge) {
  const std::string shared = plain + ball + block +
                             "define shape composite pair ball block\ndefine shape composite left pair\n"
                             "define shape composite right pair\ntransform right translate 5 0 0\n";
  EXPECT_EQ(compiled(shared), (CompiledCounts{.spheres = 2, .boxes = 2}));
  engine::Settings small;
  small.most_written_out = 1;
  EXPECT_EQ(compiled(shared, small),
            (CompiledCounts{.spheres = 1, .boxes = 1, .members = 2, .groups = 2, .needs_instances = true}));
}

TEST(OnlyWhatIsNeeded, SecondaryRaysAndMediaAreCompiledForThoseThatHaveThem) {
  EXPECT_EQ(compiled(material("0 0 0  0 0 0  0 0 0  1 mirror 1 1 1") + ball),
            (CompiledCounts{.spheres = 1, .mirrors = true}));
  EXPECT_EQ(compiled(material("0 0 0  0 0 0  0 0 0  1 transmit 1 1 1") + ball),
            (CompiledCounts{.spheres = 1, .transmits = true, .needs_instances = true}));
}

engine::Statistics rendered(const std::string& text) {
  const Scene scene = scene_of(text);
  RenderJob job;
  job.width = 16;
  job.height = 12;
  engine::Statistics statistics;
  engine::render(scene, scene.cameras.front(), job, &statistics);
  return statistics;
}

bool says(const engine::Statistics& statistics, const char* part) {
  return statistics.kernel.find(part) != std::string::npos;
}

TEST(OnlyWhatIsNeeded, TheKernelTracesNoRaysOfAKindThatIsNotThere) {
  const engine::Statistics unlit = rendered(plain + ball);
  EXPECT_EQ(unlit.camera_rays, 192U);
  EXPECT_EQ(unlit.shadow_rays + unlit.mirrored_rays + unlit.refracted_rays, 0U);
  EXPECT_TRUE(says(unlit, "no secondary rays"));
  EXPECT_GT(rendered(plain + ball + lamp).shadow_rays, 0U);
  const engine::Statistics mirror = rendered(material("0 0 0  0 0 0  0 0 0  1 mirror 1 1 1") + ball);
  EXPECT_GT(mirror.mirrored_rays, 0U);
  EXPECT_EQ(mirror.refracted_rays, 0U);
  EXPECT_TRUE(says(mirror, "no refraction"));
  const engine::Statistics glass = rendered(material("0 0 0  0 0 0  0 0 0  1 transmit 1 1 1 eta 1.5") + ball);
  EXPECT_GT(glass.refracted_rays, 0U);
  EXPECT_FALSE(says(glass, "no refraction"));
}

TEST(OnlyWhatIsNeeded, FewObjectsNeedNoWalkThroughAHierarchy) {
  const auto balls = [](int n) {
    std::string text = plain;
    for (int i = 0; i < n; ++i)
      text += "define shape sphere b" + std::to_string(i) + " " + std::to_string(i) + " 0 -99 0.3 m\n";
    return text;
  };
  EXPECT_TRUE(says(rendered(balls(64)), "all rays of a tile"));
  EXPECT_TRUE(says(rendered(balls(65)), "a hierarchy, because there are 65 objects"));
}

}  // namespace
}  // namespace plumb::tests
