#include "references/diagnosis/unseen.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "references/diagnosis/evidence.hpp"

namespace plumb::diagnosis {
namespace {

/// True if no file would tell the two colours apart.
bool is_same(float colour, float other, const OutputEncoding& encoding, std::size_t channel) {
  // because float32 rounds a sum of a hundred terms by as much, and a fault is more than another order of
  // them
  constexpr float rounding = 1e-5F;
  if (!std::isfinite(other)) return false;
  if (encoding.is_float) return std::fabs(colour - other) <= rounding * std::max(1.0F, std::fabs(colour));
  return encoding.level(colour, channel) == encoding.level(other, channel);
}

std::vector<std::string> scenes_that_show(const std::vector<const faults::Fault*>& faults) {
  std::map<std::string, std::size_t> shown;
  for (const faults::Fault* fault : faults) ++shown[std::string(fault->shown_by)];
  std::vector<std::string> scenes;
  for (const auto& [scene, count] : shown) scenes.push_back(scene);
  std::ranges::stable_sort(
      scenes, [&](const std::string& a, const std::string& b) { return shown.at(a) > shown.at(b); });
  constexpr std::size_t most = 3;
  scenes.resize(std::min(most, scenes.size()));
  return scenes;
}

}  // namespace

UnseenFaults unseen_faults(const Shot& shot, const ImageFile& seen) {
  constexpr std::size_t most_pixels = 2000, first_pixels = 100;  // most faults are seen in the first of them
  Evidence evidence(shot.scene, shot.camera, job_of(shot), seen, {});
  std::vector<PixelPlace> places = evidence.survey();
  places.resize(std::min(most_pixels, places.size()));
  evidence.look_at(places);
  const OutputEncoding encoding = evidence.fit({}, evidence.pixels()).encoding;
  const std::vector<PixelPlace> first(
      places.begin(), places.begin() + static_cast<std::ptrdiff_t>(std::min(first_pixels, places.size())));
  const std::vector<float> right = evidence.colours({}, places);
  const auto is_unseen_at = [&](std::size_t fault, const std::vector<PixelPlace>& at) {
    const std::vector<float> other = evidence.colours({fault}, at);
    for (std::size_t i = 0; i < other.size(); ++i)
      if (!is_same(right[i], other[i], encoding, i % 3)) return false;
    return true;
  };
  UnseenFaults unseen;
  unseen.pixels = places.size();
  for (std::size_t i = 0; i < faults::fault_catalogue().size(); ++i)
    if (is_unseen_at(i, first) && is_unseen_at(i, places)) unseen.faults.push_back(&fault_at(i));
  unseen.shown_by = scenes_that_show(unseen.faults);
  return unseen;
}

}  // namespace plumb::diagnosis
