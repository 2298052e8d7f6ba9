// Writes a scene as POV-Ray 3.7 scene description language that renders to the same picture.
#pragma once

#include <string>

#include "tracer/scene/shot.hpp"

namespace plumb::exporters {

/// The space of an export: a world point p becomes scale * (p - center).
struct ExportSpace {
  double scale;  ///< a power of two, so that scaling rounds nothing
  Vec3d center;  ///< 0 unless the scene lies far from the origin
  /// If true, shapes that a matrix presses flat are made smaller in their own space and their matrix larger.
  /// The matrix stretches that space, and POV-Ray meets no sphere farther than 1e7 there.
  bool shrinks_pressed = true;
  /// If true, surfaces that coincide are written so that POV-Ray takes the one that plumb takes.
  bool decides_ties = true;
};

/// Returns the space in which the scene spans about 1e4 units. POV-Ray's tolerances are absolute (1e-6 ..
/// 1e-3). Throws SceneError when there are more than max_visited_instances.
ExportSpace export_space(const Scene& scene, const Camera& camera);

struct PovrayExport {
  std::string text;         ///< deterministic; no name of the scene is part of the code
  bool needs_flat_objects;  ///< the eye is inside glass, or surfaces coincide: POV-Ray must run with -MB
};

/// Expects a scene as read_scene returns it without errors.
PovrayExport export_povray(const Shot& shot);

/// The same in a space of the caller's. {1, 0, false, false} keeps the scene's own units, in which POV-Ray is
/// at its weakest.
PovrayExport export_povray(const Shot& shot, const ExportSpace& space);

}  // namespace plumb::exporters
