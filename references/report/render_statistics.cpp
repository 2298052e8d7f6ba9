#include "references/report/render_statistics.hpp"

#include <cstdio>

namespace plumb::report {
namespace {

std::string milliseconds(const engine::Seconds& seconds) {
  char text[64];
  std::snprintf(text, sizeof text, "%.1f ms, %.1f ms of CPU", 1e3 * seconds.wall, 1e3 * seconds.cpu);
  return text;
}

double per_object(const engine::Statistics& counts) {
  return counts.objects == 0 ? 0 : static_cast<double>(counts.bytes) / static_cast<double>(counts.objects);
}

}  // namespace

RayCounts rays_of(const engine::Statistics& counts) {
  return {{"camera", counts.camera_rays},
          {"shadow", counts.shadow_rays},
          {"mirrored", counts.mirrored_rays},
          {"refracted", counts.refracted_rays}};
}

std::string as_text(const RenderStatistics& s) {
  char bytes[96];
  std::snprintf(bytes, sizeof bytes, "%zu objects, %zu bytes, %.0f an object", s.counts.objects,
                s.counts.bytes, per_object(s.counts));
  std::string text = "kernel   " + s.counts.kernel + "\n";
  text += "reading  " + milliseconds(s.read) + "\n";
  if (s.has_counts) text += "building " + milliseconds(s.counts.build) + "; " + bytes + "\n";
  text += "render   " + milliseconds(s.counts.render) + "\n";
  text += "writing  " + milliseconds(s.write) + "\n";
  if (!s.has_counts) return text;
  text += "rays    ";
  for (const auto& [kind, count] : rays_of(s.counts))
    text += std::string(" ") + kind + " " + std::to_string(count);
  return text + "; in " + std::to_string(s.counts.bundles) + " bundles, through " +
         std::to_string(s.counts.nodes) + " nodes, " + std::to_string(s.counts.shape_tests) +
         " tests of a vector against a shape\n";
}

}  // namespace plumb::report
