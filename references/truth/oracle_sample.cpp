#include "references/truth/oracle_sample.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "references/attribution/ray_tree.hpp"
#include "references/truth/figures.hpp"
#include "tracer/formulas/quad.hpp"
#include "tracer/textbook/rows.hpp"
#include "tracer/textbook/tracer.hpp"

namespace plumb::references {
namespace {

/// Counts the rays of one pixel and follows no more than most_rays_of_pixel.
struct RayCounter : textbook::NoObserver<Quad> {
  std::size_t* rays;
  explicit RayCounter(std::size_t& counted) : rays(&counted) {}
  bool ray_begins(textbook::RayKind, const Ray<Quad>&, int) const { return ++*rays <= most_rays_of_pixel; }
};

using Formulas = textbook::LectureFormulas<Quad>;
using OracleTracer = textbook::Tracer<Quad, Formulas, RayCounter>;

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
Traced trace(const OracleTracer& tracer, const PixelPlace& place, int edge, std::size_t& rays, double& all) {
  Rgb<Quad> sum(Quad(0));
  bool is_cut = false;
  for (int i = 0; i < edge * edge && !is_cut; ++i) {
    rays = 0;
    sum += tracer.raycast(place.x * edge + i % edge, place.y * edge + i / edge);
    is_cut = rays > most_rays_of_pixel;
    all += static_cast<double>(rays);
  }
  return {Rgbd(sum / Quad(edge * edge)), is_cut};
}

}  // namespace

OracleSample ask_oracle(const Scene& scene, const Camera& camera, const RenderJob& job,
                        const std::vector<PixelPlace>& places, double most_units) {
  const int edge = edge_of_grid(job);
  const textbook::World<Quad, Formulas> world(scene, {});
  std::vector<Traced> traced(places.size());
  const LookLimit limit{most_units, units_of_ray(scene), textbook::threads_for(job), job.progress};
  const std::size_t looked = look_at(places.size(), limit, [&](std::size_t begin, std::size_t end) {
    std::size_t rays = 0;
    double all = 0;
    const OracleTracer tracer(world, camera, edge * job.width, edge * job.height, job.options,
                              RayCounter(rays));
    for (std::size_t i = begin; i < end; ++i) traced[i] = trace(tracer, places[i], edge, rays, all);
    return all;
  });
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

}  // namespace plumb::references
