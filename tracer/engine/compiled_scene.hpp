// A scene as the engine traces it: flat arrays that hold what this scene needs and nothing else.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "tracer/formulas/real.hpp"
#include "tracer/formulas/transform.hpp"

namespace plumb::engine {

/// What a place in a node refers to. `placed` is a sphere or box behind a matrix, `group` a complete
/// hierarchy.
enum class Kind : std::uint32_t { none, node, sphere, box, placed, group };

/// A kind and an index into the array of that kind, in one word; 0 is nothing.
struct Ref {
  std::uint32_t bits = 0;

  static constexpr unsigned index_bits = 29;
  Ref() = default;
  explicit constexpr Ref(std::uint32_t b) : bits(b) {}
  constexpr Ref(Kind kind, std::uint32_t index)
      : bits(static_cast<std::uint32_t>(kind) << index_bits | index) {}
  constexpr Kind kind() const { return static_cast<Kind>(bits >> index_bits); }
  constexpr std::uint32_t index() const { return bits & ((1U << index_bits) - 1); }
  bool operator==(const Ref&) const = default;
};

inline constexpr int node_width = 8;

/// Eight boxes and what is in each. Bounds are in the units of the group, rounded outward. An empty place has
/// min > max.
struct alignas(32) Node {
  std::array<std::array<float, node_width>, 6> planes;  ///< min x, y, z, max x, y, z
  std::array<Ref, node_width> child;
};

template <class Real>
struct Sphere {
  Vec3<Real> center;
  Real radius;
};

template <class Real>
struct Box {
  Vec3<Real> min, max;
};

/// The upper three rows of an affine matrix, by columns.
template <class Real>
struct Affine {
  Vec3<Real> x, y, z, origin;
};

/// The number of a shape's instance within its group, and the index of its material.
struct Label {
  std::uint32_t instance;
  std::uint32_t material;
};

/// A sphere or box that no fold can bring into the space of its group.
template <class Real>
struct Placed {
  Affine<Real> object_from_group;
  Ref shape;
};

/// A group as it stands in another one.
template <class Real>
struct Member {
  Affine<Real> member_from_group;
  std::uint32_t group;
  std::uint64_t first;  ///< number of its first instance, in the group that it stands in
  std::uint64_t count;  ///< number of instances
};

/// A hierarchy: of the world, or of what several parents share.
struct Group {
  Ref root;
  Vec3<double> center{0};  ///< units of the bounds: (p - center) * scale lies within -1..1
  double scale = 1;
  double typical_size = 1;                      ///< median size of what it holds, in these units
  std::uint32_t first_member = 0, members = 0;  ///< members are sorted by their first instance
};

template <class Real>
struct Material {
  Rgb<Real> ambient;  ///< Ia ka
  Rgb<Real> kd, ks;
  Real m;
  Rgb<Real> kr, kt;
  Real eta;
};

template <class Real>
struct Light {
  Vec3<Real> position;
  Rgb<Real> intensity;
};

template <class Real>
struct CompiledScene {
  std::vector<Node> nodes;
  std::vector<Sphere<Real>> spheres;
  std::vector<Box<Real>> boxes;
  std::vector<Placed<Real>> placed;
  std::vector<Member<Real>> members;
  std::vector<Label> sphere_labels, box_labels;  ///< parallel to spheres and boxes
  std::vector<Group> groups;                     ///< the first is the world
  std::vector<Material<Real>> materials;
  std::vector<Light<Real>> lights;
  Rgb<Real> background{0};
  bool mirrors = false, transmits = false;  ///< true if any shape does
  bool has_few_objects = false;  ///< then bundles may be of any width: all that they may meet is tested
  bool needs_instances = false;  ///< true if hits must tell instances apart: shared groups, media
};

/// Returns the label of what a ray has hit: a sphere, a box, or a placed one of them.
template <class Real>
const Label& label_of(const CompiledScene<Real>& scene, Ref ref) {
  if (ref.kind() == Kind::placed) ref = scene.placed[ref.index()].shape;
  return ref.kind() == Kind::sphere ? scene.sphere_labels[ref.index()] : scene.box_labels[ref.index()];
}

}  // namespace plumb::engine
