// The measured facts on which the export to POV-Ray rests, each measured again with the real POV-Ray.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <future>
#include <random>
#include <stdexcept>

#include "exporters/povray.hpp"
#include "references/comparison/comparison.hpp"
#include "references/renderers/povray.hpp"
#include "references/system/process.hpp"
#include "tests/support/run.hpp"
#include "tracer/format/reader.hpp"
#include "tracer/formulas/camera.hpp"
#include "tracer/image/io.hpp"
#include "tracer/text/numbers.hpp"
#include "tracer/textbook/render.hpp"

namespace plumb::tests {
namespace {

using comparison::Comparison;
using renderers::PovrayJob;
using renderers::Rendered;

struct Tolerance {
  double value;
  const char* because;
};

constexpr Tolerance exact{0,
                          "flat colours that float32 holds exactly: any difference is a ray gone elsewhere"};
constexpr Tolerance float32_rounding{2.5e-7, "POV-Ray adds up a few colours in float32, 6e-8 off each"};
constexpr Tolerance many_layers{2e-6,
                                "layers, mirrors and glass add up tens of roundings of float32 colours"};

struct Picture {
  std::string what;
  Scene scene;
  RenderOptions options{};
  int width = 64;
  int height = 48;

  const Camera& camera() const { return scene.cameras.front(); }
};

Scene scene_of(const std::string& text) {
  ReadResult result = read_scene(text);
  if (result.has_errors()) throw std::invalid_argument(to_string(result.findings.front(), "scene"));
  return std::move(result.scene);
}

RenderOptions with_depth(int depth) { return {depth, GlassShadow::full}; }
RenderOptions with_shadow(GlassShadow shadow) { return {RenderOptions{}.depth, shadow}; }

PovrayJob job_of(const Picture& picture) {
  const auto exported = exporters::export_povray(
      {picture.scene, picture.camera(), picture.width, picture.height, picture.options});
  return {exported.text, picture.width, picture.height, exported.needs_flat_objects};
}

/// All at once, because POV-Ray mostly waits.
std::vector<Image> rendered_by_povray(const std::vector<PovrayJob>& jobs) {
  const renderers::Povray povray;
  std::vector<std::future<Rendered>> running;
  for (const PovrayJob& job : jobs) {
    running.push_back(std::async(std::launch::async, [&povray, &job] { return povray.render(job); }));
  }
  std::vector<Image> images;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    Rendered picture = running[i].get();
    EXPECT_EQ(picture.holds, renderers::Holds::float32);
    EXPECT_EQ(picture.warnings, "") << jobs[i].text;
    images.push_back(std::move(picture.image));
  }
  return images;
}

Image rendered_by_povray(const Picture& picture) {
  return rendered_by_povray(std::vector{job_of(picture)}).front();
}

Image rendered_by_us(const Picture& picture) {
  textbook::RenderJob job;
  job.width = picture.width;
  job.height = picture.height;
  job.options = picture.options;
  return textbook::render(picture.scene, picture.camera(), job);
}

std::string describe(const Comparison& c) {
  std::string text = std::to_string(c.pixels_over) + " of " + std::to_string(c.pixels) +
                     " pixels over, max error " + to_text(c.max_error) + ", the worst at " +
                     std::to_string(c.worst.x) + " " + std::to_string(c.worst.y) + ": ours";
  for (const float v : c.worst.test) text += " " + to_text(static_cast<double>(v));
  text += ", POV-Ray's";
  for (const float v : c.worst.reference) text += " " + to_text(static_cast<double>(v));
  return text;
}

std::vector<Comparison> compare_with_povray(const std::vector<Picture>& pictures, double tolerance) {
  std::vector<PovrayJob> jobs;
  for (const Picture& picture : pictures) jobs.push_back(job_of(picture));
  const std::vector<Image> references = rendered_by_povray(jobs);
  std::vector<Comparison> comparisons;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    comparisons.push_back(comparison::compare(references[i], rendered_by_us(pictures[i]), tolerance));
  }
  return comparisons;
}

void expect_agreement(const std::vector<Picture>& pictures, const Tolerance& tolerance) {
  const auto comparisons = compare_with_povray(pictures, tolerance.value);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    EXPECT_TRUE(comparisons[i].agrees())
        << pictures[i].what << ": " << describe(comparisons[i]) << "; the tolerance is " << tolerance.value
        << " because " << tolerance.because;
  }
}

/// The pixel in the middle, which looks exactly along the camera's direction when both sides are odd.
void expect_centre(const Image& image, const Rgbd& expected, const char* what) {
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(static_cast<double>(image.pixel(image.width / 2, image.height / 2)[c]), expected[c],
                float32_rounding.value)
        << what << ", channel " << c;
  }
}

std::size_t count_over(const Image& reference, const Image& test, double tolerance) {
  return comparison::pixels_over(reference, test, tolerance).size();
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::invalid_argument("'" + from + "' is not in\n" + text);
  return text.replace(at, from.size(), to);
}

/// A scene of mirrors, glass and plain things about one unit in size, lit by two lights.
constexpr const char* glass_and_mirrors = R"(
define material floor 0.3 0.3 0.3 0.5 0.5 0.4 0 0 0 1
define material red 0.4 0.1 0.1 0.6 0.2 0.1 0.3 0.2 0.1 20
define material glass 0 0 0 0.05 0.05 0.1 0.2 0.25 0.3 50 mirror 0.1 0.1 0.12 transmit 0.8 0.85 0.8 eta 1.5
define material chrome 0.1 0.1 0.1 0.1 0.1 0.1 0.4 0.4 0.4 40 mirror 0.6 0.6 0.6
define shape box ground -8 -2 -12 8 -1.5 2 floor
define shape sphere lens 0 0.2 -3.5 0.8 glass
define shape sphere bubble 0.1 0.2 -3.5 0.4 glass
define shape box prism -2.3 -1.2 -4.9 -1.1 0.4 -4.1 glass
define shape sphere ball 1.7 -0.4 -5 1 chrome
define shape sphere dot -0.8 -0.9 -3 0.4 red
define shape box block 0.4 0.9 -6.4 1.6 1.8 -5.3 chrome
transform block rotate 20 1 1 0.3
transform prism rotate 7 0.2 1 0.1
define light key 4 6 2 0.6 0.6 0.6 1
define light fill -5 3 1 0.2 0.25 0.3 1
ambient 0.2 0.2 0.25
background 0.1 0.15 0.3
define camera eye 60 0 0.5 1 0 -0.1 -1 0 1 0
)";

Scene scaled(Scene scene, double s) {
  for (Shape& shape : scene.shapes) {
    if (auto* sphere = std::get_if<Sphere>(&shape.geometry)) {
      sphere->center *= s;
      sphere->radius *= s;
    } else if (auto* box = std::get_if<Box>(&shape.geometry)) {
      box->min *= s;
      box->max *= s;
    }
    for (TransformStep& step : shape.transform) {
      if (auto* translate = std::get_if<Translate>(&step)) translate->by *= s;
    }
  }
  for (Light& light : scene.lights) light.position *= s;
  for (Camera& camera : scene.cameras) camera.eye *= s;
  return scene;
}

Scene moved(Scene scene, const Vec3d& by) {
  for (const ShapeId root : scene.roots()) scene.shapes[root].transform.emplace_back(Translate{by});
  for (Light& light : scene.lights) light.position += by;
  for (Camera& camera : scene.cameras) camera.eye += by;
  return scene;
}

// Section 1: the camera.

/// Many silhouettes in a few flat colours that float32 holds exactly.
Scene confetti(const std::string& camera) {
  std::string text = R"(
ambient 1 1 1
background 0.125 0.25 0.5
define material a 0.5 0.25 0.125 0 0 0 0 0 0 0
define material b 0.75 0.5 1 0 0 0 0 0 0 0
define material c 0.25 1 0.5 0 0 0 0 0 0 0
)" + camera + "\n";
  std::mt19937 random(7);
  const auto place = [&](double low, double high) {
    return to_text(std::uniform_real_distribution(low, high)(random)) + " ";
  };
  for (int i = 0; i < 90; ++i) {
    const std::string name = "s" + std::to_string(i);
    const char* const material = std::array{" a\n", " b\n", " c\n"}[static_cast<std::size_t>(i) % 3];
    if (i % 2 == 0) {
      text += "define shape sphere " + name + " " + place(-4, 4) + place(-3, 3) + place(-12, -4) +
              place(0.1, 0.7);
    } else {
      text += "define shape box " + name + " -0.3 -0.2 -0.4 0.3 0.2 0.4";
    }
    text += material;
    if (i % 2 == 0) continue;
    text +=
        "transform " + name + " rotate " + place(0, 360) + place(-1, 1) + place(-1, 1) + place(0.1, 1) + "\n";
    text += "transform " + name + " translate " + place(-4, 4) + place(-3, 3) + place(-12, -4) + "\n";
  }
  return scene_of(text);
}

TEST(PovrayFacts, TheCamerasRaysAreTheSameSilhouettesIncluded) {
  std::vector<Picture> pictures;
  for (const char* camera : {"define camera eye 60", "define camera eye 25 0.3 0.2 1 0.02 -0.05 -1 0.4 1 0.1",
                             "define camera eye 100 -0.5 0.7 0 0.3 -0.1 -1 -1 0.2 0"}) {
    pictures.push_back({camera, confetti(camera), {}, 317, 203});
  }
  pictures.push_back({"portrait", confetti("define camera eye 40"), {}, 91, 143});
  expect_agreement(pictures, exact);
}

TEST(PovrayFacts, LitPicturesAgreeToFloat32Rounding) {
  Scene scene = confetti("define camera eye 60");
  for (Material& material : scene.materials) {
    material.ka *= 0.2;
    material.kd = {0.4, 0.5, 0.3};
    material.ks = Rgbd(0.25);
    material.m = 30;
  }
  scene.lights = {{"key", {5, 6, 3}, {0.9, 0.8, 0.7}, 0.9}, {"fill", {-7, 1, 2}, {0.2, 0.3, 0.4}, 1}};
  expect_agreement({{"lit confetti", scene, {}, 317, 203}}, float32_rounding);
}

// Section 2: output.

/// A lit sphere below 1 and a glowing one far above it.
Picture over_and_below_one() {
  return {"over and below one",
          scene_of(R"(
define material dull 0.1 0.1 0.1 0.5 0.6 0.7 0.1 0.1 0.1 9
define material lamp 3.5 1.25 0.5 0 0 0 0 0 0 0
define shape sphere left -1.1 0 -4 1 dull
define shape sphere right 1.1 0 -4 1 lamp
define light key 1 5 2 1 1 1 1
ambient 1 1 1
background 0.01 0.2 0.4
define camera eye 60
)"),
          {},
          96,
          64};
}

/// What is in the PNG, not the state file.
Image png_of(const Picture& picture, const std::string& argument_left_out = {}) {
  const PovrayJob job = job_of(picture);
  const Workplace workplace;
  workplace.file("in.pov", job.text);
  std::vector<std::string> command = renderers::povray_arguments(job);
  std::erase(command, argument_left_out);
  command.insert(command.begin(), renderers::Povray().program());
  const auto result = system::run_process(command, workplace.directory(), {});
  EXPECT_EQ(result.exit_code, 0) << result.output;
  const ImageFile file = read_image(workplace.path("out.png"));
  Image image(file.width, file.height);
  EXPECT_EQ(file.channels, 3);
  image.rgb = file.values;
  return image;
}

TEST(PovrayFacts, TheStateFileIsFloat32AndNotClamped) {
  const Picture picture = over_and_below_one();
  const Image image = rendered_by_povray(picture);
  EXPECT_EQ(*std::max_element(image.rgb.begin(), image.rgb.end()), 3.5F);
  const Comparison c = comparison::compare(image, rendered_by_us(picture), float32_rounding.value);
  EXPECT_TRUE(c.agrees()) << describe(c);
  // 16 bits cannot hold these values: most of them are no multiples of 1/65535.
  const auto is_of_16_bits = [](float v) { return std::abs(std::round(65535 * v) - 65535 * v) < 0.01F; };
  const auto coarse = std::count_if(image.rgb.begin(), image.rgb.end(), is_of_16_bits);
  EXPECT_LT(static_cast<std::size_t>(coarse), image.rgb.size() * 9 / 10);
}

TEST(PovrayFacts, A16BitPngClampsAtOneAndIsOffByHalfAStepBelow) {
  const Picture picture = over_and_below_one();
  const Image ours = rendered_by_us(picture);
  const Image png = png_of(picture);
  ASSERT_EQ(png.rgb.size(), ours.rgb.size());
  double largest = 0;
  double squares = 0;
  double below = 0;
  for (std::size_t i = 0; i < ours.rgb.size(); ++i) {
    if (ours.rgb[i] >= 1) {
      EXPECT_EQ(png.rgb[i], 1.0F) << ours.rgb[i];
      continue;
    }
    const double error = std::abs(static_cast<double>(png.rgb[i]) - static_cast<double>(ours.rgb[i]));
    largest = std::max(largest, error);
    squares += error * error;
    below += 1;
  }
  EXPECT_LT(below, static_cast<double>(ours.rgb.size())) << "nothing was clamped";
  EXPECT_LE(largest, 7.7e-6) << "half a step of 16 bits is 7.63e-6";
  EXPECT_GT(largest, 3e-6) << "finer than 16 bits?";
  EXPECT_LE(std::sqrt(squares / below), 5.5e-6);
}

TEST(PovrayFacts, WithoutFileGammaAPngIsNotLinear) {
  const Picture picture = over_and_below_one();
  Image ours = rendered_by_us(picture);
  for (float& v : ours.rgb) v = std::min(v, 1.0F);
  const Comparison c = comparison::compare(png_of(picture, "File_Gamma=1.0"), ours, 1e-3);
  EXPECT_NEAR(c.max_error, 0.29, 0.02) << "sRGB is up to 0.29 above the linear value";
}

// Section 3: materials.

/// All combinations of ka, kd, ks (none, grey, coloured), kr, kt, present and absent.
std::vector<Material> material_table(double factor, double m) {
  std::vector<Material> table;
  for (unsigned i = 0; i < 48; ++i) {
    Material material;
    const bool ka = i % 2 != 0;
    const bool kd = i / 2 % 2 != 0;
    const bool kr = i / 4 % 2 != 0;
    const bool kt = i / 8 % 2 != 0;
    const unsigned ks = i / 16;
    material.name = std::string(ka ? "ka" : "") + (kd ? "kd" : "") + (kr ? "kr" : "") + (kt ? "kt" : "") +
                    std::array{"", "ksgrey", "kscoloured"}[ks] + "_" + std::to_string(i);
    if (ka) material.ka = factor * Rgbd(0.3, 0.2, 0.1);
    if (kd) material.kd = factor * Rgbd(0.5, 0.4, 0.6);
    if (ks == 1) material.ks = factor * Rgbd(0.4);
    if (ks == 2) material.ks = factor * Rgbd(0.7, 0, 0.3);
    if (ks != 0) material.m = m;
    if (kr) material.mirror = {0.3, 0.2, 0.1};
    if (kt) material.transmit = {0.6, 0.8, 0};
    if (kt) material.eta = 1.25;  // exact in float32
    table.push_back(material);
  }
  return table;
}

constexpr double grid_step = 2.2;
constexpr double grid_distance = 20;

Vec3d grid_place(std::size_t i) {
  return {grid_step * (static_cast<double>(i % 8) - 3.5), grid_step * (static_cast<double>(i / 8) - 2.5),
          -grid_distance};
}

/// One sphere or box for each material, before a wall that shines through what is glass.
Picture material_grid(const std::string& what, std::vector<Material> table, bool boxes, GlassShadow shadow) {
  Scene scene = scene_of(R"(
define material wall 0.3 0.3 0.5 0.5 0.4 0.3 0 0 0 0
define shape box back -40 -40 -31 40 0.3 -26 wall
define light key 12 14 4 0.8 0.7 0.6 1
define light fill -9 3 -2 0.2 0.3 0.4 1
ambient 0.5 0.6 0.7
background 0.2 0.3 0.4
define camera eye 60
)");
  const MaterialId first = scene.materials.size();
  scene.materials.insert(scene.materials.end(), table.begin(), table.end());
  for (std::size_t i = 0; i < table.size(); ++i) {
    Shape shape{"on_" + table[i].name, Sphere{grid_place(i), 0.9, first + i}, {}};
    if (boxes) {
      shape.geometry = Box{Vec3d(-0.6), Vec3d(0.6), first + i};
      shape.transform = {Rotate{50.0 + static_cast<double>(i), {1, 0.7, 0.2}}, Translate{grid_place(i)}};
    }
    scene.shapes.push_back(shape);
  }
  return {what, scene, with_shadow(shadow), 160, 120};
}

/// The combination that is drawn nearest to a pixel.
std::string material_at(int x, int y) {
  const double units_a_pixel = 2 * grid_distance * std::tan(formulas::radians(30.0)) / 160;
  const Vec3d place(units_a_pixel * (x - 79.5), units_a_pixel * (59.5 - y), -grid_distance);
  const auto table = material_table(1, 1);
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < table.size(); ++i) {
    if (glm::length(grid_place(i) - place) < glm::length(grid_place(nearest) - place)) nearest = i;
  }
  return table[nearest].name;
}

TEST(PovrayFacts, EveryCombinationOfCoefficientsIsExact) {
  const std::vector<Picture> pictures{
      material_grid("spheres, full shadow", material_table(1, 20), false, GlassShadow::full),
      material_grid("spheres, no shadow", material_table(1, 3.5), false, GlassShadow::none),
      material_grid("spheres, filtered shadow", material_table(1, 100), false, GlassShadow::filtered),
      material_grid("boxes, full shadow", material_table(1, 7), true, GlassShadow::full),
      material_grid("boxes, filtered shadow", material_table(1, 0), true, GlassShadow::filtered)};
  const auto comparisons = compare_with_povray(pictures, many_layers.value);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    EXPECT_TRUE(comparisons[i].agrees())
        << pictures[i].what << ": " << material_at(comparisons[i].worst.x, comparisons[i].worst.y) << " "
        << describe(comparisons[i]);
  }
}

TEST(PovrayFacts, CoefficientsAboveOneAndSharpHighlightsAreExactToo) {
  const Tolerance large{4e-6,
                        "values up to 10 times larger, and a power of 1000 magnifies what float32 rounds"};
  expect_agreement({material_grid("7.5", material_table(7.5, 20), false, GlassShadow::full),
                    material_grid("m 1000", material_table(1, 1000), false, GlassShadow::full)},
                   large);
}

// Section 4: shadows.

/// The middle pixel sees the floor under a glass ball that is under the light.
Picture glass_over_floor(GlassShadow shadow) {
  return {"glass over a floor", scene_of(R"(
define material floor 0 0 0 1 1 1 0 0 0 0
define material glass 0 0 0 0 0 0 0 0 0 0 transmit 0.5 0.25 1 eta 1.5
define shape box ground -20 -2 -20 20 -1 20 floor
define shape sphere ball 0 1 -5 0.8 glass
define light lamp 0 10 -5 0.8 0.8 0.8 1
define camera eye 60 0 0.5 3 0 -1.5 -8 0 1 0
)"),
          with_shadow(shadow), 65, 49};
}

TEST(PovrayFacts, GlassCastsAFullANoOrAFilteredShadow) {
  const std::vector<Picture> pictures{glass_over_floor(GlassShadow::full),
                                      glass_over_floor(GlassShadow::none),
                                      glass_over_floor(GlassShadow::filtered)};
  std::vector<PovrayJob> jobs;
  for (const Picture& picture : pictures) jobs.push_back(job_of(picture));
  const auto images = rendered_by_povray(jobs);
  expect_centre(images[0], Rgbd(0), "full");
  expect_centre(images[1], Rgbd(0.8), "none");
  expect_centre(images[2], {0.8 * 0.5 * 0.5, 0.8 * 0.25 * 0.25, 0.8}, "filtered: kt at each of two surfaces");
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const Comparison c = comparison::compare(images[i], rendered_by_us(pictures[i]), many_layers.value);
    EXPECT_TRUE(c.agrees()) << "shadow " << i << ": " << describe(c);
  }
}

// Section 4: depth.

Picture mirror_wall(int depth) {
  return {"mirror wall, depth " + std::to_string(depth), scene_of(R"(
define material mirror 0.25 0.25 0.25 0 0 0 0 0 0 0 mirror 0.5 0.5 1
define shape box wall -10 -10 -11 10 10 -10 mirror
ambient 0.5 0.5 0.5
background 0.25 0.5 0.75
define camera eye 120
)"),
          with_depth(depth), 65, 49};
}

TEST(PovrayFacts, WhatIsTracedBeyondTheDepthIsBlackAndNotTheBackground) {
  const std::vector<Image> images = rendered_by_povray({job_of(mirror_wall(1)), job_of(mirror_wall(2))});
  expect_centre(images[0], Rgbd(0.125), "depth 1: only the wall itself");
  expect_centre(images[1], {0.125 + 0.5 * 0.25, 0.125 + 0.5 * 0.5, 0.125 + 0.75},
                "depth 2: what it mirrors, too");
  EXPECT_EQ(images[0].pixel(32, 0)[2], 0.75F) << "a primary ray that misses sees the background at depth 1";
  for (const int depth : {1, 2}) {
    const Comparison c = comparison::compare(images[static_cast<std::size_t>(depth) - 1],
                                             rendered_by_us(mirror_wall(depth)), float32_rounding.value);
    EXPECT_TRUE(c.agrees()) << "depth " << depth << ": " << describe(c);
  }
}

TEST(PovrayFacts, DepthsUpTo256AreCounted) {
  // Between two mirrors each further depth adds as much as the first.
  const char* const corridor = R"(
define material mirror 0.015625 0.015625 0.015625 0 0 0 0 0 0 0 mirror 1 1 1
define shape box front -40 -40 -11 40 40 -10 mirror
define shape box back -40 -40 10 40 40 11 mirror
ambient 1 1 1
define camera eye 20
)";
  std::vector<Picture> pictures;
  for (const int depth : {3, 7, 255, 256}) {
    pictures.push_back({"depth " + std::to_string(depth), scene_of(corridor), with_depth(depth), 17, 13});
  }
  expect_agreement(pictures, {1e-6, "up to 256 sums of float32, exact here as they are multiples of 2^-6"});
  expect_centre(rendered_by_povray(pictures.back()), Rgbd(4), "256 times 1/64");
}

// Section 4: refraction.

TEST(PovrayFacts, TotalInternalReflectionHasWeightOneAndNoMirrorRay) {
  // The eye is in glass and looks at its side under 60 degrees, beyond the critical angle of 41.8; from there
  // the ray leaves through the far face under 30 degrees. At depth 3 the mirror ray of that face adds
  // nothing.
  const Picture picture{"total reflection", scene_of(R"(
define material glass 0 0 0 0 0 0 0 0 0 0 mirror 0.25 0.25 0.25 transmit 0.5 0.5 0.5 eta 1.5
define shape box block -10 -50 -8 1 50 10 glass
background 0.8 0.4 0.2
define camera eye 50 0 0 0 0.5 0 -0.86602540378443864 0 1 0
)"),
                        with_depth(3), 65, 49};
  const Image image = rendered_by_povray(picture);
  expect_centre(image, {0.4, 0.2, 0.1}, "1 * kt * background");
  const Comparison c = comparison::compare(image, rendered_by_us(picture), many_layers.value);
  EXPECT_TRUE(c.agrees()) << describe(c);
}

constexpr const char* five_clear_balls = R"(
define material clear 0 0 0 0 0 0 0 0 0 0 transmit 0.5 0.5 0.5
define material lamp 0.75 0.5 0.25 0 0 0 0 0 0 0
define shape sphere a 0 0 -4 1 clear
define shape sphere b 0 0 -7 1 clear
define shape sphere c 0 0 -10 1 clear
define shape sphere d 0 0 -13 1 clear
define shape sphere e 0 0 -16 1 clear
define shape box post 0.4 -9 -30 0.7 9 -29 lamp
ambient 1 1 1
background 1 0.5 0.25
define camera eye 50
)";

TEST(PovrayFacts, AnEtaRatioOfOneDoesNotBendNorRaiseTheDepth) {
  const std::vector<Picture> pictures{{"depth 1", scene_of(five_clear_balls), with_depth(1), 65, 49},
                                      {"depth 2", scene_of(five_clear_balls), with_depth(2), 65, 49},
                                      {"depth 8", scene_of(five_clear_balls), with_depth(8), 65, 49}};
  const std::vector<Image> images =
      rendered_by_povray({job_of(pictures[0]), job_of(pictures[1]), job_of(pictures[2])});
  expect_centre(images[0], Rgbd(0), "depth 1: black when level + 1 >= D");
  expect_centre(images[1], std::pow(0.5, 10) * Rgbd(1, 0.5, 0.25), "depth 2: through ten surfaces");
  EXPECT_EQ(images[1].rgb, images[2].rgb) << "there is but one level";
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const Comparison c = comparison::compare(images[i], rendered_by_us(pictures[i]), exact.value);
    EXPECT_TRUE(c.agrees()) << pictures[i].what << ": " << describe(c);
  }
}

/// Lamps of several colours behind and beside what is looked through.
const std::string backdrop = R"(
define material red 0.9 0.1 0.2 0 0 0 0 0 0 0
define material green 0.2 0.8 0.1 0 0 0 0 0 0 0
define material blue 0.1 0.3 0.9 0.3 0.3 0.3 0 0 0 0
define shape box left -9 -9 -15.5 -1.3 0.4 -14 red
define shape box right 0.9 -1 -16.5 9 9 -15 green
define shape sphere far -0.7 2.4 -13 1.7 blue
define light key 4 6 3 0.8 0.8 0.8 1
ambient 0.9 0.9 0.9
background 0.3 0.25 0.2
define material dense 0.01 0 0 0.05 0.05 0.1 0.2 0.2 0.2 30 transmit 0.9 0.8 0.85 eta 1.75
define material thin 0 0.01 0 0 0 0 0.1 0.2 0.3 20 mirror 0.1 0.1 0.1 transmit 0.85 0.9 0.8 eta 1.25
define material rare 0 0 0 0 0 0 0 0 0 0 transmit 0.95 0.95 0.95 eta 0.875
define material air 0 0 0 0 0 0 0 0 0 0 transmit 1 1 1
)";

TEST(PovrayFacts, NestedDielectricsUseAStackOfInteriors) {
  const std::string eye = "define camera eye 45\n";
  expect_agreement({{"one in another", scene_of(backdrop + eye + R"(
define shape sphere outer 0.03 0.04 -5.05 1.8 thin
define shape box inner -0.6 -0.5 -5.7 0.7 0.6 -4.4 dense
define shape sphere bubble 0 0.1 -5 0.3 air
transform inner rotate 3 0.1 0.2 0.03
)")},
                    {"overlapping: one is left that is not on top", scene_of(backdrop + eye + R"(
define shape sphere a 0 0.1 -4.5 1.1 dense
define shape sphere b 0.2 -0.2 -5.6 1.2 thin
)")},
                    {"three overlap", scene_of(backdrop + eye + R"(
define shape sphere a -0.4 0.1 -4.5 1.1 dense
define shape sphere b 0.6 -0.2 -5.1 1.2 rare
define shape box c -1 -0.9 -6.1 0.7 0.8 -4.7 thin
transform c rotate 5 0 1 0.2
)")},
                    {"rarer than the void", scene_of(backdrop + eye + R"(
define shape sphere a 0 0 -5 1.5 rare
define shape sphere b 0.2 0.3 -4.9 0.7 dense
)")}},
                   many_layers);
}

TEST(PovrayFacts, EtaIsAFloatInPovray) {
  // Sharp highlights seen through several curved surfaces magnify the rounding of eta.
  const auto with_eta = [](double eta) {
    Scene scene = scene_of(R"(
define material glass 0 0 0 0 0 0 0 0 0 0 transmit 1 1 1
define material shiny 0 0 0 0.5 0.5 0.5 6 6 6 1000
define shape sphere a 0.1 0.2 -3 0.9 glass
define shape sphere b -0.2 0.1 -5 0.8 glass
define shape sphere c 0.2 -0.1 -7 0.9 glass
define shape sphere d 0.1 0.1 -11 2 shiny
define shape sphere e 0.3 -0.1 4 2.5 shiny
define light key 2 3 -4 1 1 1 1
define camera eye 40
)");
    scene.materials[0].eta = eta;
    return Picture{"eta " + to_text(eta), scene, {12, GlassShadow::none}, 96, 72};
  };
  const auto comparisons =
      compare_with_povray({with_eta(static_cast<double>(1.7F)), with_eta(1.7)}, float32_rounding.value);
  EXPECT_TRUE(comparisons[0].agrees()) << describe(comparisons[0]);
  EXPECT_FALSE(comparisons[1].agrees()) << "a double is as good: " << describe(comparisons[1]);
}

std::vector<Picture> pictures_from_inside() {
  const std::string eye = "define camera eye 70 0.1 0.2 0 0.1 0 -1 0 1 0\n";
  return {{"inside one", scene_of(backdrop + eye + "define shape sphere a 0 0 -0.5 2 thin\n")},
          {"inside two", scene_of(backdrop + eye + R"(
define shape box inner -0.9 -0.8 -1.3 1 1.1 0.9 dense
define shape sphere outer 0 0 -0.5 3 thin
)")},
          {"inside two, the outer one first", scene_of(backdrop + eye + R"(
define shape sphere outer 0 0 -0.5 3 thin
define shape box inner -0.9 -0.8 -1.3 1 1.1 0.9 dense
define shape sphere before 0 0 -4.5 0.8 dense
)")}};
}

TEST(PovrayFacts, TheEyeMayBeInsideDielectrics) {
  std::vector<Picture> pictures = pictures_from_inside();
  pictures.push_back(pictures[1]);
  pictures.back().options = with_shadow(GlassShadow::filtered);
  pictures.push_back(pictures[2]);
  pictures.back().options = with_shadow(GlassShadow::none);
  for (const Picture& picture : pictures) EXPECT_TRUE(job_of(picture).without_bounding) << picture.what;
  expect_agreement(pictures, many_layers);
}

TEST(PovrayFacts, FromInsideDielectricsPovrayIsWrongWithBoundingOrInAnotherOrder) {
  const std::vector<Picture> pictures = pictures_from_inside();
  PovrayJob with_bounding = job_of(pictures[1]);
  with_bounding.without_bounding = false;
  // The line of the outer sphere to the end: the dielectrics then stand innermost first.
  PovrayJob inner_first = job_of(pictures[1]);
  const std::size_t at = inner_first.text.rfind("sphere {", inner_first.text.find("no_shadow } // outer"));
  ASSERT_NE(at, std::string::npos) << inner_first.text;
  const std::size_t length = inner_first.text.find('\n', at) + 1 - at;
  const std::string outer = inner_first.text.substr(at, length);
  inner_first.text.erase(at, length);
  inner_first.text += outer;
  const std::vector<Image> wrong = rendered_by_povray({with_bounding, inner_first});
  const Image right = rendered_by_us(pictures[1]);
  EXPECT_GT(count_over(wrong[0], right, 1e-3), 64U * 48 / 100) << "with bounding";
  EXPECT_GT(count_over(wrong[1], right, 1e-3), 64U * 48 / 100) << "innermost first";
}

// Section 4: transforms.

TEST(PovrayFacts, MirroredShearedNestedAndSharedTransformsAgree) {
  const std::string parts = R"(
define material grey 0.2 0.2 0.2 0.6 0.5 0.4 0.25 0.25 0.25 12
define material chrome 0.1 0.1 0.1 0.2 0.2 0.3 0.1 0.2 0.3 40 mirror 0.3 0.4 0.5
define shape sphere ball 0.3 0.1 0 0.6 grey
define shape box block -0.5 -0.4 -0.6 0.4 0.5 0.3 chrome
define light key 4 6 3 0.8 0.8 0.8 1
define light fill -6 1 1 0.2 0.3 0.3 1
ambient 0.3 0.3 0.3
background 0.1 0.2 0.3
)";
  const std::string eye = "define camera eye 60 0 0 1 0 0 -1 0 1 0\n";
  expect_agreement({{"mirrored", scene_of(parts + eye + R"(
transform ball scale -1 1.5 0.7
transform ball translate -1.2 0 -4
transform block scale 1 -1.3 -1
transform block rotate 40 1 1 1
transform block translate 1 0 -4
)")},
                    {"sheared", scene_of(parts + eye + R"(
transform ball scale 2 0.5 1
transform ball rotate 35 0 0 1
transform ball scale 0.6 1.6 1
transform ball rotate 25 1 0 0
transform ball translate -1 0 -4
transform block rotate 30 0 1 1
transform block scale 0.5 2 1
transform block rotate 50 1 0 1
transform block translate 1.2 0 -4
)")},
                    {"nested and shared", scene_of(parts + eye + R"(
define shape composite pair ball block
define shape composite left pair
define shape composite right pair block
define shape composite all left right
transform block translate 0.9 0.2 0.3
transform pair rotate 20 1 0.5 1
transform left scale -1 1 1.2
transform left translate -1.2 0.4 -4
transform right scale 0.7 1.3 0.9
transform right rotate 60 0 1 0.3
transform right translate 1 -0.4 -5
transform all rotate -10 1 0 0
)")},
                    {"a camera that is turned, moved and scaled", scene_of(parts + R"(
define camera eye 50
transform ball translate -1 0 -4
transform block translate 1 0 -4
transform eye rotate 15 0.3 0.2 1
transform eye scale 1 1.4 0.8
transform eye translate 0.1 0.2 0.5
)")}},
                   float32_rounding);
}

// What the header of the export is for.

TEST(PovrayFacts, TheDefaultAdcBailoutCutsOffWeakRays) {
  const Picture picture{"weak mirrors", scene_of(R"(
define material weak 0 0 0 0 0 0 0 0 0 0 mirror 0.05 0.05 0.05
define shape box wall -30 -30 -11 30 30 -10 weak
define shape sphere ball 0 0 -5 1 weak
background 1 1 1
define camera eye 60
)")};
  PovrayJob by_default = job_of(picture);
  by_default.text = replaced(by_default.text, " adc_bailout 0 ", " ");
  const std::vector<Image> images = rendered_by_povray({job_of(picture), by_default});
  const Image ours = rendered_by_us(picture);
  EXPECT_EQ(count_over(images[0], ours, float32_rounding.value), 0U);
  const Comparison cut = comparison::compare(images[1], ours, 1e-4);
  EXPECT_GT(cut.pixels_over, 50U) << "0.05 * 0.05 is below 1/255";
  EXPECT_NEAR(cut.max_error, 2.5e-3, 5e-4);
}

// Section 5: the export scale.

/// The exported scene in other units: a scale at the end of the camera, of every light and of every root.
std::string in_other_units(const std::string& exported, double factor) {
  std::string text;
  std::size_t begin = 0;
  while (begin < exported.size()) {
    const std::size_t end = exported.find('\n', begin);
    std::string line = exported.substr(begin, end - begin);
    for (const char* item : {"camera {", "light_source {", "sphere {", "box {", "object {"}) {
      if (line.starts_with(item)) line.insert(line.rfind('}'), "scale " + to_text(factor) + " ");
    }
    text += line + "\n";
    begin = end + 1;
  }
  return text;
}

/// POV-Ray's picture when the scene keeps its own units. One object a root: no separate shadow casters.
PovrayJob unscaled(const Picture& picture) {
  PovrayJob job = job_of(picture);
  job.text = in_other_units(job.text, 1 / exporters::export_space(picture.scene, picture.camera()).scale);
  return job;
}

/// What POV-Ray gets wrong in the scene's own units it gets right in those of the export.
std::size_t expect_that_scaling_helps(const Picture& picture, double tolerance) {
  const std::vector<Image> images = rendered_by_povray({job_of(picture), unscaled(picture)});
  const Image ours = rendered_by_us(picture);
  const Comparison c = comparison::compare(images[0], ours, many_layers.value);
  EXPECT_TRUE(c.agrees()) << picture.what << ": " << describe(c);
  return count_over(images[1], ours, tolerance);
}

TEST(PovrayFacts, AtScaleOnePovrayHasOutliersThatTheExportScaleRemoves) {
  const std::size_t outliers = expect_that_scaling_helps(
      {"glass and mirrors", scene_of(glass_and_mirrors), with_shadow(GlassShadow::none), 128, 96},
      many_layers.value);
  EXPECT_GT(outliers, 0U) << "3 were measured";
  EXPECT_LT(outliers, 128U * 96 / 100) << "only outliers: the edited scene is otherwise the same";
}

TEST(PovrayFacts, AThinSlabOfGlassIsWrongInItsOwnUnitsAndRightInTheExports) {
  const std::string slab = "define shape box slab -1.5 -1.2 -2.50005 1.5 1.2 -2.5 glass\n";
  const std::size_t wrong = expect_that_scaling_helps(
      {"thin slab", scene_of(glass_and_mirrors + slab), with_shadow(GlassShadow::none)}, 1e-3);
  EXPECT_GT(wrong, 64U * 48 / 10) << "where the slab is";
}

TEST(PovrayFacts, ASceneOfAThousandthIsWrongInItsOwnUnitsAndRightInTheExports) {
  const std::size_t wrong = expect_that_scaling_helps(
      {"a thousandth", scaled(scene_of(glass_and_mirrors), 1e-3), with_shadow(GlassShadow::none)}, 1e-3);
  EXPECT_GT(wrong, 64U * 48 / 100) << "1.8 to 6 % were measured";
}

TEST(PovrayFacts, ScenesOfEveryScaleAndFarOffAgree) {
  const Scene scene = scene_of(glass_and_mirrors);
  const Tolerance asked{1e-6, "the tolerance by default of verify; a place 1e5 off is rounded to 1e-11"};
  expect_agreement(
      {{"1e-6", scaled(scene, 1e-6)},
       {"1e6", scaled(scene, 1e6)},
       {"1e-6 without separate casters", scaled(scene, 1e-6), with_shadow(GlassShadow::none)},
       {"1e6, filtered", scaled(scene, 1e6), with_shadow(GlassShadow::filtered)},
       {"1e5 off", moved(scene, {1e5, -2e4, 3e4})},
       {"1e5 off, filtered", moved(scene, {-3e4, 1e5, 1e4}), with_shadow(GlassShadow::filtered)}},
      asked);
}

}  // namespace
}  // namespace plumb::tests
