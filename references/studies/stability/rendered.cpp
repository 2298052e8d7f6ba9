#include "references/studies/stability/rendered.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <semaphore>
#include <utility>

#include "references/comparison/comparison.hpp"
#include "references/renderers/ours.hpp"
#include "references/renderers/povray.hpp"
#include "references/truth/oracle.hpp"

namespace plumb::studies::stability {
namespace {

constexpr double tolerance = 1e-6;  // because agreement of pictures is that of compare()

/// Not too many at once, and Unavailable where there is none.
class SweptPovray : public renderers::PovrayRenderer {
 public:
  explicit SweptPovray(bool rescaled, std::vector<std::string> more_arguments = {})
      : renderers::PovrayRenderer({renderers::Holds::float32, std::move(more_arguments), 600, !rescaled}) {}

  renderers::Rendered render(const Shot& shot) const override {
    if (povray_version().empty()) throw Unavailable("POV-Ray is not on PATH: apt-get install povray");
    static std::counting_semaphore<> free(16);  // of 40 MiB each, most of the time asleep
    free.acquire();
    const auto release = [](std::counting_semaphore<>* held) { held->release(); };
    const std::unique_ptr<std::counting_semaphore<>, decltype(release)> held(&free, release);
    return renderers::PovrayRenderer::render(shot);
  }
};

double relative_error(double value, double truth) {
  const double error = std::abs(value - truth) / std::max(1.0, std::abs(truth));
  return std::isfinite(error) ? error : std::numeric_limits<double>::infinity();
}

/// Returns the error to the nearest of the answers: that of the worst component.
double error_of(const float* value, const truth::Answers& answers) {
  double worst = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double nearest =
        std::isnan(value[c]) ? answers.least[c] : std::clamp(value[c], answers.least[c], answers.most[c]);
    worst = std::max(worst, relative_error(value[c], nearest));
  }
  return worst;
}

bool shows(const float* value, const Rgbd& colour) {
  const std::array<float, 3> wanted{static_cast<float>(colour.x), static_cast<float>(colour.y),
                                    static_cast<float>(colour.z)};
  return comparison::is_within(wanted.data(), value, tolerance);
}

void count(Outcome& outcome, const Scene& scene, const float* value, double error) {
  outcome.relative = std::max(outcome.relative, error);
  if (error <= tolerance) return;
  outcome.wrong += 1;
  outcome.missed |= shows(value, scene.background);
  outcome.self_shadow |= shows(value, scene.ambient);  // ka is 1
}

}  // namespace

RendererOfWorlds by_textbook(RealType real) {
  RenderJob how;
  how.threads = 1;
  how.real = real;
  return std::make_shared<renderers::OurRenderer>(renderers::OwnTracer::textbook, how);
}

RendererOfWorlds by_povray(bool rescaled) { return std::make_shared<SweptPovray>(rescaled); }

RendererOfWorlds by_povray_in_other_blocks() {
  return std::make_shared<SweptPovray>(false, std::vector<std::string>{"+BS4", "+WT1"});
}

const std::string& povray_version() {
  static const std::string version = [] {
    const renderers::PovrayRenderer povray;
    try {
      povray.program();
    } catch (const renderers::PovrayError&) {
      return std::string();
    }
    return povray.facts().title + " " + povray.version();
  }();
  return version;
}

Image picture_of(const renderers::Renderer& renderer, const World& world, int side) {
  return renderer.render({world.scene, world.camera, side, side}).image;
}

Probe against_oracle(const std::string& condition, RendererOfWorlds renderer) {
  return [condition, renderer = std::move(renderer)](double value, int side) {
    const World world = world_of(condition, value).value();
    const Image image = picture_of(*renderer, world, side);
    textbook::Work work(std::numeric_limits<double>::infinity());
    const truth::Oracle oracle({world.scene, world.camera, side, side}, work);
    Outcome outcome;
    int pixels = 0;
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const float* const seen = image.pixel(x, y);
        const auto truth = oracle.colour(x, y);
        if (!truth) continue;
        const attribution::Colour exact = truth::to_colour(*truth);
        double error = error_of(seen, {exact, exact});
        if (error > tolerance) {
          const auto answers = oracle.answers(x, y);
          if (!answers) continue;
          error = error_of(seen, *answers);
        }
        ++pixels;
        count(outcome, world.scene, seen, error);
      }
    }
    outcome.counts = pixels > 0;
    if (outcome.counts) outcome.wrong /= pixels;
    return outcome;
  };
}

Probe against_each_other(const std::string& condition, RendererOfWorlds renderer, RendererOfWorlds other) {
  return [condition, renderer = std::move(renderer), other = std::move(other)](double value, int side) {
    const World world = world_of(condition, value).value();
    const Image image = picture_of(*renderer, world, side), second = picture_of(*other, world, side);
    Outcome outcome;
    outcome.counts = true;
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const float* const p = second.pixel(x, y);
        const attribution::Colour wanted{p[0], p[1], p[2]};
        const double error = error_of(image.pixel(x, y), {wanted, wanted});
        outcome.relative = std::max(outcome.relative, error);
        outcome.wrong += error > tolerance ? 1 : 0;
      }
    }
    outcome.wrong /= static_cast<double>(side) * side;
    return outcome;
  };
}

}  // namespace plumb::studies::stability
