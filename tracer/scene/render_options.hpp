// What a renderer is asked for beyond the scene.
#pragma once

namespace plumb {

/// What glass does to a shadow ray (slide "Schatten" and the decision on it).
enum class GlassShadow {
  full,      ///< the lecture's rule: any object blocks, glass too
  none,      ///< transmissive objects cast no shadow
  filtered,  ///< the light is multiplied by kt at every surface of glass
};

struct RenderOptions {
  int depth = 8;  ///< D, from 1 to 256: trace(depth >= D) is black; the primary ray has depth 0
  GlassShadow glass_shadow = GlassShadow::full;
  bool shadows = true;  ///< false: nothing hides a light
  bool operator==(const RenderOptions&) const = default;
};

inline constexpr int max_depth = 256;  ///< POV-Ray's limit, so that every picture can be verified

}  // namespace plumb
