// Counts what a render did.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "tracer/system/stopwatch.hpp"

namespace plumb::engine {

struct Statistics {
  std::uint64_t camera_rays = 0, shadow_rays = 0, mirrored_rays = 0, refracted_rays = 0;
  std::uint64_t bundles = 0;      ///< groups of rays that went through the hierarchy together
  std::uint64_t nodes = 0;        ///< nodes that bundles met
  std::uint64_t shape_tests = 0;  ///< tests of a vector of rays against a shape
  Seconds build, render;
  std::size_t bytes = 0, objects = 0;  ///< of the compiled scene; shared parts count once
  std::string kernel;                  ///< name of what was chosen, and why

  void add_counts(const Statistics& other) {
    camera_rays += other.camera_rays;
    shadow_rays += other.shadow_rays;
    mirrored_rays += other.mirrored_rays;
    refracted_rays += other.refracted_rays;
    bundles += other.bundles;
    nodes += other.nodes;
    shape_tests += other.shape_tests;
  }
};

}  // namespace plumb::engine
