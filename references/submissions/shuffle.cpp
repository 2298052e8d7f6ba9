#include "references/submissions/shuffle.hpp"

#include <algorithm>
#include <atomic>
#include <random>

#include "references/submissions/varied_text.hpp"
#include "references/teaching/matrix.hpp"
#include "tracer/format/reader.hpp"
#include "tracer/system/in_parallel.hpp"

namespace plumb::submissions {
namespace {

constexpr int most_tries = 40;
/// The factor of each next try, because the last one then varies numbers by a fiftieth of the first.
constexpr double less_each_time = 0.9;

/// What the scene is judged by: its right picture, and which faults are seen in it.
class Shown {
 public:
  explicit Shown(const Scene& scene) : lesson_{"", scene}, right_(teaching::handed(lesson_, {})) {}

  const teaching::Handed& right() const { return right_; }
  bool shows(std::size_t fault) const {
    return teaching::are_told_apart(right_, teaching::handed(lesson_, {&faults::fault_catalogue()[fault]}));
  }
  std::vector<char> faults() const {
    std::vector<char> shown(faults::fault_catalogue().size());
    in_parallel(shown.size(), processors(), [&](std::size_t i) { shown[i] = shows(i) ? 1 : 0; });
    return shown;
  }
  bool shows_just(const std::vector<char>& expected) const {
    std::atomic<bool> differs{false};
    in_parallel(expected.size(), processors(), [&](std::size_t i) {
      if (!differs && shows(i) != (expected[i] != 0)) differs = true;
    });
    return !differs;
  }

 private:
  teaching::Lesson lesson_;
  teaching::Handed right_;
};

/// Returns numbers that follow from seed, name and try alone, on every machine.
std::mt19937_64 generator(const JudgedScene& scene, std::uint64_t seed, int tried) {
  std::vector<std::uint32_t> all{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
                                 static_cast<std::uint32_t>(tried)};
  for (const char c : scene.name) all.push_back(static_cast<unsigned char>(c));
  std::seed_seq mixed(all.begin(), all.end());
  return std::mt19937_64(mixed);
}

std::string varied(const JudgedScene& scene, std::uint64_t seed, int tried, double amount) {
  std::mt19937_64 bits = generator(scene, seed, tried);
  Variation variation;
  const int kind = tried % 4;  // 0: all, and channels change places; 1: all; 2: places; 3: colours, as in 0
  variation.places = kind == 3 ? 0 : amount;
  variation.colours = kind == 2 ? 0 : amount;
  variation.random = [&bits] { return static_cast<double>(bits() >> 11) * 0x1p-52 - 1; };
  const bool mixes_colours = kind == 0 || kind == 3;
  for (std::size_t i = 2; mixes_colours && i > 0; --i)
    std::swap(variation.order.at(i), variation.order.at(bits() % (i + 1)));
  return varied_text(scene.text, scene.scene, variation);
}

bool is_alike(const Scene& a, const Scene& b) {
  const RenderRequest& one = a.renders.front();
  const RenderRequest& other = b.renders.front();
  return a.shapes.size() == b.shapes.size() && a.lights.size() == b.lights.size() &&
         one.width == other.width && one.height == other.height && one.file == other.file;
}

}  // namespace

std::optional<JudgedScene> shuffled(const JudgedScene& scene, std::uint64_t seed, const Dialect& dialect) {
  const Shown before(scene.scene);
  if (before.right().empty()) return std::nullopt;
  const std::vector<char> faults = before.faults();
  double amount = 1;
  for (int tried = 0; tried < most_tries; ++tried, amount *= less_each_time) {
    std::string text = varied(scene, seed, tried, amount);
    ReadResult read = read_scene(text, dialect);
    if (read.has_errors() || !is_alike(scene.scene, read.scene)) continue;
    const Shown after(read.scene);
    if (teaching::are_told_apart(before.right(), after.right()) && after.shows_just(faults))
      return JudgedScene{scene.name, std::move(text), std::move(read.scene)};
  }
  return std::nullopt;
}

}  // namespace plumb::submissions
