// What a picture shows of the camera, told by where things are. Colours play no part beyond their edges.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "references/faults/fault.hpp"
#include "tracer/image/image_file.hpp"

namespace plumb::diagnosis {

/// The camera that a picture was made with. Its faults are of fault_catalogue() and geometry_families().
struct CameraFound {
  /// The faults of the camera with which the picture agrees best, of transforms, too. Its colours may prove
  /// them; alone they are a guess.
  std::vector<const faults::Fault*> assumed;
  /// For each of them, those that show every surface at the same pixels in its place.
  std::vector<std::vector<const faults::Fault*>> alike;
  /// Those of them that are certain: with no camera without one of their number it agrees about as well.
  std::vector<const faults::Fault*> faults;
  bool is_right = false;   ///< true if no other camera agrees about as well as the right one
  std::size_t pixels = 0;  ///< number that show another surface than with the right camera
};

/// A shape that stands where a fault of its transform puts it, whatever other shapes do.
struct ShapeElsewhere {
  const faults::Fault* fault;
  std::vector<const faults::Fault*> alike;  ///< faults that put it there, too
  std::size_t pixels = 0;                   ///< number that show another surface than without the fault
};

/// Where nothing is hit: the one colour that the picture has there.
struct BackgroundSeen {
  Rgbd colour;         ///< as the file has it, 0 to 1
  std::size_t pixels;  ///< number that have it
};

/// A pixel that shows a surface, away from the edges of all surfaces.
struct SurfaceSeen {
  PixelPlace place;
  std::uint32_t surface;  ///< the same number for the same surface
};

struct SurfacesSeen {
  std::vector<SurfaceSeen> places;  ///< evenly spread
  std::size_t pixels_of_place = 0;  ///< number that each stands for
};

struct Geometry {
  CameraFound camera;
  std::optional<BackgroundSeen> background;
  SurfacesSeen surfaces;
  /// Of shapes that the camera found shows elsewhere; empty where one fault puts all of them right.
  std::vector<ShapeElsewhere> elsewhere{};
};

/// True if a fault is one of the camera, and moves what is seen by more than a pixel.
bool is_of_geometry(const faults::Fault& fault);

/// Holds the edges and regions of the picture against those that each fault of the camera gives, alone and
/// combined: field of view, shape of the image plane, pose, and the picture turned or mirrored. Where
/// none agrees well the camera is unknown, and the rest is what the right one shows. A shape is elsewhere
/// when the picture has nearly all the edges that a fault of transforms gives it and not those that it has
/// without the fault. Returns nothing of a scene or picture that is too small or too large for that. The
/// job's size is the picture's.
std::optional<Geometry> geometry_of(const Scene& scene, const Camera& camera, const textbook::RenderJob& job,
                                    const ImageFile& seen);

}  // namespace plumb::diagnosis
