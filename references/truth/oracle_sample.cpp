#include "references/truth/oracle_sample.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "references/truth/figures.hpp"
#include "tracer/formulas/quad.hpp"
#include "tracer/textbook/rows.hpp"
#include "tracer/textbook/tracer.hpp"

namespace plumb::truth {
namespace {

using Formulas = textbook::LectureFormulas<Quad>;
using OracleTracer = textbook::Tracer<Quad, Formulas, textbook::RayBudget<Quad>>;

int edge_of_grid(const RenderJob& job) {
  const int edge = static_cast<int>(std::lround(std::sqrt(job.samples)));
  if (edge * edge == job.samples && (edge == 1 || job.pattern == SamplePattern::grid)) return edge;
  throw std::invalid_argument("found " + std::to_string(job.samples) +
                              " samples a pixel that are not in a grid, expected a square number of them: "
                              "the oracle knows no other pattern");
}

struct Traced {
  Rgbd colour{0};
  bool is_cut = false;
};

/// The pixel's samples are the pixel centres of a picture that is `edge` times as large.
Traced trace(const OracleTracer& tracer, const textbook::RayBudget<Quad>& budget, const PixelPlace& place,
             int edge) {
  Rgb<Quad> sum(Quad(0));
  bool is_cut = false;
  for (int i = 0; i < edge * edge && !is_cut; ++i) {
    sum += tracer.raycast(place.x * edge + i % edge, place.y * edge + i / edge);
    is_cut = budget.take_is_cut();
  }
  return {Rgbd(sum / Quad(edge * edge)), is_cut};
}

}  // namespace

OracleSample ask_oracle(const Scene& scene, const Camera& camera, const RenderJob& job,
                        const std::vector<PixelPlace>& places, textbook::Work& work) {
  const int edge = edge_of_grid(job);
  const textbook::World<Quad, Formulas> world(scene, {});
  std::vector<Traced> traced(places.size());
  const textbook::Looking looking{work, textbook::threads_for(job), job.progress};
  const auto look = [&](std::size_t begin, std::size_t end, textbook::Work& of_piece) {
    const textbook::RayBudget<Quad> budget(world.instances(), of_piece);
    const OracleTracer tracer(world, camera, edge * job.width, edge * job.height, job.options, budget);
    for (std::size_t i = begin; i < end; ++i) traced[i] = trace(tracer, budget, places[i], edge);
  };
  const std::size_t looked = textbook::look_at(places.size(), looking, look);
  OracleSample sample;
  for (std::size_t i = 0; i < looked; ++i) {
    if (traced[i].is_cut)
      ++sample.cut;
    else
      sample.pixels.push_back({places[i], traced[i].colour});
  }
  return sample;
}

std::vector<PixelPlace> most_different(const Image& a, const Image& b, std::size_t most) {
  struct Suspect {
    double error;
    PixelPlace place;
  };
  std::vector<Suspect> suspects;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      const double error =
          error_of_pixel(Rgbd(a.pixel(x, y)[0], a.pixel(x, y)[1], a.pixel(x, y)[2]), b, {x, y});
      if (error > 0) suspects.push_back({error, {x, y}});
    }
  }
  const auto end = suspects.begin() + static_cast<std::ptrdiff_t>(std::min(most, suspects.size()));
  std::partial_sort(suspects.begin(), end, suspects.end(),
                    [](const Suspect& s, const Suspect& t) { return s.error > t.error; });
  std::vector<PixelPlace> places;
  for (auto at = suspects.begin(); at != end; ++at) places.push_back(at->place);
  return places;
}

}  // namespace plumb::truth
