#include "references/report/explanations.hpp"

#include <exception>
#include <vector>

#include "references/attribution/ray_tree.hpp"
#include "references/report/explain.hpp"

namespace plumb::report {
namespace {

std::vector<PixelPlace> places_to_explain(const comparison::Comparison& comparison,
                                          const attribution::Budget& budget) {
  constexpr std::size_t most = 300;
  std::vector<PixelPlace> places;
  if (!budget.pixels.empty()) places.push_back({comparison.worst.x, comparison.worst.y});
  const std::size_t stride = 1 + budget.pixels.size() / most;
  for (std::size_t i = 0; i < budget.pixels.size(); i += stride)
    places.push_back({budget.pixels[i].x, budget.pixels[i].y});
  return places;
}

}  // namespace

std::map<std::pair<int, int>, std::string> explanations_of(const gates::SceneResult& result) {
  std::map<std::pair<int, int>, std::string> explanations;
  if (!result.pictures || !result.pictures->traced) return explanations;
  constexpr std::size_t most_text = 4'000'000;
  std::size_t text = 0;
  const auto& [scene, camera, options] = *result.pictures->traced;
  try {
    const attribution::TreeTracer tracer({scene, camera, result.width, result.height, options});
    for (const PixelPlace p : places_to_explain(result.comparison, result.budget)) {
      if (text > most_text) break;
      std::string& said = explanations[{p.x, p.y}] = explain_text(scene, tracer.tree_of(p.x, p.y));
      text += said.size();
    }
  } catch (const std::exception&) {
    // A page is worth having without the pixels that cannot be traced once more.
  }
  return explanations;
}

}  // namespace plumb::report
