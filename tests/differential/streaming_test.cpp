// Pictures that are streamed into their files, against the same rendered and written whole.
#include <gtest/gtest.h>

#include <limits>

#include "references/renderers/render_to_file.hpp"
#include "tests/support/end_to_end.hpp"
#include "tests/support/random_scene.hpp"
#include "tests/support/seeds.hpp"
#include "tracer/engine/render.hpp"
#include "tracer/format/reader.hpp"
#include "tracer/image/io.hpp"
#include "tracer/textbook/render.hpp"

namespace plumb::tests {
namespace {

using renderers::OwnTracer;
using renderers::Streaming;

constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

RenderJob job_of(const RandomScene& random) {
  RenderJob job;
  job.width = 45;
  job.height = 50;
  job.options = random.options;
  return job;
}

/// The bands under each other; checks their sizes.
struct Collected {
  Image image;
  std::vector<int> heights;

  BandSink sink(const RenderJob& job, int rows) {
    image = Image(job.width, job.height);
    return {rows, [this, at = std::size_t{0}](Image&& band) mutable {
              heights.push_back(band.height);
              ASSERT_EQ(band.width, image.width);
              ASSERT_LE(at + band.rgb.size(), image.rgb.size());
              std::copy(band.rgb.begin(), band.rgb.end(),
                        image.rgb.begin() + static_cast<std::ptrdiff_t>(at));
              at += band.rgb.size();
            }};
  }
};

TEST(Streaming, TheEnginesPictureIsTheSameForAllTilesAndBands) {
  const unsigned seeds = number_from("PLUMB_RANDOM_SCENES", 25);
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    const RandomScene random = random_scene(seed);
    const Camera& camera = random.scene.cameras.front();
    for (const RealType real : {RealType::float64, RealType::float32}) {
      RenderJob job = job_of(random);
      job.real = real;
      job.samples = seed % 5 == 0 ? 4 : 1;
      const Image image = engine::render(random.scene, camera, job);
      for (const auto& [width, height] :
           {std::pair(16, 16), std::pair(1, 1), std::pair(16, 4), std::pair(5, 7), std::pair(8, 8)}) {
        engine::Settings settings;
        settings.tile_width = width;
        settings.tile_height = height;
        ASSERT_EQ(engine::render(random.scene, camera, job, nullptr, settings).rgb, image.rgb)
            << "seed " << seed << ", tiles of " << width << "x" << height;
        for (const int rows : {1, height, 3 * height + 1, 49}) {
          Collected collected;
          engine::render(random.scene, camera, job, collected.sink(job, rows), nullptr, settings);
          ASSERT_EQ(collected.image.rgb, image.rgb) << "seed " << seed << ", bands of " << rows;
          const int expected = std::max(rows / height, 1) * height;
          for (std::size_t i = 0; i + 1 < collected.heights.size(); ++i)
            ASSERT_EQ(collected.heights[i], expected) << rows;
        }
      }
    }
  }
}

TEST(Streaming, TheTextbookTracersPictureIsTheSameForAllBands) {
  const RandomScene random = random_scene(3);
  const Camera& camera = random.scene.cameras.front();
  RenderJob job = job_of(random);
  const Image image = textbook::render(random.scene, camera, job);
  for (const int rows : {1, 7, 25, 50, 1000}) {
    double last = 0;
    job.progress = [&](double done) {
      EXPECT_GT(done, last);
      last = done;
    };
    Collected collected;
    textbook::render(random.scene, camera, job, collected.sink(job, rows));
    EXPECT_EQ(collected.image.rgb, image.rgb) << rows;
    EXPECT_EQ(collected.heights.size(),
              static_cast<std::size_t>((50 + std::min(rows, 50) - 1) / std::min(rows, 50)));
    EXPECT_DOUBLE_EQ(last, 1);
  }
}

TEST(Streaming, AFileIsTheSameStreamedAndWhole) {
  const Workplace workplace;
  const RandomScene random = random_scene(4);
  const Camera& camera = random.scene.cameras.front();
  RenderJob job = job_of(random);
  double last = 0;
  job.progress = [&](double done) { last = done; };
  for (const OwnTracer renderer : {OwnTracer::engine, OwnTracer::textbook}) {
    for (const auto& [name, encoding] :
         {std::pair("a.pfm", Encoding::linear), std::pair("a.exr", Encoding::linear),
          std::pair("a.png", Encoding::linear), std::pair("a.png", Encoding::srgb),
          std::pair("a.ppm", Encoding::course)}) {
      const auto rendered = [&](const Streaming& streaming) {
        const std::string path = workplace.path(name);
        EXPECT_FALSE(render_to_file(renderer, random.scene, camera, job, path, encoding, nullptr, streaming)
                         .is_of_one_colour);
        EXPECT_DOUBLE_EQ(last, 1);
        return read_image(path).values;
      };
      const std::vector<float> whole = rendered({never, 1});
      for (const std::int64_t pixels : {1, 16 * 45, 40 * 45, 1'000'000})
        EXPECT_EQ(rendered({1, pixels}), whole) << name << ", bands of " << pixels << " pixels";
    }
  }
}

/// A floor that is seen up to the horizon, as dark as the sky is told to be.
bool is_of_one_colour(const std::string& background, const Streaming& streaming) {
  const Workplace workplace;
  const Scene scene = read_scene("camera eye 60\nambient 1 1 1\nbackground " + background +
                                 "\ndefine material flat 0.5 0.5 0.5 0 0 0 0 0 0 1\n"
                                 "define shape box floor -1000 -1000 -1000 1000 -0.0001 -0.1 flat\n")
                          .scene;
  RenderJob job;
  job.width = 32;
  job.height = 32;
  return render_to_file(OwnTracer::engine, scene, scene.cameras.front(), job, workplace.path("a.pfm"),
                        Encoding::linear, nullptr, streaming)
      .is_of_one_colour;
}

TEST(Streaming, OneColourIsThatOfAllBands) {
  for (const Streaming& streaming : {Streaming{never, 1}, Streaming{1, 1}, Streaming{1, 17 * 32}}) {
    EXPECT_TRUE(is_of_one_colour("0.5 0.5 0.5", streaming));
    // Each of two bands has one colour.
    EXPECT_FALSE(is_of_one_colour("0.5 0.5 0.25", streaming));
  }
}

TEST(Streaming, WhatTakingABandThrowsEndsTheRender) {
  const RandomScene random = random_scene(5);
  const RenderJob job = job_of(random);
  for (const int threads : {1, 2, 5}) {
    RenderJob some = job;
    some.threads = threads;
    int taken = 0;
    const BandSink sink{16, [&](Image&&) {
                          if (++taken == 2) throw std::runtime_error("the disk is full");
                        }};
    EXPECT_THROW(engine::render(random.scene, random.scene.cameras.front(), some, sink), std::runtime_error);
    EXPECT_EQ(taken, 2);
  }
}

// --- as a user sees it ------------------------------------------------------------------------

/// More pixels than are kept in memory; a render of all would take minutes under sanitizers.
constexpr const char* huge = "65535x4096";

TEST(Streaming, ASignalLeavesNoHalfWrittenFile) {
  for (const std::string name : {"image.ppm", "image.pfm", "image.png", "image.exr"}) {
    const Workplace workplace;
    workplace.file("scene.sdf", std::string(ball_scene));
    workplace.file(name, "old");
    // It has begun to write when there is a file aside.
    const auto result =
        run_shell("\"$0\" render scene.sdf --size " + std::string(huge) + " -o " + name +
                      " & pid=$!; for i in $(seq 1000); do ls .plumb-* >/dev/null 2>&1 && break; "
                      "sleep 0.1; done; ls -A | grep -c '^.plumb-'; kill -TERM $pid; wait $pid; "
                      "echo $?",
                  workplace.directory());
    EXPECT_EQ(result.output.substr(0, 2), "1\n") << result.output;
    EXPECT_TRUE(contains(result.output, "143\n")) << result.output;
    EXPECT_EQ(listing(workplace.directory()), (std::vector<std::string>{name, "scene.sdf"}));
    EXPECT_EQ(read_file(workplace.path(name)), "old");
  }
}

TEST(Streaming, AFullDiskIsNamedWhenItIsFull) {
  for (const std::string name : {"image.ppm", "image.pfm", "image.png", "image.exr"}) {
    const Workplace workplace;
    workplace.file("scene.sdf", std::string(ball_scene));
    workplace.file(name, "old");
    expect_trouble(run_shell("trap '' XFSZ; ulimit -f 8; exec \"$0\" render scene.sdf --size " +
                                 std::string(huge) + " -o " + name,
                             workplace.directory()),
                   {name, "cannot be written", "File too large"});
    EXPECT_EQ(listing(workplace.directory()), (std::vector<std::string>{name, "scene.sdf"}));
    EXPECT_EQ(read_file(workplace.path(name)), "old");
  }
}

}  // namespace
}  // namespace plumb::tests
