// Diagnosis of pictures whose faults are known, because they were made with them.
#include "references/diagnosis/diagnosis.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/random_scene.hpp"
#include "tests/support/run.hpp"
#include "tracer/engine/render.hpp"
#include "tracer/format/reader.hpp"
#include "tracer/image/encode.hpp"

namespace plumb::tests {
namespace {

Scene scene_of(const std::string& file) {
  return read_scene(read_file(tests::source_path("tests/scenes/" + file))).scene;
}

textbook::RenderJob small_job() {
  textbook::RenderJob job;
  job.width = 60;
  job.height = 40;
  job.threads = 1;
  return job;
}

ImageFile as_file(const Image& image, plumb::Encoding encoding) {
  ImageFile file{image.width, image.height, 3, Sample::bits8, {}, {}};
  for (const std::uint8_t byte : encode_8_bits(image, encoding))
    file.values.push_back(static_cast<float>(byte) / 255);
  return file;
}

diagnosis::Diagnosis diagnosis_of(const std::string& file, const std::vector<std::string>& ids,
                                  plumb::Encoding encoding = plumb::Encoding::course) {
  const Scene scene = scene_of(file);
  std::vector<const faults::Fault*> faults;
  for (const std::string& id : ids) faults.push_back(faults::find_fault(id));
  const Camera& camera = scene.cameras.front();
  return diagnosis::diagnose(scene, camera, small_job(),
                             as_file(faults::render_with(scene, camera, small_job(), faults), encoding));
}

std::vector<std::string> ids_of(const diagnosis::Diagnosis& diagnosis) {
  std::vector<std::string> ids;
  for (const diagnosis::FoundFault& found : diagnosis.faults) ids.emplace_back(found.fault->id);
  std::sort(ids.begin(), ids.end());
  return ids;
}

using Ids = std::vector<std::string>;

TEST(Diagnose, ARightPictureIsRightInEveryEncoding) {
  for (const auto encoding : {plumb::Encoding::course, plumb::Encoding::srgb, plumb::Encoding::linear}) {
    const diagnosis::Diagnosis found = diagnosis_of("combined-still-life.sdf", {}, encoding);
    EXPECT_EQ(found.verdict, diagnosis::PictureVerdict::right);
    EXPECT_EQ(found.encoding.tone_map, encoding == plumb::Encoding::course);
    EXPECT_EQ(found.encoding.rounds, encoding == plumb::Encoding::srgb);
    EXPECT_EQ(found.pixels_over, 0U);
  }
}

TEST(Diagnose, SixteenBitsAreRoundedOrTruncated) {
  const Scene scene = scene_of("combined-still-life.sdf");
  const Camera& camera = scene.cameras.front();
  const Image right = faults::render_with(scene, camera, small_job(), {});
  for (const bool rounds : {false, true}) {
    ImageFile file{right.width, right.height, 3, Sample::bits16, {}, {}};
    for (const float c : right.rgb)
      file.values.push_back(std::floor(c / (c + 1) * 65535 + (rounds ? 0.5F : 0.0F)) / 65535);
    const diagnosis::Diagnosis found = diagnosis::diagnose(scene, camera, small_job(), file);
    EXPECT_EQ(found.verdict, diagnosis::PictureVerdict::right);
    EXPECT_EQ(found.encoding.rounds, rounds) << found.encoding.in_words();
  }
}

TEST(Diagnose, TheEnginesFloatPictureIsRight) {
  const Scene scene = scene_of("combined-village.sdf");
  RenderJob job = small_job();
  job.real = RealType::float32;
  const Image image = engine::render(scene, scene.cameras.front(), job);
  const ImageFile file = as_file(image, plumb::Encoding::course);
  EXPECT_EQ(diagnosis::diagnose(scene, scene.cameras.front(), small_job(), file).verdict,
            diagnosis::PictureVerdict::right);
}

TEST(Diagnose, OneFaultIsNamed) {
  for (const char* id : {"pixel-corner", "upside-down"}) {
    const diagnosis::Diagnosis found = diagnosis_of("combined-still-life.sdf", {id});
    EXPECT_EQ(found.verdict, diagnosis::PictureVerdict::faults) << id;
    EXPECT_EQ(ids_of(found), Ids{id});
    EXPECT_EQ(found.is_flipped, std::string(id) == "upside-down");
    EXPECT_EQ(found.pixels_over, 0U) << id;
  }
}

TEST(Diagnose, TwoFaultsOfWhichNeitherAloneExplainsAnythingAreNamed) {
  EXPECT_EQ(ids_of(diagnosis_of("combined-mirror-room.sdf", {"background-as-ambient", "brightness-ignored"})),
            (Ids{"ambient-missing", "brightness-ignored"}))
      << "the background is black, so that both are alike, and what is missing comes first";
}

/// Of a random scene, in the size of the course.
Ids ids_in_random_scene(unsigned seed, const Ids& there) {
  const auto random = tests::random_scene(seed);
  textbook::RenderJob job = small_job();
  job.width = 240;
  job.height = 160;
  job.options = random.options;
  std::vector<const faults::Fault*> faults;
  for (const std::string& id : there) faults.push_back(faults::find_fault(id));
  const Camera& camera = random.scene.cameras.front();
  const Image image = faults::render_with(random.scene, camera, job, faults);
  return ids_of(diagnosis::diagnose(random.scene, camera, job, as_file(image, plumb::Encoding::course)));
}

TEST(Diagnose, AFaultThatShowsBesideAnotherAloneIsNamed) {
  // The boxes are out of the right view.
  EXPECT_EQ(ids_in_random_scene(51018, {"box-normals-inverted"}), Ids{});
  const Ids both{"box-normals-inverted", "field-of-view-vertical"};
  EXPECT_EQ(ids_in_random_scene(51018, both), both);
}

TEST(Diagnose, APictureToneMappedOnceIsNotSaidToBeTwice) {
  const Ids there{"box-face-by-equality", "camera-without-effect", "normal-not-renormalised"};
  EXPECT_EQ(ids_in_random_scene(51034, there), there);
}

TEST(Diagnose, FaultsThatExplainAPartSaySo) {
  const Scene scene = scene_of("combined-still-life.sdf");
  const Camera& camera = scene.cameras.front();
  ImageFile picture =
      as_file(faults::render_with(scene, camera, small_job(), {faults::find_fault("ka-kd-swapped")}),
              plumb::Encoding::course);
  for (std::size_t i = 3 * 1200; i < 3 * 1300; ++i) picture.values[i] = 1;
  const diagnosis::Diagnosis found = diagnosis::diagnose(scene, camera, small_job(), picture);
  EXPECT_EQ(found.verdict, diagnosis::PictureVerdict::faults);
  EXPECT_EQ(ids_of(found), Ids{"ka-kd-swapped"});
  EXPECT_FALSE(found.explains_all());
  EXPECT_GE(found.unexplained_pixels, 95U);
  EXPECT_LE(found.unexplained_pixels, 100U);
  EXPECT_TRUE(diagnosis::summary_of(found).starts_with("explains a part; ")) << diagnosis::summary_of(found);
}

TEST(Diagnose, NoFaultIsNamedBesideALargePartThatHasAnotherCause) {
  const Scene scene = scene_of("combined-still-life.sdf");
  const Camera& camera = scene.cameras.front();
  const Image right = faults::render_with(scene, camera, small_job(), {});
  ImageFile picture = as_file(right, plumb::Encoding::course);
  std::fill(picture.values.begin() + 3 * 60 * 20, picture.values.end(), 0.0F);
  const diagnosis::Diagnosis half_black = diagnosis::diagnose(scene, camera, small_job(), picture);
  EXPECT_EQ(half_black.verdict, diagnosis::PictureVerdict::unexplained) << diagnosis::summary_of(half_black);
  EXPECT_TRUE(half_black.faults.empty());

  Scene less = scene;
  less.shapes.erase(less.shapes.begin());
  picture = as_file(faults::render_with(less, camera, small_job(), {}), plumb::Encoding::course);
  const diagnosis::Diagnosis missing = diagnosis::diagnose(scene, camera, small_job(), picture);
  EXPECT_TRUE(missing.faults.empty()) << missing.faults.front().fault->id;
  EXPECT_NE(missing.verdict, diagnosis::PictureVerdict::right);
}

TEST(Diagnose, AnEmptierPictureIsNotTakenForAFaultThatEmptiesIt) {
  std::string text = read_file(tests::source_path("tests/scenes/composite.sdf"));
  const Scene scene = read_scene(text).scene;
  const std::string near = "snowman translate -0.73 -1.71 -5.7";
  ASSERT_NE(text.find(near), std::string::npos);
  text.replace(text.find(near), near.size(), "snowman translate -0.73 -1.71 -12");
  const Scene farther = read_scene(text).scene;
  textbook::RenderJob job = small_job();
  job.width = 160;
  job.height = 120;
  const Image image = faults::render_with(farther, farther.cameras.front(), job, {});
  const diagnosis::Diagnosis found =
      diagnosis::diagnose(scene, scene.cameras.front(), job, as_file(image, plumb::Encoding::course));
  EXPECT_TRUE(found.faults.empty()) << found.faults.front().fault->id;
  EXPECT_NE(found.verdict, diagnosis::PictureVerdict::right);
}

TEST(Diagnose, APictureOfOneColourNamesNothingWhateverItsAlpha) {
  const Scene scene = scene_of("ambient.sdf");
  ImageFile black{60, 40, 4, Sample::bits8, {}, {}};
  black.values.resize(std::size_t{4} * 60 * 40);
  for (std::size_t i = 3; i < black.values.size(); i += 8) black.values[i] = 1;
  const diagnosis::Diagnosis found = diagnosis::diagnose(scene, scene.cameras.front(), small_job(), black);
  EXPECT_TRUE(found.faults.empty());
  EXPECT_NE(diagnosis::summary_of(found).find("one colour"), std::string::npos)
      << diagnosis::summary_of(found);
}

TEST(Diagnose, RedAndBlueExchangedIsAFault) {
  const diagnosis::Diagnosis found = diagnosis_of("combined-still-life.sdf", {"red-blue-exchanged"});
  EXPECT_EQ(found.verdict, diagnosis::PictureVerdict::faults);
  EXPECT_EQ(ids_of(found), Ids{"red-blue-exchanged"});
  EXPECT_TRUE(found.explains_all());
  EXPECT_EQ(ids_of(diagnosis_of("combined-still-life.sdf", {"red-blue-exchanged", "pixel-corner"})),
            (Ids{"pixel-corner", "red-blue-exchanged"}));
}

TEST(Diagnose, WhatChangesNoPixelIsNotNamed) {
  const diagnosis::Diagnosis found = diagnosis_of("combined-still-life.sdf", {"pixel-corner"});
  EXPECT_TRUE(found.explains_all());
  for (const diagnosis::FoundFault& fault : found.faults) EXPECT_GT(fault.pixels, 0U) << fault.fault->id;
}

TEST(Diagnose, WhatCannotBeToldApartIsSaid) {
  const diagnosis::Diagnosis found = diagnosis_of("phong.sdf", {"specular-absolute"});
  ASSERT_EQ(found.faults.size(), 1U);
  const diagnosis::FoundFault& first = found.faults.front();
  const bool is_named = first.fault->id == "specular-absolute" ||
                        std::any_of(first.alike.begin(), first.alike.end(),
                                    [](const faults::Fault* f) { return f->id == "specular-absolute"; });
  EXPECT_TRUE(is_named);
  EXPECT_NEAR(first.confidence, 1.0 / static_cast<double>(1 + first.alike.size()), 1e-12);
}

TEST(Diagnose, AbstainsFromAnotherScenesPicture) {
  const Scene scene = scene_of("combined-village.sdf");
  const Scene other = scene_of("combined-mirror-room.sdf");
  const Image image = engine::render(other, other.cameras.front(), small_job());
  const ImageFile file = as_file(image, plumb::Encoding::course);
  EXPECT_EQ(diagnosis::diagnose(scene, scene.cameras.front(), small_job(), file).verdict,
            diagnosis::PictureVerdict::unexplained);
}

}  // namespace
}  // namespace plumb::tests
