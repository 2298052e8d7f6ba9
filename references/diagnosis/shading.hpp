// What a picture shows of the shading, given its camera: faults that have their own evidence each.
#pragma once

#include <vector>

#include "references/diagnosis/diagnosis.hpp"
#include "references/diagnosis/geometry.hpp"

namespace plumb::diagnosis {

struct Shading {
  std::vector<FoundFault> faults;  ///< of fault_catalogue() and shading_families(); the largest effect first
  FaultSet set;                    ///< these and those of the camera
  double right = 0;                ///< share of the surfaces' pixels that the set makes right
};

/// Looks for the faults of the shading at pixels that show surfaces, with these faults of the camera. Each
/// that is named makes pixels right that are wrong without it, most of those that it changes, and more than
/// other faults do in its place; those that do as well stand beside it. None is named where most of the
/// picture has another cause. Leaves `evidence` looking at some of the pixels.
Shading shading_of(Evidence& evidence, const FaultSet& camera, const SurfacesSeen& surfaces);

}  // namespace plumb::diagnosis
