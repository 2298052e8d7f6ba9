#include "references/studies/chart/pareto.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

namespace plumb::studies {
namespace {

double ordered(double value) { return std::isnan(value) ? std::numeric_limits<double>::infinity() : value; }

}  // namespace

std::vector<bool> pareto_front(const std::vector<CostAndError>& points) {
  const auto cost = [&](std::size_t i) { return ordered(points[i].cost); };
  const auto error = [&](std::size_t i) { return ordered(points[i].error); };
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return cost(a) != cost(b) ? cost(a) < cost(b) : error(a) < error(b);
  });
  std::vector<bool> is_front(points.size());
  const std::size_t none = points.size();
  std::size_t best = none;  // the last one that joined the front
  for (const std::size_t i : order) {
    const bool is_equal = best != none && cost(i) == cost(best) && error(i) == error(best);
    if (best != none && !is_equal && error(i) >= error(best)) continue;
    is_front[i] = true;
    best = i;
  }
  return is_front;
}

}  // namespace plumb::studies
