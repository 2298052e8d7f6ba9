// How often `plumb diagnose` names the mistakes that a picture was made with: random scenes, random faults,
// pictures as the course's framework writes them. Faults that cannot be seen in a picture are not asked for.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <optional>
#include <random>

#include "references/diagnosis/diagnosis.hpp"
#include "tests/support/random_scene.hpp"
#include "tracer/engine/render.hpp"
#include "tracer/image/encode.hpp"

namespace plumb {
namespace {

using diagnosis::Diagnosis;
using diagnosis::FaultSet;
using diagnosis::FoundFault;
using faults::Fault;

struct Options {
  unsigned seed = 1000;
  int scenes = 30;
  int width = 480;
  int height = 320;
  bool is_told = false;
  std::string only;  ///< kind of pictures; empty: all
};

RenderJob job_of(const Options& options, const RenderOptions& render) {
  RenderJob job;
  job.width = options.width;
  job.height = options.height;
  job.options = render;
  job.threads = 1;
  return job;
}

ImageFile as_written(const Image& image) {
  ImageFile file{image.width, image.height, 3, Sample::bits8, {}, {}};
  for (const std::uint8_t byte : encode_8_bits(image, Encoding::course))
    file.values.push_back(static_cast<float>(byte) / 255);
  return file;
}

/// Because less than one pixel in a thousand is no picture to learn from.
bool differs(const ImageFile& a, const ImageFile& b) {
  std::size_t pixels = 0;
  for (std::size_t i = 0; i < a.values.size(); i += 3)
    pixels += std::equal(&a.values[i], &a.values[i] + 3, &b.values[i]) ? 0 : 1;
  return pixels * 1000 >= a.values.size() / 3;
}

/// One line of the result.
struct Tally {
  int pictures = 0, first = 0, among_three = 0, exact = 0, reported = 0, really_there = 0, verdicts = 0;
  double seconds = 0, slowest = 0;
};

class Experiment {
 public:
  Experiment(const Options& options, unsigned seed)
      : options_(options),
        random_(tests::random_scene(seed)),
        camera_(random_.scene.cameras.front()),
        job_(job_of(options, random_.options)),
        seed_(seed),
        choose_(seed) {}

  /// A picture with so many faults, each of which can be seen in it.
  void with_faults(std::size_t count, Tally& tally) {
    for (int attempt = 0; attempt < 40; ++attempt) {
      const FaultSet set = draw(count);
      const auto picture = picture_with(set);
      if (!picture || !is_seen(set, *picture)) continue;
      return judge(set, diagnosed(*picture, tally), tally);
    }
  }

  /// The right picture, from the engine in float: no code of ours that it is compared with.
  void right(Tally& tally) {
    RenderJob job = job_;
    job.real = RealType::float32;
    const Diagnosis found = diagnosed(as_written(engine::render(random_.scene, camera_, job)), tally);
    tally.verdicts += found.verdict == diagnosis::PictureVerdict::right ? 1 : 0;
  }

  /// The same by a tracer that shows a colour of its own where nothing is hit.
  void with_faults_and_background(std::size_t count, Tally& tally) {
    const Scene asked = random_.scene;
    random_.scene.background = other_background();
    for (int attempt = 0; attempt < 40; ++attempt) {
      const FaultSet set = draw(count);
      const auto picture = picture_with(set);
      if (!picture || !is_seen(set, *picture)) continue;
      asked_ = asked;
      return judge(set, diagnosed(*picture, tally), tally);
    }
  }

  void right_with_background(Tally& tally) {
    asked_ = random_.scene;
    random_.scene.background = other_background();
    const Diagnosis found = diagnosed(as_written(engine::render(random_.scene, camera_, job_)), tally);
    const bool is_told = found.verdict == diagnosis::PictureVerdict::right_apart && !found.habits.empty() &&
                         found.faults.empty() && found.explains_all();
    tally.verdicts += is_told ? 1 : 0;
    tell_if(!is_told, "right with a background of its own", found);
  }

  /// A right picture of a scene in which one number is another, which is no fault of the catalogue.
  void changed(Tally& tally) {
    asked_ = random_.scene;
    Scene& scene = random_.scene;
    const char* what = "";
    switch (choose_() % 4) {
      case 0:
        what = "a light elsewhere";
        if (!scene.lights.empty()) scene.lights.front().position += Vec3d(3, -2, 4);
        break;
      case 1:
        what = "one material";
        scene.materials.front().kd = Rgbd(1) - scene.materials.front().kd;
        break;
      case 2:
        what = "brightness";
        for (Light& light : scene.lights) light.brightness *= 0.8;
        scene.ambient *= 0.8;
        scene.background *= 0.8;
        break;
      default:
        what = "a shape elsewhere";
        scene.shapes[scene.roots().front()].transform.emplace_back(Translate{{0.7, 0.5, -0.9}});
        break;
    }
    const Diagnosis found = diagnosed(as_written(engine::render(scene, camera_, job_)), tally);
    tally.verdicts += found.faults.empty() ? 1 : 0;
    tell_if(!found.faults.empty(), what, found);
  }

  void of_another_scene(unsigned seed, Tally& tally) {
    const auto other = tests::random_scene(seed);
    RenderJob job = job_;
    job.options = other.options;
    const Image image = engine::render(other.scene, other.scene.cameras.front(), job);
    const Diagnosis found = diagnosed(as_written(image), tally);
    const bool abstains = found.verdict == diagnosis::PictureVerdict::unexplained;
    tally.verdicts += abstains ? 1 : 0;
    if (!options_.is_told) return;
    std::fprintf(stderr, "another scene, seed %u: %s, %zu pixels unexplained:", seed,
                 to_string(found.verdict), found.unexplained_pixels);
    for (const FoundFault& f : found.faults) std::fprintf(stderr, " %s(%zu)", f.fault->id.data(), f.pixels);
    std::fprintf(stderr, ", %zu pixels over\n", found.pixels_over);
  }

 private:
  FaultSet draw(std::size_t count) {
    FaultSet set;
    while (set.size() < count) {
      const std::size_t fault = choose_() % faults::fault_catalogue().size();
      if (std::find(set.begin(), set.end(), fault) == set.end()) set.push_back(fault);
    }
    std::sort(set.begin(), set.end());
    return set;
  }

  std::optional<ImageFile> picture_with(const FaultSet& set) const {
    try {
      return as_written(render_with(random_.scene, camera_, job_, diagnosis::faults_of(set)));
    } catch (const std::runtime_error&) {
      return std::nullopt;  // a scene that the fault makes untraceable
    }
  }

  bool is_seen(const FaultSet& set, const ImageFile& picture) const {
    for (const std::size_t fault : set) {
      FaultSet rest = set;
      rest.erase(std::find(rest.begin(), rest.end(), fault));
      const auto without = picture_with(rest);
      if (!without || !differs(picture, *without)) return false;
    }
    return true;
  }

  Rgbd other_background() {
    const auto share = [&] { return static_cast<double>(choose_() % 10) / 10; };
    return {share(), share(), share()};
  }

  void tell_if(bool is_asked, const char* what, const Diagnosis& found) const {
    if (!is_asked || !options_.is_told) return;
    std::fprintf(stderr, "seed %u, %s -> %s:", seed_, what, to_string(found.verdict));
    for (const FoundFault& f : found.faults) std::fprintf(stderr, " %s(%zu)", f.fault->id.data(), f.pixels);
    std::fprintf(stderr, ", %zu pixels unexplained\n", found.unexplained_pixels);
  }

  Diagnosis diagnosed(const ImageFile& picture, Tally& tally) const {
    const std::clock_t before = std::clock();
    const Diagnosis found = diagnosis::diagnose(asked_ ? *asked_ : random_.scene, camera_, job_, picture);
    const double seconds = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
    ++tally.pictures;
    tally.seconds += seconds;
    tally.slowest = std::max(tally.slowest, seconds);
    return found;
  }

  /// What cannot be told apart in the picture counts as found, and stands in the diagnosis.
  static bool is_it(const FoundFault& found, const Fault* fault) {
    return found.fault == fault ||
           std::find(found.alike.begin(), found.alike.end(), fault) != found.alike.end();
  }

  void judge(const FaultSet& set, const Diagnosis& found, Tally& tally) const {
    const std::vector<const Fault*> there = diagnosis::faults_of(set);
    const auto is_there = [&](const FoundFault& f) {
      return std::any_of(there.begin(), there.end(), [&](const Fault* fault) { return is_it(f, fault); });
    };
    const auto right = std::count_if(found.faults.begin(), found.faults.end(), is_there);
    tally.reported += static_cast<int>(found.faults.size());
    tally.really_there += static_cast<int>(right);
    tally.first += !found.faults.empty() && is_there(found.faults.front()) ? 1 : 0;
    const std::size_t three = std::min<std::size_t>(3, found.faults.size());
    tally.among_three +=
        std::any_of(found.faults.begin(), found.faults.begin() + static_cast<std::ptrdiff_t>(three), is_there)
            ? 1
            : 0;
    const bool is_exact =
        found.faults.size() == set.size() && right == static_cast<std::ptrdiff_t>(set.size());
    tally.exact += is_exact ? 1 : 0;
    if (!is_exact && options_.is_told) tell(there, found);
  }

  void tell(const std::vector<const Fault*>& there, const Diagnosis& found) const {
    std::fprintf(stderr, "seed %u: ", seed_);
    for (const Fault* fault : there) std::fprintf(stderr, "%s ", fault->id.data());
    std::fprintf(stderr, "-> %s:", to_string(found.verdict));
    for (const FoundFault& f : found.faults) std::fprintf(stderr, " %s(%zu)", f.fault->id.data(), f.pixels);
    std::fprintf(stderr, ", %zu pixels over\n", found.pixels_over);
  }

  const Options& options_;
  tests::RandomScene random_;
  const Camera& camera_;
  RenderJob job_;
  std::optional<Scene> asked_;  ///< the scene that is told to diagnose(), when it is another
  unsigned seed_;
  std::mt19937 choose_;
};

double percent(int part, int whole) { return whole == 0 ? 0 : 100.0 * part / whole; }

void print(const char* name, const Tally& t) {
  std::printf("| %s | %d | %.1f | %.1f | %.1f | %.1f | %.1f | %.1f |\n", name, t.pictures,
              percent(t.first, t.pictures), percent(t.among_three, t.pictures), percent(t.exact, t.pictures),
              percent(t.really_there, t.reported), t.seconds / std::max(1, t.pictures), t.slowest);
}

int run(const Options& options) {
  Tally single, several, habits, right, right_with, other, changed;
  for (int i = 0; i < options.scenes; ++i) {
    const unsigned seed = options.seed + static_cast<unsigned>(i);
    const auto experiment = [&] { return Experiment(options, seed); };
    const auto is_asked = [&](const char* kind) { return options.only.empty() || options.only == kind; };
    if (is_asked("one")) experiment().with_faults(1, single);
    if (is_asked("several")) experiment().with_faults(2 + seed % 3, several);
    if (is_asked("habits")) experiment().with_faults_and_background(1 + seed % 3, habits);
    if (is_asked("right")) experiment().right(right);
    if (is_asked("right-with-habits")) experiment().right_with_background(right_with);
    if (is_asked("other")) experiment().of_another_scene(seed + 100'000, other);
    if (is_asked("changed")) experiment().changed(changed);
  }
  std::printf(
      "| faults | pictures | first, %% | in three, %% | exact set, %% | really there, %% | CPU s | slowest "
      "|\n"
      "|---|---|---|---|---|---|---|---|\n");
  print("one", single);
  print("two to four", several);
  print("one to three, own background", habits);
  std::printf("right pictures called right: %d of %d (%.1f s of CPU, slowest %.1f)\n", right.verdicts,
              right.pictures, right.seconds / std::max(1, right.pictures), right.slowest);
  std::printf("right pictures with a background of their own told as that: %d of %d (%.1f s of CPU)\n",
              right_with.verdicts, right_with.pictures,
              right_with.seconds / std::max(1, right_with.pictures));
  std::printf("nobody accused where one number of the scene is another: %d of %d (%.1f s of CPU)\n",
              changed.verdicts, changed.pictures, changed.seconds / std::max(1, changed.pictures));
  std::printf("abstains from pictures of another scene: %d of %d (%.1f s of CPU, slowest %.1f)\n",
              other.verdicts, other.pictures, other.seconds / std::max(1, other.pictures), other.slowest);
  return 0;
}

}  // namespace
}  // namespace plumb

int main(int argc, char** argv) {
  plumb::Options options;
  CLI::App app("How often plumb diagnose names the mistakes that a picture was made with.");
  app.add_option("--seed", options.seed, "of the first random scene")->capture_default_str();
  app.add_option("--scenes", options.scenes, "random scenes, seven pictures of each")->capture_default_str();
  app.add_option("--width", options.width)->capture_default_str();
  app.add_option("--height", options.height)->capture_default_str();
  app.add_option("--only", options.only, "one kind of pictures")
      ->check(CLI::IsMember({"one", "several", "habits", "right", "right-with-habits", "other", "changed"}));
  app.add_flag("--tell", options.is_told, "say on standard error which sets were not found");
  CLI11_PARSE(app, argc, argv);
  return plumb::run(options);
}
