// Vectors and matrices over any real type, from GLM (column vectors, column-major matrices).
#pragma once

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace plumb {

template <class Real>
using Vec2 = glm::vec<2, Real, glm::highp>;
template <class Real>
using Vec3 = glm::vec<3, Real, glm::highp>;
/// Linear RGB, unbounded above.
template <class Real>
using Rgb = glm::vec<3, Real, glm::highp>;
/// Homogeneous matrix of an affine map; the last row is 0 0 0 1.
template <class Real>
using Mat4 = glm::mat<4, 4, Real, glm::highp>;

}  // namespace plumb
