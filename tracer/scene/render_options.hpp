// What a renderer is asked beyond the scene.
#pragma once

namespace plumb {

/// What glass does to a shadow ray (slide "Schatten" and the decision on it).
enum class GlassShadow {
  full,      ///< the lecture: any object blocks, glass too
  none,      ///< transmissive objects cast no shadow
  filtered,  ///< the light is multiplied by kt at every surface of glass
};

struct RenderOptions {
  int depth = 8;  ///< D: trace(depth >= D) is black; the primary ray has depth 0; 1..256
  GlassShadow glass_shadow = GlassShadow::full;
  bool shadows = true;  ///< without, every light that counts is seen
  bool operator==(const RenderOptions&) const = default;
};

inline constexpr int max_depth = 256;  ///< POV-Ray's limit, so that every picture can be verified

}  // namespace plumb
