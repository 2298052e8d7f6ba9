// What a scene file says, as plain data. Lengths share one arbitrary unit, colours are linear RGB, angles are
// degrees. Real numbers are the doubles that are nearest to the text.
#pragma once

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "tracer/formulas/box.hpp"
#include "tracer/formulas/real.hpp"
#include "tracer/formulas/transform.hpp"

namespace plumb {

using Vec3d = Vec3<double>;
using Rgbd = Rgb<double>;

struct Material {
  std::string name;
  Rgbd ka{0};
  Rgbd kd{0};
  Rgbd ks{0};
  double m = 0;      ///< Phong exponent, >= 0
  Rgbd mirror{0};    ///< kr, weight of the reflected ray
  Rgbd transmit{0};  ///< kt, weight of the refracted ray
  double eta = 1;    ///< refractive index, rounded to float32, > 0
  bool operator==(const Material&) const = default;

  bool mirrors() const { return mirror != Rgbd(0); }
  bool transmits() const { return transmit != Rgbd(0); }
};

struct Translate {
  Vec3d by;
  bool operator==(const Translate&) const = default;
};
struct Rotate {
  double degrees;
  Vec3d axis;  ///< any length but 0
  bool operator==(const Rotate&) const = default;
};
struct Scale {
  Vec3d by;  ///< no component is 0
  bool operator==(const Scale&) const = default;
};
/// Steps are kept in the order in which they act: M = step_n ... step_2 step_1.
using TransformStep = std::variant<Translate, Rotate, Scale>;

using MaterialId = std::size_t;
using ShapeId = std::size_t;

struct Sphere {
  Vec3d center{0};
  double radius = 1;  ///< > 0
  MaterialId material = 0;
  bool operator==(const Sphere&) const = default;
};
struct Box {
  Vec3d min{0};  ///< componentwise <= max
  Vec3d max{1};
  MaterialId material = 0;
  bool operator==(const Box&) const = default;
};
struct Composite {
  std::vector<ShapeId> children;
  bool operator==(const Composite&) const = default;
};

struct Shape {
  std::string name;
  std::variant<Sphere, Box, Composite> geometry;
  std::vector<TransformStep> transform;  ///< parent_from_object
  bool operator==(const Shape&) const = default;
};

/// A point light; Ip = brightness * color.
struct Light {
  std::string name;
  Vec3d position{0};
  Rgbd color{1};
  double brightness = 1;
  bool operator==(const Light&) const = default;

  Rgbd intensity() const { return brightness * color; }
};

/// By default it stands at the origin and looks along -z, with y upwards.
struct Camera {
  std::string name = "default";
  double fov_x_degrees = 45;
  Vec3d eye{0};
  Vec3d direction{0, 0, -1};
  Vec3d up{0, 1, 0};
  std::vector<TransformStep> transform;  ///< moves eye (a point), direction and up (vectors)
  bool operator==(const Camera&) const = default;
};

struct RenderRequest {
  std::string camera = "default";
  std::string file = "image.ppm";
  int width = 480;
  int height = 320;
  bool operator==(const RenderRequest&) const = default;
};

struct Scene {
  std::vector<Material> materials;
  std::vector<Shape> shapes;
  std::vector<Light> lights;
  std::vector<Camera> cameras;         ///< never empty after reading
  std::vector<RenderRequest> renders;  ///< never empty after reading; the first one counts
  Rgbd ambient{0};                     ///< Ia
  Rgbd background{0};
  bool operator==(const Scene&) const = default;

  /// Shapes that are nobody's child, in the order of the file: the children of the world.
  std::vector<ShapeId> roots() const;

  /// Throws std::invalid_argument, naming the cameras of the scene, when none has that name.
  const Camera& camera(const std::string& name) const;
};

/// Returns the material of a sphere or a box (it points into the shape), or null for a composite.
const MaterialId* material_of(const Shape& shape);

/// The children of a composite; none of a sphere or a box.
const std::vector<ShapeId>& children_of(const Shape& shape);
/// To change them; null for a sphere or a box.
std::vector<ShapeId>* own_children_of(Shape& shape);
bool is_composite(const Shape& shape);

/// M and M^-1 of successive steps in any real type, each inverse from the inverse of the part.
template <class Real>
Transform<Real> product_of(const std::vector<TransformStep>& steps) {
  Transform<Real> all;
  for (const TransformStep& step : steps) {
    const Transform<Real> one = std::visit(
        [](const auto& s) -> Transform<Real> {
          using Step = std::decay_t<decltype(s)>;
          if constexpr (std::is_same_v<Step, Translate>) {
            return formulas::translate(Vec3<Real>(s.by));
          } else if constexpr (std::is_same_v<Step, Rotate>) {
            return formulas::rotate(static_cast<Real>(s.degrees), Vec3<Real>(s.axis));
          } else {
            return formulas::scale(Vec3<Real>(s.by));
          }
        },
        step);
    all = formulas::compose(one, all);
  }
  return all;
}

/// The type in which products of transforms are computed, so that a chain of thousands is rounded once.
template <class Real>
struct ProductIn {
  using Type = Real;
};
template <>
struct ProductIn<float> {
  using Type = double;
};
template <>
struct ProductIn<double> {
  using Type = long double;
};

/// The same, computed in ProductIn<Real> and rounded to Real at the end.
template <class Real>
Transform<Real> transform_of(const std::vector<TransformStep>& steps) {
  if (steps.size() < 2) return product_of<Real>(steps);
  const auto all = product_of<typename ProductIn<Real>::Type>(steps);
  return {Mat4<Real>(all.matrix), Mat4<Real>(all.inverse)};
}

/// A camera after its transform, in world space: what the slide "Kameratransformation" starts from.
template <class Real>
struct CameraPose {
  Vec3<Real> eye;
  Vec3<Real> direction;
  Vec3<Real> up;
};

template <class Real>
CameraPose<Real> pose_of(const Camera& camera) {
  const Mat4<Real> m = transform_of<Real>(camera.transform).matrix;
  return {formulas::transform_point(m, Vec3<Real>(camera.eye)),
          formulas::transform_vector(m, Vec3<Real>(camera.direction)),
          formulas::transform_vector(m, Vec3<Real>(camera.up))};
}

}  // namespace plumb
