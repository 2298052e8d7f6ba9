// Mistakes that are told from a tracer's own picture of its normals or depths.
#include "references/diagnosis/layer_diagnosis.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "references/faults/fault.hpp"
#include "tests/support/run.hpp"
#include "tracer/format/reader.hpp"

namespace plumb::diagnosis {
namespace {

using textbook::Layer;

Scene scene_of(const std::string& name) {
  return load_scene(tests::source_path("tests/scenes/" + name + ".sdf"), {});
}

/// How a student may write a component of a normal, or a depth.
using Written = std::function<float(float value)>;
float as_half(float n) { return n / 2 + 0.5F; }
float as_far(float depth) { return depth / 12; }
float as_near(float depth) { return 0.9F - depth / 15; }
float tone_mapped_half(float n) { return as_half(n) / (as_half(n) + 1); }

/// The depths that are met.
struct Range {
  float near = std::numeric_limits<float>::infinity(), far = 0;
};

Range range_of(const Shot& shot) {
  const ImageFile layers = textbook::render_layers(shot.scene, shot.camera, job_of(shot), {Layer::depth});
  Range range;
  for (std::size_t i = 3; i < layers.values.size(); i += 4) {
    const float depth = layers.values[i];
    if (depth == 0) continue;
    range.near = std::min(range.near, depth);
    range.far = std::max(range.far, depth);
  }
  return range;
}

/// Of the right tracer's depths the nearest is light and the farthest dark.
Written from_near_to_far(const Shot& shot) {
  const Range range = range_of(shot);
  return [range](float depth) { return 0.9F - 0.8F * (depth - range.near) / (range.far - range.near); };
}

float in_a_byte(float value, bool rounds) {
  const float level = std::clamp(255 * value, 0.0F, 255.0F);
  return (rounds ? std::round(level) : std::floor(level)) / 255;
}

std::vector<PixelPlace> all_places(const Shot& shot) {
  std::vector<PixelPlace> places;
  for (int y = 0; y < shot.height; ++y)
    for (int x = 0; x < shot.width; ++x) places.push_back({x, y});
  return places;
}

/// The layer in 8 bits of a tracer with these faults; nothing hit is a blue of its own.
ImageFile layer_with(const Shot& shot, Layer layer, const std::vector<const faults::Fault*>& faults,
                     const Written& written, bool rounds = true) {
  const auto places = all_places(shot);
  const auto values =
      faults::layers_with(shot.scene, shot.camera, job_of(shot), faults, {layer, Layer::object}, places);
  const std::size_t width = layer == Layer::normal ? 3 : 1, stride = 3 + width + 1;
  ImageFile file;
  file.width = shot.width;
  file.height = shot.height;
  file.channels = 3;
  file.sample = Sample::bits8;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const float* const v = &values[stride * i + 3];
    for (std::size_t c = 0; c < 3; ++c) {
      const float shown = written(v[layer == Layer::normal ? c : 0]);
      file.values.push_back(v[width] == 0 ? (c == 2 ? 0.2F : 0.0F) : in_a_byte(shown, rounds));
    }
  }
  return file;
}

/// A tracer that meets hardly anything shows no mistake of its own.
bool shows_enough(const ImageFile& file) {
  std::size_t surfaces = 0;
  for (std::size_t i = 0; i < file.values.size(); i += 3)
    surfaces += file.values[i] == 0 && file.values[i + 1] == 0 && file.values[i + 2] == 0.2F ? 0 : 1;
  return surfaces >= file.values.size() / 3 / 20;
}

bool names(const LayerDiagnosis& diagnosis, const faults::Fault& fault) {
  return std::ranges::any_of(diagnosis.faults, [&](const LayerFault& found) {
    return found.fault->id == fault.id || std::ranges::any_of(found.alike, [&](const faults::Fault* other) {
             return other->id == fault.id;
           });
  });
}

TEST(LayerDiagnosis, ARightLayerIsRightHoweverItIsWritten) {
  const Scene scene = scene_of("combined-still-life");
  const Shot shot = shot_of(scene, {});
  for (const bool rounds : {false, true}) {
    EXPECT_EQ(
        diagnose_layer(shot, layer_with(shot, Layer::normal, {}, &as_half, rounds), Layer::normal).verdict,
        LayerVerdict::right);
    EXPECT_EQ(diagnose_layer(shot, layer_with(shot, Layer::depth, {}, &as_far, rounds), Layer::depth).verdict,
              LayerVerdict::right);
    EXPECT_EQ(
        diagnose_layer(shot, layer_with(shot, Layer::depth, {}, &as_near, rounds), Layer::depth).verdict,
        LayerVerdict::right);
  }
  const auto toned =
      diagnose_layer(shot, layer_with(shot, Layer::normal, {}, &tone_mapped_half), Layer::normal);
  EXPECT_EQ(toned.verdict, LayerVerdict::right);
  EXPECT_EQ(toned.encoding, "n / 2 + 1/2, tone-mapped");
}

TEST(LayerDiagnosis, AnotherLayerOrAnotherSceneAccusesNobody) {
  const Scene scene = scene_of("combined-still-life"), other = scene_of("combined-village");
  const Shot shot = shot_of(scene, {});
  Shot others = shot_of(other, {});
  others.width = shot.width;
  others.height = shot.height;
  for (const Layer layer : {Layer::normal, Layer::depth}) {
    const Written written = layer == Layer::normal ? as_half : as_far;
    EXPECT_EQ(diagnose_layer(shot, layer_with(others, layer, {}, written), layer).verdict,
              LayerVerdict::unexplained);
  }
  EXPECT_EQ(diagnose_layer(shot, layer_with(shot, Layer::depth, {}, &as_far), Layer::normal).verdict,
            LayerVerdict::unexplained);
  EXPECT_EQ(diagnose_layer(shot, layer_with(shot, Layer::normal, {}, &as_half), Layer::depth).verdict,
            LayerVerdict::unexplained);
  const Scene empty = read_scene("define camera eye 60\nrender eye o.ppm 8 6\n").scene;
  const Shot of_nothing = shot_of(empty, {});
  EXPECT_EQ(
      diagnose_layer(of_nothing, layer_with(of_nothing, Layer::normal, {}, as_half), Layer::normal).verdict,
      LayerVerdict::unexplained);
  ImageFile grey = layer_with(shot, Layer::depth, {}, &as_far);
  std::ranges::fill(grey.values, 0.5F);
  EXPECT_EQ(diagnose_layer(shot, grey, Layer::depth).verdict, LayerVerdict::unexplained);
  EXPECT_EQ(diagnose_layer(shot, grey, Layer::normal).verdict, LayerVerdict::unexplained);
}

TEST(LayerDiagnosis, ALayerThatIsWrittenUpsideDownWithAnotherFaultShowsBoth) {
  const Scene scene = scene_of("combined-still-life");
  const Shot shot = shot_of(scene, {});
  const faults::Fault& aspect = *faults::find_fault("aspect-ignored");
  ImageFile seen = layer_with(shot, Layer::normal, {&aspect}, &as_half);
  const std::size_t row = 3 * static_cast<std::size_t>(seen.width);
  for (std::size_t y = 0; 2 * y + 1 < static_cast<std::size_t>(seen.height); ++y)
    std::swap_ranges(&seen.values[y * row], &seen.values[y * row] + row,
                     &seen.values[(static_cast<std::size_t>(seen.height) - 1 - y) * row]);
  const LayerDiagnosis diagnosis = diagnose_layer(shot, seen, Layer::normal);
  ASSERT_EQ(diagnosis.verdict, LayerVerdict::faults);
  EXPECT_TRUE(names(diagnosis, aspect));
  EXPECT_TRUE(names(diagnosis, *faults::find_fault("upside-down")));
}

struct Case {
  const char* scene;
  Layer layer;
};

class EachFault : public testing::TestWithParam<Case> {};

/// Each fault that changes the layer by a twentieth of its pixels is named, or stands beside its like. None
/// that is not there is named in the place of it.
TEST_P(EachFault, IsNamedFromTheLayer) {
  const Scene scene = scene_of(GetParam().scene);
  const Layer layer = GetParam().layer;
  const Shot shot = shot_of(scene, {});
  const Written written = layer == Layer::normal ? as_half : from_near_to_far(shot);
  const ImageFile right = layer_with(shot, layer, {}, written);
  std::size_t named = 0, shown = 0;
  for (const faults::Fault& fault : faults::fault_catalogue()) {
    if (fault.after) continue;
    ImageFile seen;
    try {
      seen = layer_with(shot, layer, {&fault}, written);
    } catch (const std::runtime_error&) {
      continue;  // the scene cannot be traced with it
    }
    std::size_t changed = 0;
    for (std::size_t i = 0; i < seen.values.size(); i += 3)
      changed += std::equal(&seen.values[i], &seen.values[i] + 3, &right.values[i]) ? 0 : 1;
    if (changed == 0) continue;
    const LayerDiagnosis diagnosis = diagnose_layer(shot, seen, layer);
    EXPECT_TRUE(diagnosis.verdict != LayerVerdict::faults || names(diagnosis, fault)) << fault.id;
    if (60 * changed < seen.values.size() || !shows_enough(seen)) continue;
    ++shown;
    EXPECT_NE(diagnosis.verdict, LayerVerdict::right) << fault.id;
    const bool is_named = names(diagnosis, fault);
    named += is_named ? 1 : 0;
    if (!is_named) std::printf("not named: %s\n", std::string(fault.id).c_str());
  }
  EXPECT_GT(shown, 3U);
  EXPECT_GE(named, shown - shown / 8);
}
INSTANTIATE_TEST_SUITE_P(LayerDiagnosis, EachFault,
                         testing::Values(Case{"combined-still-life", Layer::normal},
                                         Case{"rotate-skew-axis", Layer::depth}),
                         [](const auto& test) {
                           std::string name = test.param.scene;
                           std::ranges::replace(name, '-', '_');
                           return name + (test.param.layer == Layer::normal ? "_normal" : "_depth");
                         });

}  // namespace
}  // namespace plumb::diagnosis
