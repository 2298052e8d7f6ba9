// Pixels that no renderer can be wrong about: where two surfaces coincide, or a ray runs exactly
// along the edge of two faces, which one is seen is chance.
#pragma once

#include <string>
#include <vector>

#include "references/comparison.hpp"
#include "tracer/scene/render_options.hpp"
#include "tracer/scene/scene.hpp"

namespace plumb::references {

/// What the pixels over the tolerance are.
struct TieReport {
  std::size_t proven = 0;           ///< pixels
  std::vector<std::string> shapes;  ///< names of the shapes that coincide, in the order of the file
};

/// Proof of a tie: every sphere and every face of a box is moved by up to 1e-8 of the scene's extent, in
/// several patterns. In some of them a ray that only touches an edge takes the face that it leaves by; what
/// is nearer to a lit point than 1e-7 of the extent casts no shadow on it; or hits within 1e-8 of it are one:
/// not met at the start of a ray, and taken by chance elsewhere. When that makes the pixel jump by more than
/// the tolerance and 1e3 times the move, and one of the outcomes is the reference's value within the
/// tolerance, then what is seen there hangs on a distance that small, and the reference decided it in one of
/// the possible ways. Shapes must take part whose move alone makes it jump. (POV-Ray takes the nearer of two
/// hits only when they are 1e-4 units apart, and a blocker only when it is 1e-3 away: 1e-8 and 1e-7 of the
/// exported scene.) A picture that differs as a whole is not tried.
TieReport prove_ties(const Scene& scene, const Camera& camera, const RenderOptions& options,
                     const Image& reference, const std::vector<PixelPlace>& pixels, double tolerance);

}  // namespace plumb::references
