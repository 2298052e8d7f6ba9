// What a picture shows of the camera, told by where things are. Colours play no part beyond their edges.
#pragma once

#include <optional>
#include <vector>

#include "references/faults/fault.hpp"
#include "tracer/image/image_file.hpp"

namespace plumb::references {

/// The camera that a picture was made with. Its faults are of fault_catalogue() and camera_families().
struct CameraFound {
  /// The faults that every camera with which the picture agrees about as well has; none when the right one is
  /// among these.
  std::vector<const Fault*> faults;
  /// For each fault, those that show every surface at the same pixels in its place.
  std::vector<std::vector<const Fault*>> alike;
  bool is_right = false;   ///< true if the right camera agrees best, and no other about as well
  std::size_t pixels = 0;  ///< number that show another surface than with the right camera
};

/// Where nothing is hit: the one colour that the picture has there.
struct BackgroundSeen {
  Rgbd colour;         ///< as the file has it, 0 to 1
  std::size_t pixels;  ///< number that have it
};

struct Geometry {
  CameraFound camera;
  std::optional<BackgroundSeen> background;
};

/// Holds the edges and regions of the picture against those that each fault of the camera gives, alone and
/// combined: field of view, shape of the image plane, pose, and the picture turned or mirrored. Returns
/// nothing when no camera agrees well, or when too many do. The job's size is the picture's.
std::optional<Geometry> geometry_of(const Scene& scene, const Camera& camera, const textbook::RenderJob& job,
                                    const ImageFile& seen);

}  // namespace plumb::references
