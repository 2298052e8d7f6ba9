#include "tracer/engine/compile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "tracer/engine/bounds.hpp"
#include "tracer/engine/hierarchy_builder.hpp"
#include "tracer/scene/each_kind.hpp"
#include "tracer/scene/hierarchy.hpp"

namespace plumb::engine {
namespace {

using Placement = Transform<double>;

/// Returns the factor of a similarity (any rotation, one scale), within the rounding of products of matrices;
/// else 0.
double similarity_factor(const Mat4<double>& m) {
  const Vec3<double> x(m[0]), y(m[1]), z(m[2]);
  const double squared = glm::dot(x, x);
  const double off = std::max({std::abs(glm::dot(y, y) - squared), std::abs(glm::dot(z, z) - squared),
                               std::abs(glm::dot(x, y)), std::abs(glm::dot(y, z)), std::abs(glm::dot(z, x))});
  constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();
  return off <= rounding * squared ? std::sqrt(squared) : 0;
}

bool keeps_axes(const Mat4<double>& m) {
  return m[0][1] == 0 && m[0][2] == 0 && m[1][0] == 0 && m[1][2] == 0 && m[2][0] == 0 && m[2][1] == 0;
}

template <class Real>
Affine<Real> affine_of(const Mat4<double>& m) {
  return {Vec3<Real>(m[0]), Vec3<Real>(m[1]), Vec3<Real>(m[2]), Vec3<Real>(m[3])};
}

template <class Real>
class Compiler {
 public:
  Compiler(const Scene& scene, const Settings& settings)
      : scene_(scene), counts_(count_instances(scene)), has_hierarchy_(settings.has_hierarchy) {
    count_parents(settings);
    add_lights();
    out_.groups.emplace_back();
    compile_group(0, scene.roots());
    out_.has_few_objects =
        out_.members.empty() && out_.spheres.size() + out_.boxes.size() <= settings.few_objects;
    out_.needs_instances = out_.transmits || !out_.members.empty();
  }

  CompiledScene<Real> take() { return std::move(out_); }

 private:
  struct Contents {
    std::vector<Ref> refs;
    std::vector<Bounds3> bounds;  // of members and of what is placed; others know theirs
    std::vector<Member<Real>> members;
  };

  void count_parents(const Settings& settings) {
    parents_.assign(scene_.shapes.size(), 0);
    std::uint64_t all = 0;
    for (const ShapeId root : scene_.roots()) all += counts_[root];
    is_large_ = all > settings.most_written_out;
    for (const plumb::Shape& shape : scene_.shapes) {
      for (const ShapeId child : children_of(shape)) ++parents_[child];
    }
  }

  void add_lights() {
    places_of_materials_.assign(scene_.materials.size(), no_place);
    for (const plumb::Light& l : scene_.lights) {
      if (l.intensity() != Rgb<double>(0))
        out_.lights.push_back({Vec3<Real>(l.position), Rgb<Real>(l.intensity())});
    }
    out_.background = Rgb<Real>(scene_.background);
  }

  bool is_shared(ShapeId id) const { return is_large_ && parents_[id] > 1 && counts_[id] > 1; }

  /// Fills in the group and returns its bounds.
  Bounds3 compile_group(std::uint32_t group, const std::vector<ShapeId>& children) {
    Contents contents;
    std::uint64_t next = 0;
    for (const ShapeId child : children) visit(child, Placement{}, true, next, contents);
    Group& here = out_.groups[group];
    here.first_member = static_cast<std::uint32_t>(out_.members.size());
    here.members = static_cast<std::uint32_t>(contents.members.size());
    for (Ref& ref : contents.refs) {
      if (ref.kind() == Kind::group) ref = Ref(Kind::group, ref.index() + here.first_member);
    }
    out_.members.insert(out_.members.end(), contents.members.begin(), contents.members.end());
    return build(here, contents);
  }

  void visit(ShapeId id, const Placement& parent, bool parent_is_identity, std::uint64_t& next,
             Contents& contents) {
    const plumb::Shape& shape = scene_.shapes[id];
    const bool is_identity = parent_is_identity && shape.transform.empty();
    const Placement here =
        shape.transform.empty() ? parent : formulas::compose(parent, transform_of<double>(shape.transform));
    std::visit(EachKind{[&](const plumb::Sphere& sphere) {
                          add_sphere(sphere, here, is_identity, next++, contents);
                        },
                        [&](const plumb::Box& box) { add_box(box, here, is_identity, next++, contents); },
                        [&](const Composite& composite) {
                          if (is_shared(id)) {
                            add_member(id, here, next, contents);
                            next += counts_[id];
                          } else {
                            for (const ShapeId child : composite.children)
                              visit(child, here, is_identity, next, contents);
                          }
                        }},
               shape.geometry);
  }

  /// Places materials in the order in which they are first used, and leaves out those of no shape.
  std::uint32_t place_of(MaterialId id) {
    std::uint32_t& place = places_of_materials_[id];
    if (place != no_place) return place;
    place = static_cast<std::uint32_t>(out_.materials.size());
    const plumb::Material& m = scene_.materials[id];
    out_.mirrors |= m.mirrors();
    out_.transmits |= m.transmits();
    out_.materials.push_back({Rgb<Real>(scene_.ambient * m.ka), Rgb<Real>(m.kd), Rgb<Real>(m.ks),
                              static_cast<Real>(m.m), Rgb<Real>(m.mirror), Rgb<Real>(m.transmit),
                              static_cast<Real>(m.eta)});
    return place;
  }

  Label label_of(std::uint64_t instance, MaterialId material) {
    return {static_cast<std::uint32_t>(instance), place_of(material)};
  }

  void add_sphere(const plumb::Sphere& sphere, const Placement& here, bool is_identity,
                  std::uint64_t instance, Contents& contents) {
    out_.sphere_labels.push_back(label_of(instance, sphere.material));
    const Ref ref(Kind::sphere, static_cast<std::uint32_t>(out_.spheres.size()));
    const double factor = is_identity ? 1 : similarity_factor(here.matrix);
    if (factor > 0) {
      const Vec3<double> center =
          is_identity ? sphere.center : formulas::transform_point(here.matrix, sphere.center);
      out_.spheres.push_back({Vec3<Real>(center), static_cast<Real>(sphere.radius * factor)});
      contents.refs.push_back(ref);
    } else {
      out_.spheres.push_back({Vec3<Real>(sphere.center), static_cast<Real>(sphere.radius)});
      place(ref, here, transformed(here.matrix, Sphere<double>{sphere.center, sphere.radius}), contents);
    }
  }

  void add_box(const plumb::Box& box, const Placement& here, bool is_identity, std::uint64_t instance,
               Contents& contents) {
    out_.box_labels.push_back(label_of(instance, box.material));
    const Ref ref(Kind::box, static_cast<std::uint32_t>(out_.boxes.size()));
    if (is_identity || keeps_axes(here.matrix)) {
      const Vec3<double> a = is_identity ? box.min : formulas::transform_point(here.matrix, box.min);
      const Vec3<double> b = is_identity ? box.max : formulas::transform_point(here.matrix, box.max);
      out_.boxes.push_back({Vec3<Real>(glm::min(a, b)), Vec3<Real>(glm::max(a, b))});
      contents.refs.push_back(ref);
    } else {
      out_.boxes.push_back({Vec3<Real>(box.min), Vec3<Real>(box.max)});
      place(ref, here, transformed(here.matrix, Bounds3{box.min, box.max}), contents);
    }
  }

  void place(Ref shape, const Placement& here, const Bounds3& bounds, Contents& contents) {
    contents.refs.emplace_back(Kind::placed, static_cast<std::uint32_t>(out_.placed.size()));
    contents.bounds.push_back(padded<Real>(bounds));
    out_.placed.push_back({affine_of<Real>(here.inverse), shape});
  }

  void add_member(ShapeId id, const Placement& here, std::uint64_t first, Contents& contents) {
    auto [known, is_new] = groups_.try_emplace(id);
    if (is_new) {
      const auto group = static_cast<std::uint32_t>(out_.groups.size());
      out_.groups.emplace_back();
      const Bounds3 bounds = compile_group(group, std::get<Composite>(scene_.shapes[id].geometry).children);
      groups_[id] = {group, bounds};
      known = groups_.find(id);
    }
    // Members of one group stand side by side, so their places are known when all are there.
    contents.refs.emplace_back(Kind::group, static_cast<std::uint32_t>(contents.members.size()));
    contents.bounds.push_back(padded<Real>(transformed(here.matrix, known->second.bounds)));
    contents.members.push_back({affine_of<Real>(here.inverse), known->second.group, first, counts_[id]});
  }

  Bounds3 bounds_of_ref(Ref ref, const Contents& contents, std::size_t& next_stored) const {
    if (ref.kind() == Kind::sphere) return bounds_of(out_.spheres[ref.index()]);
    if (ref.kind() == Kind::box) return bounds_of(out_.boxes[ref.index()]);
    return contents.bounds[next_stored++];
  }

  Bounds3 build(Group& here, const Contents& contents) {
    Bounds3 all;
    std::size_t stored = 0;
    for (const Ref ref : contents.refs) all.add(bounds_of_ref(ref, contents, stored));
    if (contents.refs.empty()) return all;
    here.center = (all.min + all.max) * 0.5;
    const Vec3<double> half = (all.max - all.min) * 0.5;
    const double reach = std::max({half.x, half.y, half.z});
    here.scale = reach > 0 ? 1 / reach : 1;
    std::vector<Item> items;
    items.reserve(contents.refs.size());
    stored = 0;
    for (const Ref ref : contents.refs)
      items.push_back(item_of(here, ref, bounds_of_ref(ref, contents, stored)));
    const auto first_node = out_.nodes.size();
    here.root = build_hierarchy(items, out_.nodes);
    here.typical_size = typical_size(items);
    put_in_order(first_node);
    return all;
  }

  /// Returns an item with bounds in float, rounded outward by more than the conversion rounds. Without a
  /// hierarchy, each has the bounds of the complete group, so that nothing is told apart.
  Item item_of(const Group& group, Ref ref, const Bounds3& bounds) const {
    if (!has_hierarchy_) return {{-2, -2, -2}, ref, {2, 2, 2}};
    Item item{{}, ref, {}};
    for (int k = 0; k < 3; ++k) {
      const auto at = static_cast<std::size_t>(k);
      item.min[at] =
          std::nextafter(static_cast<float>((bounds.min[k] - group.center[k]) * group.scale), -2.0F);
      item.max[at] =
          std::nextafter(static_cast<float>((bounds.max[k] - group.center[k]) * group.scale), 2.0F);
    }
    return item;
  }

  /// Returns the median of the longest edges of some thousand items. For a group it takes that of what it
  /// holds.
  double typical_size(const std::vector<Item>& items) const {
    std::vector<double> sizes;
    for (std::size_t i = 0; i < items.size(); i += 1 + items.size() / 4096) {
      const Item& item = items[i];
      double size = static_cast<double>(
          std::max({item.max[0] - item.min[0], item.max[1] - item.min[1], item.max[2] - item.min[2]}));
      if (item.ref.kind() == Kind::group) {
        const Member<Real>& member = out_.members[item.ref.index()];
        size *= out_.groups[member.group].typical_size / 2;  // a group is 2 of its units long
      }
      sizes.push_back(size);
    }
    const auto median = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), median, sizes.end());
    return *median;
  }

  /// Neighbours in the hierarchy become neighbours in memory.
  void put_in_order(std::size_t first_node) {
    std::vector<std::uint32_t> spheres, boxes;
    for (std::size_t n = first_node; n < out_.nodes.size(); ++n) {
      for (const Ref ref : out_.nodes[n].child) {
        if (ref.kind() == Kind::sphere) spheres.push_back(ref.index());
        if (ref.kind() == Kind::box) boxes.push_back(ref.index());
      }
    }
    reorder(Kind::sphere, spheres, out_.spheres, out_.sphere_labels, first_node);
    reorder(Kind::box, boxes, out_.boxes, out_.box_labels, first_node);
  }

  template <class S>
  void reorder(Kind kind, const std::vector<std::uint32_t>& order, std::vector<S>& shapes,
               std::vector<Label>& labels, std::size_t first_node) {
    if (order.empty()) return;
    const auto [least, most] = std::minmax_element(order.begin(), order.end());
    std::vector<bool> is_taken(*most - *least + 1);
    for (const std::uint32_t at : order) is_taken[at - *least] = true;
    std::vector<std::uint32_t> places;
    places.reserve(order.size());
    for (std::uint32_t at = *least; at <= *most; ++at) {
      if (is_taken[at - *least]) places.push_back(at);
    }
    std::vector<S> sorted;
    std::vector<Label> sorted_labels;
    sorted.reserve(order.size());
    sorted_labels.reserve(order.size());
    for (const std::uint32_t from : order) {
      sorted.push_back(shapes[from]);
      sorted_labels.push_back(labels[from]);
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
      shapes[places[i]] = sorted[i];
      labels[places[i]] = sorted_labels[i];
    }
    std::size_t next = 0;
    for (std::size_t n = first_node; n < out_.nodes.size(); ++n) {
      for (Ref& ref : out_.nodes[n].child) {
        if (ref.kind() == kind) ref = Ref(kind, places[next++]);
      }
    }
  }

  struct Known {
    std::uint32_t group;
    Bounds3 bounds;
  };

  const Scene& scene_;
  std::vector<std::uint64_t> counts_;
  bool has_hierarchy_;
  std::vector<std::uint32_t> parents_;
  std::map<ShapeId, Known> groups_;
  static constexpr std::uint32_t no_place = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> places_of_materials_;  // by MaterialId
  bool is_large_ = false;
  CompiledScene<Real> out_;
};

}  // namespace

template <class Real>
CompiledScene<Real> compile(const Scene& scene, const Settings& settings) {
  return Compiler<Real>(scene, settings).take();
}

template CompiledScene<float> compile<float>(const Scene&, const Settings&);
template CompiledScene<double> compile<double>(const Scene&, const Settings&);

}  // namespace plumb::engine
