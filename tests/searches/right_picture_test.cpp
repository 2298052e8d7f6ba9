// Which pictures are right, and that those that are nearly right are not.
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <tuple>

#include "references/comparison/comparison.hpp"
#include "references/diagnosis/diagnosis.hpp"
#include "references/diagnosis/float_noise.hpp"
#include "references/renderers/ours.hpp"
#include "tests/support/random_scene.hpp"
#include "tests/support/run.hpp"
#include "tracer/format/reader.hpp"

namespace plumb::tests {
namespace {

struct Subject {
  Scene scene;
  RenderJob job;
};

RenderJob job_of(int width, int height) {
  RenderJob job;
  job.width = width;
  job.height = height;
  job.threads = 1;
  return job;
}

std::string text_of(const std::string& file) { return read_file(tests::source_path("tests/scenes/" + file)); }

Subject named_scene(const std::string& text) { return {read_scene(text).scene, job_of(120, 90)}; }

Subject random_subject(unsigned seed) {
  const auto random = tests::random_scene(seed);
  Subject subject{random.scene, job_of(120, 80)};
  subject.job.options = random.options;
  return subject;
}

Image rendered(const Subject& subject, renderers::OwnTracer renderer = renderers::OwnTracer::engine,
               RealType real = RealType::float64) {
  RenderJob job = subject.job;
  job.real = real;
  return renderers::render(renderer, subject.scene, subject.scene.cameras.front(), job);
}

/// How other people's programs write a colour.
struct Format {
  const char* name;
  Sample sample;
  std::function<float(float)> written;
};

float held(float c) { return std::clamp(c, 0.0F, 1.0F); }
float tone(float c) { return c / (c + 1); }
float rounded(float c, int steps) {
  return std::floor(held(c) * static_cast<float>(steps) + 0.5F) / static_cast<float>(steps);
}
float truncated(float c, int steps) {
  return std::floor(held(c) * static_cast<float>(steps)) / static_cast<float>(steps);
}
float gamma(float c) { return std::pow(held(c), 1 / 2.2F); }

float to_half(float c) {
  int exponent = 0;
  const float mantissa = std::frexp(c, &exponent);
  return std::ldexp(std::nearbyint(std::ldexp(mantissa, 11)), exponent - 11);
}

const std::vector<Format>& formats() {
  static const std::vector<Format> all{
      {"tone-mapped, truncated", Sample::bits8, [](float c) { return truncated(tone(c), 255); }},
      {"rounded", Sample::bits8, [](float c) { return rounded(c, 255); }},
      {"gamma, truncated", Sample::bits8, [](float c) { return truncated(gamma(c), 255); }},
      {"255.99", Sample::bits8, [](float c) { return std::floor(255.99F * held(c)) / 255; }},
      {"16 bits", Sample::bits16, [](float c) { return rounded(c, 65535); }},
      {"half", Sample::half, to_half},
      {"floats", Sample::float32, [](float c) { return c; }},
      {"tone-mapped floats", Sample::float32, tone},
  };
  return all;
}

ImageFile written(const Image& image, const Format& format) {
  ImageFile file;
  file.width = image.width;
  file.height = image.height;
  file.channels = 3;
  file.sample = format.sample;
  for (const float c : image.rgb) file.values.push_back(format.written(c));
  return file;
}

diagnosis::Diagnosis diagnosed(const Subject& subject, const ImageFile& file,
                               std::optional<double> tolerance = {}) {
  return diagnosis::diagnose(subject.scene, subject.scene.cameras.front(), subject.job, file, tolerance);
}

void expect_right_in_all_formats(const Subject& subject, renderers::OwnTracer renderer, RealType real) {
  const Image image = rendered(subject, renderer, real);
  for (const Format& format : formats()) {
    const diagnosis::Diagnosis found = diagnosed(subject, written(image, format));
    EXPECT_EQ(found.verdict, diagnosis::PictureVerdict::right)
        << format.name << ": " << diagnosis::summary_of(found) << ", " << found.encoding.in_words();
  }
}

/// Each scene by another tracer: each of all scenes in all formats by all tracers takes minutes.
TEST(RightPicture, OfRealTracersIsRightInEveryFormat) {
  const std::pair<renderers::OwnTracer, RealType> tracers[] = {
      {renderers::OwnTracer::engine, RealType::float32},
      {renderers::OwnTracer::textbook, RealType::float32},
      {renderers::OwnTracer::textbook, RealType::float64}};
  std::size_t next = 0;
  const auto expect_right = [&](const Subject& subject) {
    const auto& [renderer, real] = tracers[next++ % std::size(tracers)];
    expect_right_in_all_formats(subject, renderer, real);
  };
  for (const char* file : {"combined-still-life.sdf", "nested-glass.sdf", "phong.sdf"}) {
    SCOPED_TRACE(file);
    expect_right(named_scene(text_of(file)));
  }
  for (const unsigned seed : {1U, 2U, 3U}) {
    SCOPED_TRACE(seed);
    expect_right(random_subject(seed));
  }
}

/// A picture with one number of the scene changed.
void expect_not_right(const std::string& file, const std::string& from, const std::string& to,
                      const Format& format) {
  const std::string text = text_of(file);
  const std::size_t at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  std::string other = text;
  other.replace(at, from.size(), to);
  const diagnosis::Diagnosis found =
      diagnosed(named_scene(text), written(rendered(named_scene(other)), format));
  EXPECT_NE(found.verdict, diagnosis::PictureVerdict::right) << to << ", " << format.name;
  EXPECT_NE(found.verdict, diagnosis::PictureVerdict::faults) << to << ", " << format.name;
  EXPECT_GT(found.unexplained_pixels, 0U);
}

TEST(RightPicture, OfAnotherNumberIsNot) {
  for (const std::size_t format : {0U, 6U}) {
    expect_not_right("phong.sdf", "0.8 0.8 0.7 40", "0.8 0.8 0.7 41", formats()[format]);
    expect_not_right("phong.sdf", "define camera eye 55", "define camera eye 56", formats()[format]);
    expect_not_right("phong.sdf", "ambient 1 1 1", "ambient 1.04 1 1", formats()[format]);
    expect_not_right("phong.sdf", "1 1 1 1\n", "1 1 1 1.01\n", formats()[format]);
  }
  expect_not_right("phong.sdf", "ambient 1 1 1", "ambient 1.0003 1 1", formats()[6]);
}

/// Where a scene is smooth, what is a little off is no edge, however little.
TEST(RightPicture, OfASmoothDifferenceHasNoEdges) {
  const std::string text = text_of("phong.sdf");
  const std::tuple<const char*, const char*, std::size_t> changes[] = {
      {"0.7 40\n", "0.7 40.1\n", 0},
      {"-2.3 4.7 3.1", "-2.303 4.7 3.1", 1},
      {"-2.3 4.7 3.1", "-2.3 4.7003 3.1", 6}};
  for (const auto& [from, to, format] : changes) {
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    std::string other = text;
    other.replace(at, std::string(from).size(), to);
    const diagnosis::Diagnosis found =
        diagnosed(named_scene(text), written(rendered(named_scene(other)), formats()[format]));
    EXPECT_NE(found.verdict, diagnosis::PictureVerdict::right) << to;
    EXPECT_EQ(found.edges, 0U) << to;
  }
}

/// Of three pixels across, the middle one is not on an edge.
TEST(RightPicture, HasItsThinShapes) {
  const std::string rest =
      "define material w 1 0.2 0.2 0 0 0 0 0 0 1\ndefine material b 0.2 0.5 0.9 0 0 0 0 0 0 1\n"
      "define shape sphere ball 0.1 0 -60 0.05 b\ndefine light l 0 50 0 1 1 1 1\nambient 1 1 1\n"
      "background 0.1 0.1 0.1\ndefine camera c 0.2\nrender c p.ppm 160 120\n";
  Subject subject = named_scene(rest + "define shape box post -0.002 -2 -60 0.002 2 -59.999 w\n");
  Subject without = named_scene(rest);
  subject.job = without.job = job_of(160, 120);
  for (const std::size_t format : {0U, 6U}) {
    const diagnosis::Diagnosis found = diagnosed(subject, written(rendered(without), formats()[format]));
    EXPECT_NE(found.verdict, diagnosis::PictureVerdict::right) << format;
    EXPECT_GE(found.unexplained_pixels, 120U) << format;
  }
}

/// A number is as exact as it is large, whatever stands beside it.
TEST(RightPicture, HasItsLargeBoxesAtTheirPlaces) {
  const auto scene = [](const std::string& top) {
    return named_scene(
        "define material w 1 0.2 0.2 0.5 0.7 0.2 0.3 0.3 0.3 20\n"
        "define shape box floor -100000 -3 -100000 100000 " +
        top +
        " 100000 w\ndefine shape sphere ball 0 0 -5 1 w\ndefine light l 3 5 0 1 1 1 1\n"
        "ambient 0.2 0.2 0.2\ndefine camera c 60\nrender c p.ppm 160 120\n");
  };
  const Subject subject = scene("-1");
  for (const Format& format : {formats()[0], formats()[6]}) {
    EXPECT_EQ(diagnosed(subject, written(rendered(subject), format)).verdict,
              diagnosis::PictureVerdict::right);
    EXPECT_NE(diagnosed(subject, written(rendered(scene("-1.005")), format)).verdict,
              diagnosis::PictureVerdict::right)
        << format.name;
  }
}

/// What is equal in the file is equal in float32, too: the first is met.
TEST(RightPicture, HasTheFirstOfSurfacesAtOnePlace) {
  const std::string head =
      "define material r 0.8 0.1 0.1 0 0 0 0 0 0 1\ndefine material g 0.1 0.7 0.2 0 0 0 0 0 0 1\n";
  const std::string a = "define shape box a -1 -1 -5 0.5 1 -4 r\n",
                    b = "define shape box b -0.5 -1 -6 1 1 -4 g\n";
  const std::string tail = "ambient 1 1 1\ndefine camera c 60\nrender c p.ppm 120 90\n";
  const Subject subject = named_scene(head + a + b + tail);
  const diagnosis::Diagnosis found =
      diagnosed(subject, written(rendered(named_scene(head + b + a + tail)), formats()[0]));
  EXPECT_NE(found.verdict, diagnosis::PictureVerdict::right);
  EXPECT_LT(found.edges, 100U);
}

/// A pixel that float32 takes for another surface says nothing of its neighbours.
TEST(RightPicture, IsAsNearBesideAJump) {
  Subject subject = named_scene(text_of("shadow.sdf"));
  subject.job = job_of(160, 120);
  const Image in_double = rendered(subject);
  const Image in_float = rendered(subject, renderers::OwnTracer::engine, RealType::float32);
  const diagnosis::FloatErrors errors =
      diagnosis::float_errors(subject.scene, subject.scene.cameras.front(), subject.job, in_double);
  for (std::size_t i = 0; i < errors.allowed.size(); ++i) {
    EXPECT_GE(errors.allowed[i], 1e-6F);
    EXPECT_LE(errors.allowed[i], 1e-4F) << "pixel " << i;
  }
  EXPECT_FALSE(comparison::pixels_over(in_double, in_float, 1e-3).empty())
      << "no pixel jumps, which this is about";
}

/// A curve is steepest at 0, and what is exactly 0 is no more than that.
TEST(RightPicture, IsBlackUnderACurve) {
  const Subject subject = named_scene(text_of("composite.sdf"));
  const Image image = rendered(subject);
  for (const Format& format : formats()) {
    if (format.sample == Sample::half) continue;
    ImageFile file = written(image, format);
    ASSERT_EQ(image.rgb[0], 0.0F);
    const bool is_8_bits = format.sample == Sample::bits8;
    file.values[0] = is_8_bits ? 4.0F / 255 : 118.0F / 65535;
    EXPECT_NE(diagnosed(subject, file).verdict, diagnosis::PictureVerdict::right) << format.name;
  }
}

/// By so many steps of a format, each value one way or the other.
ImageFile with_noise(ImageFile file, float step) {
  std::mt19937 random(1);
  for (float& value : file.values) {
    if (value > 0.1F && value < 0.9F) value += (random() % 2 == 0 ? step : -step);
  }
  return file;
}

TEST(RightPicture, OfSixteenBitsIsRightToTheStep) {
  const Subject subject = named_scene(text_of("combined-still-life.sdf"));
  const Format truncated_16{"16 bits", Sample::bits16, [](float c) { return truncated(c, 65535); }};
  const ImageFile right = written(rendered(subject), truncated_16);
  EXPECT_EQ(diagnosed(subject, right).verdict, diagnosis::PictureVerdict::right);
  const ImageFile equal_parts = written(
      rendered(subject), {"65536 equal parts", Sample::bits16,
                          [](float c) { return std::min(std::floor(held(c) * 65536), 65535.0F) / 65535; }});
  EXPECT_EQ(diagnosed(subject, equal_parts).verdict, diagnosis::PictureVerdict::right);
  for (const float steps : {1.0F, 2.0F})
    EXPECT_NE(diagnosed(subject, with_noise(right, steps / 65535)).verdict, diagnosis::PictureVerdict::right)
        << steps;
}

/// Eight bits for each channel, and an exponent for all.
TEST(RightPicture, OfASharedExponentIsRightToTheStep) {
  const Subject subject = named_scene(text_of("combined-still-life.sdf"));
  ImageFile right = written(rendered(subject), formats()[6]);
  ImageFile wrong = right;
  for (std::size_t i = 0; i < right.values.size(); i += 3) {
    int exponent = 0;
    std::frexp(std::max({right.values[i], right.values[i + 1], right.values[i + 2]}), &exponent);
    const float step = std::ldexp(1.0F, exponent - 8);
    for (std::size_t c = i; c < i + 3; ++c) {
      right.values[c] = std::floor(right.values[c] / step) * step;
      wrong.values[c] = std::max(0.0F, right.values[c] - step);
    }
  }
  EXPECT_EQ(diagnosed(subject, right).verdict, diagnosis::PictureVerdict::right);
  const diagnosis::Diagnosis found = diagnosed(subject, wrong);
  EXPECT_NE(found.verdict, diagnosis::PictureVerdict::right);
  EXPECT_GE(found.unexplained_pixels, found.pixels / 2);
}

TEST(RightPicture, ApartFromAShapeNamesIt) {
  const std::string tiny = "define shape sphere tiny 0 0 -4 0.06 m2\n";
  std::string text = text_of("phong.sdf");
  const Subject without = named_scene(text);
  text.insert(text.find("define light"), tiny);
  const diagnosis::Diagnosis found = diagnosed(named_scene(text), written(rendered(without), formats()[0]));
  EXPECT_EQ(found.verdict, diagnosis::PictureVerdict::right_apart);
  ASSERT_EQ(found.shapes.size(), 1U);
  EXPECT_EQ(found.shapes.front().name, "tiny");
  EXPECT_EQ(found.shapes.front().pixels, found.unexplained_pixels);
  EXPECT_TRUE(diagnosis::summary_of(found).ends_with("pixels, all on 'tiny'"))
      << diagnosis::summary_of(found);
}

TEST(RightPicture, ApartFromSomePixelsIsNotRight) {
  const Subject subject = named_scene(text_of("combined-still-life.sdf"));
  ImageFile file = written(rendered(subject), formats()[0]);
  std::mt19937 random(1);
  for (int i = 0; i < 100; ++i) file.values[random() % file.values.size()] += 3.0F / 255;
  const diagnosis::Diagnosis found = diagnosed(subject, file);
  EXPECT_EQ(found.verdict, diagnosis::PictureVerdict::right_apart);
  EXPECT_GT(found.unexplained_pixels, 90U);
  EXPECT_EQ(diagnosed(subject, file, 3.1 / 255).verdict, diagnosis::PictureVerdict::right);
}

TEST(RightPicture, OfFloatsIsAsNearAsTheToleranceSays) {
  const Subject subject = named_scene(text_of("phong.sdf"));
  ImageFile file = written(rendered(subject), formats()[6]);
  for (float& value : file.values) value += 1e-3F;
  EXPECT_NE(diagnosed(subject, file).verdict, diagnosis::PictureVerdict::right);
  EXPECT_EQ(diagnosed(subject, file, 1.1e-3).verdict, diagnosis::PictureVerdict::right);
}

TEST(RightPicture, MayHaveFewerLevels) {
  const Subject subject = named_scene(text_of("phong.sdf"));
  const Image image = rendered(subject);
  const auto as_8_bits = [](float c, int steps) { return std::round(255 * rounded(c, steps)) / 255; };
  for (const int steps : {31, 63, 100}) {  // tone-mapped, 16 levels leave 8, which are too few to tell
    const Format exact{"", Sample::bits8, [&](float c) { return rounded(c, steps); }};
    const Format spread{"", Sample::bits8, [&](float c) { return as_8_bits(c, steps); }};
    const Format cut{"", Sample::bits8, [&](float c) { return truncated(tone(c), steps); }};
    for (const Format& format : {exact, spread, cut}) {
      const diagnosis::Diagnosis found = diagnosed(subject, written(image, format));
      EXPECT_EQ(found.verdict, diagnosis::PictureVerdict::right)
          << steps << ": " << diagnosis::summary_of(found);
      EXPECT_EQ(found.encoding.levels[0], steps + 1);
    }
  }
}

TEST(RightPicture, MayBeReducedFromEightBits) {
  const Subject subject = named_scene(text_of("phong.sdf"));
  const Image image = rendered(subject);
  const std::array<std::function<int(float)>, 3> to_8_bits{
      [](float c) { return static_cast<int>(255 * tone(c)); },
      [](float c) { return static_cast<int>(std::lround(255 * tone(c))); },
      [](float c) { return std::min(255, static_cast<int>(256 * tone(c))); }};
  for (const auto& byte : to_8_bits) {
    for (const int steps : {31, 63}) {
      const Format rounded_again{
          "", Sample::bits8, [&](float c) {
            const auto step = std::lround(byte(c) * steps / 255.0);
            return static_cast<float>(std::lround(static_cast<double>(step) * 255.0 / steps)) / 255;
          }};
      EXPECT_EQ(diagnosed(subject, written(image, rounded_again)).verdict, diagnosis::PictureVerdict::right)
          << steps;
    }
    const Format repeated_bits{"", Sample::bits8, [&](float c) {
                                 const int bits = byte(c) >> 3;
                                 return static_cast<float>(bits << 3 | bits >> 2) / 255;
                               }};
    EXPECT_EQ(diagnosed(subject, written(image, repeated_bits)).verdict, diagnosis::PictureVerdict::right);
  }
}

TEST(RightPicture, HasNoFewerLevelsThanScreensHave) {
  const Subject subject = named_scene(text_of("phong.sdf"));
  for (const int steps : {7, 30}) {
    const Format coarse{"", Sample::bits8,
                        [&](float c) { return std::round(255 * truncated(c, steps)) / 255; }};
    const diagnosis::Diagnosis found = diagnosed(subject, written(rendered(subject), coarse));
    EXPECT_NE(found.verdict, diagnosis::PictureVerdict::right) << steps;
  }
}

TEST(RightPicture, MayHaveOtherLevelsInEachChannel) {
  const Subject subject = named_scene(text_of("phong.sdf"));
  ImageFile file = written(rendered(subject), formats()[1]);
  for (std::size_t i = 0; i < file.values.size(); ++i) {
    const int dropped = i % 3 == 1 ? 2 : 3;  // bits, of 5, 6 and 5
    const int byte = static_cast<int>(std::lround(255 * file.values[i]));
    file.values[i] = static_cast<float>(byte >> dropped << dropped) / 255;
  }
  const diagnosis::Diagnosis found = diagnosed(subject, file);
  EXPECT_EQ(found.verdict, diagnosis::PictureVerdict::right) << diagnosis::summary_of(found);
  EXPECT_EQ(found.encoding.levels, (std::array{32, 64, 32}));
}

TEST(RightPicture, OfFewerLevelsMayStillBeWrong) {
  const Format coarse{"", Sample::bits8, [](float c) { return rounded(c, 31); }};
  expect_not_right("phong.sdf", "0.8 0.8 0.7 8\n", "0.8 0.8 0.7 12\n", coarse);
  const Format upper_bits{"", Sample::bits8,
                          [](float c) { return std::floor(std::floor(255 * tone(c)) / 8) * 8 / 255; }};
  expect_not_right("phong.sdf", "ambient 1 1 1", "ambient 1.04 1 1", upper_bits);
  for (const float factor : {0.97F, 0.98F, 1.01F, 1.02F}) {
    const Format scaled{"", Sample::bits8, [&](float c) {
                          return std::floor(std::floor(factor * 255 * tone(c)) / 8) * 8 / 255;
                        }};
    const Subject subject = named_scene(text_of("phong.sdf"));
    const diagnosis::Diagnosis found = diagnosed(subject, written(rendered(subject), scaled));
    EXPECT_NE(found.verdict, diagnosis::PictureVerdict::right) << factor << ": " << found.encoding.in_words();
  }
}

}  // namespace
}  // namespace plumb::tests
