#include "references/teaching/matrix.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "tracer/format/reader.hpp"
#include "tracer/image/encode.hpp"
#include "tracer/system/in_parallel.hpp"

namespace plumb::teaching {
namespace {

/// Levels count as close up to this, because float and double may fall on either side of a level, and an
/// encoding may add one more.
constexpr int close = 2;
/// Pixels that may differ, because a diagnosis calls a picture right that is wrong in half a percent of its
/// pixels.
constexpr std::size_t enough = matrix_width * matrix_height / 200;

bool is_close(const std::uint8_t* a, const std::uint8_t* b) {
  return std::equal(a, a + 3, b, [](int p, int q) { return std::abs(p - q) <= close; });
}

/// Stops counting after `most`.
std::size_t pixels_apart(const Handed& a, const Handed& b, std::size_t most) {
  if (a.size() != b.size()) return std::max(a.size(), b.size()) / 3;
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size() && count <= most; i += 3) count += is_close(&a[i], &b[i]) ? 0 : 1;
  return count;
}

/// The right picture, then one for each fault.
std::vector<Handed> pictures_of(const Lesson& lesson) {
  std::vector<Handed> pictures(faults::fault_catalogue().size() + 1);
  in_parallel(pictures.size(), processors(), [&](std::size_t i) {
    pictures[i] = i == 0 ? handed(lesson, {}) : handed(lesson, {&faults::fault_catalogue()[i - 1]});
  });
  return pictures;
}

/// Tells of each pair of a lesson's pictures whether they differ.
std::vector<bool> pairs_told_apart(const std::vector<Handed>& pictures) {
  const std::size_t count = pictures.size();
  std::vector<bool> apart(count * count);
  for (std::size_t a = 0; a < count; ++a) {
    for (std::size_t b = 0; b < a; ++b)
      apart[a * count + b] = apart[b * count + a] = are_told_apart(pictures[a], pictures[b]);
  }
  return apart;
}

}  // namespace

std::vector<Lesson> lessons_in(const std::string& directory) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    if (entry.path().extension() == ".sdf") files.push_back(entry.path());
  }
  if (files.empty()) throw std::runtime_error(directory + ": found no scene, expected files *.sdf in it");
  std::sort(files.begin(), files.end());
  std::vector<Lesson> lessons;
  for (const auto& file : files) lessons.push_back({file.filename().string(), load_scene(file.string(), {})});
  return lessons;
}

Handed handed(const Lesson& lesson, const std::vector<const faults::Fault*>& faults) {
  textbook::RenderJob job;
  job.width = matrix_width;
  job.height = matrix_height;
  std::vector<PixelPlace> places;
  for (int y = 0; y < job.height; ++y) {
    for (int x = 0; x < job.width; ++x) places.push_back({x, y});
  }
  const Camera& camera = lesson.scene.camera(lesson.scene.renders.front().camera);
  textbook::Work work(0);  // counted, never over: each pixel has its own limit, so that endless mirrors end
  Image image(job.width, job.height);
  try {
    image.rgb = faults::colours_with(lesson.scene, camera, job, faults, places, work);
  } catch (const std::runtime_error&) {
    return {};
  }
  return encode_8_bits(image, Encoding::course);
}

std::size_t difference(const Handed& a, const Handed& b) {
  return pixels_apart(a, b, std::max(a.size(), b.size()));
}

bool are_told_apart(const Handed& a, const Handed& b) { return pixels_apart(a, b, enough) > enough; }

Matrix::Matrix(const std::vector<Lesson>& lessons, const std::function<void(double)>& progress)
    : pictures_(faults::fault_catalogue().size() + 1) {
  for (const Lesson& lesson : lessons) {
    scenes_.push_back(lesson.name);
    apart_.push_back(pairs_told_apart(pictures_of(lesson)));
    progress(static_cast<double>(scenes_.size()) / static_cast<double>(lessons.size()));
  }
}

}  // namespace plumb::teaching
