#include "references/report/pictures.hpp"

#include "references/attribution/ray_tree.hpp"
#include "references/report/explain.hpp"

namespace plumb::references {
namespace {

std::vector<PixelPlace> places_to_explain(const Comparison& comparison, const Budget& budget) {
  constexpr std::size_t most = 300;
  std::vector<PixelPlace> places;
  if (!budget.pixels.empty()) places.push_back({comparison.worst.x, comparison.worst.y});
  const std::size_t stride = 1 + budget.pixels.size() / most;
  for (std::size_t i = 0; i < budget.pixels.size(); i += stride)
    places.push_back({budget.pixels[i].x, budget.pixels[i].y});
  return places;
}

}  // namespace

std::shared_ptr<const Pictures> pictures_of(const AttributionJob& job, const Comparison& comparison,
                                            const Budget& budget) {
  auto pictures = std::make_shared<Pictures>();
  pictures->reference = std::make_shared<const Image>(job.reference);
  pictures->ours = std::make_shared<const Image>(job.test);
  constexpr std::size_t most_text = 4'000'000;
  std::size_t text = 0;
  const TreeTracer tracer(job.shot);
  for (const PixelPlace p : places_to_explain(comparison, budget)) {
    if (text > most_text) break;
    pictures->explanations.emplace_back(p, explain_text(job.shot.scene, tracer.tree_of(p.x, p.y)));
    text += pictures->explanations.back().second.size();
  }
  return pictures;
}

}  // namespace plumb::references
