#include "references/attribution/look.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "tracer/scene/hierarchy.hpp"
#include "tracer/textbook/rows.hpp"

namespace plumb::references {
namespace {

/// Beside the objects that it is held against: what shading a ray costs.
constexpr double units_of_shading_a_look = 20;
constexpr std::size_t largest_piece = 32;
constexpr std::size_t pieces_at_once = 16;

}  // namespace

SpreadPixels::SpreadPixels(int width, int height)
    : width_(static_cast<std::size_t>(width)), pixels_(width_ * static_cast<std::size_t>(height)) {
  step_ = std::max<std::size_t>(
      1, static_cast<std::size_t>(static_cast<double>(pixels_) * (std::numbers::phi - 1)));
  while (std::gcd(step_, pixels_) != 1) ++step_;
}

PixelPlace SpreadPixels::operator[](std::size_t i) const {
  const std::size_t at = i * step_ % pixels_;
  return {static_cast<int>(at % width_), static_cast<int>(at / width_)};
}

double units_of_ray(const Scene& scene) {
  const auto counts = count_instances(scene);
  double instances = 0;
  for (const ShapeId root : scene.roots()) instances += static_cast<double>(counts[root]);
  return (units_of_shading_a_look + instances) * static_cast<double>(1 + scene.lights.size());
}

std::size_t look_at(std::size_t n, const LookLimit& limit,
                    const std::function<double(std::size_t begin, std::size_t end)>& look) {
  // The limit is looked at now and then; between, no more than about a quarter of it should be spent.
  const double share = limit.most_units / (4 * pieces_at_once * limit.units_of_ray);
  const auto piece = static_cast<std::size_t>(std::clamp(share, 1.0, static_cast<double>(largest_piece)));
  const std::size_t at_once = share < 1 ? 1 : pieces_at_once;
  double spent = 0;
  std::size_t done = 0;
  while (done < n && spent < limit.most_units) {
    const std::size_t end = std::min(n, done + piece * at_once);
    std::vector<double> rays((end - done + piece - 1) / piece);
    const int pieces = static_cast<int>(rays.size());
    textbook::for_each_row(pieces, std::min(limit.threads, pieces), {}, [&](int at) {
      const std::size_t begin = done + static_cast<std::size_t>(at) * piece;
      rays[static_cast<std::size_t>(at)] = look(begin, std::min(end, begin + piece));
    });
    spent += limit.units_of_ray * std::accumulate(rays.begin(), rays.end(), 0.0);
    done = end;
    if (limit.progress)
      limit.progress(std::min(
          1.0, std::max(spent / limit.most_units, static_cast<double>(done) / static_cast<double>(n))));
  }
  return done;
}

}  // namespace plumb::references
