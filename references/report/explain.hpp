// A ray tree in words and as JSON: every ray, what it meets, and each term with its formula's slide.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "references/attribution/ray_tree.hpp"

namespace plumb::report {

/// Says what a reader of the sum must know when rays were not traced; else empty.
std::string cut_note(const attribution::RayNode& tree);

/// Says where the engine, whose pictures `verify` compares, comes to another colour than the rays shown,
/// which the textbook tracer traces; else empty. They may differ by the tolerance of `verify`.
std::string engine_note(const Rgbd& of_rays, const Rgbd& of_engine);

/// Returns indented lines, the camera ray first. `scene` is the one that the tree was made from.
std::string explain_text(const Scene& scene, const attribution::RayNode& tree);

/// Returns the same as nested objects: ray, depth, met {shape, t, point, normal, material, of a box face},
/// ambient, lights {n.l, distance, Ip, kd, ks, m, delta, then diffuse and specular or the blocker}, local,
/// children, each with its weight, colour. Lengths and points are in world space.
nlohmann::ordered_json explain_json(const Scene& scene, const attribution::RayNode& tree);

}  // namespace plumb::report
