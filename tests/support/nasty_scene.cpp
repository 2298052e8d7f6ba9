#include "tests/support/nasty_scene.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

namespace plumb::tests {
namespace {

class NastyGenerator {
 public:
  explicit NastyGenerator(unsigned seed) : random_(seed) {}

  RandomScene make() {
    unit_ = chance(0.5) ? 1 : std::pow(10.0, whole(-8, 8));
    step_ = chance(0.6) ? 1 : chance(0.5) ? 0.5 : 0.1;
    scene_.ambient = chance(0.5) ? Rgbd(1) : Rgbd(0.3, 0.2, 0.4);
    scene_.background = chance(0.7) ? Rgbd(0.1, 0.3, 0.6) : Rgbd(0);
    for (int i = whole(1, 4); i > 0; --i) add_material();
    for (int i = whole(1, 5); i > 0; --i) add_leaf();
    for (int i = whole(0, 2); i > 0; --i) add_neighbour();
    for (int i = whole(0, 2); i > 0; --i) add_composite();
    if (chance(0.15)) add_of_another_size();
    for (int i = whole(0, 3); i > 0; --i) add_light();
    add_camera();
    if (chance(0.3)) scale_by_transform();
    scene_.renders.push_back({scene_.cameras[0].name, "image.ppm", 32, 24});
    RandomScene made{scene_, {}};
    made.options.depth = whole(1, 8);
    made.options.glass_shadow = static_cast<GlassShadow>(whole(0, 2));
    return made;
  }

 private:
  double real(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
  int whole(int low, int high) { return std::uniform_int_distribution(low, high)(random_); }
  bool chance(double p) { return real(0, 1) < p; }
  template <std::size_t n>
  double one_of(const double (&values)[n]) {
    return values[static_cast<std::size_t>(whole(0, static_cast<int>(n) - 1))];
  }
  std::string name(const char* what, std::size_t number) { return what + std::to_string(number); }

  /// A number of the grid, of at most so many units.
  double on_grid(int most) {
    const int steps = static_cast<int>(std::lround(most / step_));
    return whole(-steps, steps) * step_ * unit_;
  }
  Vec3d place() { return {on_grid(2), on_grid(2), on_grid(2) - 5 * unit_}; }
  double edge() { return whole(1, static_cast<int>(std::lround(3 / step_))) * step_ * unit_; }

  void add_material() {
    Material m;
    m.name = name("m", scene_.materials.size());
    m.ka = Rgbd(real(0, 0.3));
    m.kd = Rgbd(real(0, 1), real(0, 1), real(0, 1));
    m.ks = chance(0.5) ? Rgbd(0.2) : Rgbd(0);
    m.m = chance(0.5) ? 10 : 0;
    if (chance(0.4)) m.mirror = Rgbd(real(0, 0.9), real(0, 0.9), real(0, 0.9));
    if (chance(0.6)) {
      m.transmit = chance(0.3) ? Rgbd(1) : Rgbd(real(0, 1), real(0, 1), real(0, 1));
      m.eta = static_cast<double>(static_cast<float>(one_of({1, 0.5, 0.8, 1.33, 1.5, 2.4})));
    }
    scene_.materials.push_back(m);
  }

  MaterialId any_material() {
    return static_cast<MaterialId>(whole(0, static_cast<int>(scene_.materials.size()) - 1));
  }
  Shape& add(const decltype(Shape::geometry)& geometry) {
    return scene_.shapes.emplace_back(Shape{name("s", scene_.shapes.size()), geometry, {}});
  }

  void add_leaf() {
    const Vec3d at = place();
    const double flat = chance(0.05) ? 0 : 1;
    if (chance(0.35)) {
      add(Sphere{at, edge() / 2, any_material()});
    } else {
      add(Box{at, at + Vec3d(edge(), edge(), flat * edge()), any_material()});
    }
    if (chance(0.25)) add_steps(scene_.shapes.back().transform);
  }

  /// A shape that has something in common with the last: all, a face, an edge, a plane, or its middle.
  void add_neighbour() {
    Shape shape = scene_.shapes.back();
    shape.name = name("s", scene_.shapes.size());
    if (auto* box = std::get_if<Box>(&shape.geometry)) {
      const Vec3d size = box->max - box->min;
      const int kind = whole(0, 4);
      if (kind == 0) box->min.x += size.x, box->max.x += size.x;
      if (kind == 1) box->min += Vec3d(size.x, 0, size.z), box->max += Vec3d(size.x, 0, size.z);
      if (kind == 2) box->min += Vec3d(-edge(), 0, 0);
      if (kind == 3) {
        const double least = std::min({size.x, size.y, size.z});
        if (least > 0) shape.geometry = Sphere{(box->min + box->max) / 2.0, least / 2, 0};
      }
    } else if (auto* sphere = std::get_if<Sphere>(&shape.geometry)) {
      const int kind = whole(0, 3);
      if (kind == 0) sphere->radius /= 2;
      if (kind == 1) sphere->center.x += 2 * sphere->radius;
      if (kind == 2)
        shape.geometry = Box{sphere->center - sphere->radius, sphere->center + sphere->radius, 0};
    }
    std::visit(
        [&](auto& geometry) {
          if constexpr (requires { geometry.material; }) geometry.material = any_material();
        },
        shape.geometry);
    scene_.shapes.push_back(shape);
  }

  void add_steps(std::vector<TransformStep>& steps) {
    for (int i = whole(1, 2); i > 0; --i) {
      const int kind = whole(0, 3);
      const Vec3d axis(whole(0, 1), whole(0, 1), 1);
      if (kind == 0) steps.emplace_back(Translate{{on_grid(1), on_grid(1), on_grid(1)}});
      if (kind == 1) steps.emplace_back(Rotate{one_of({90, 45, 180, 30, -90, 17.3}), axis});
      if (kind == 2) steps.emplace_back(Scale{{one_of({-1, 1, 0.5, 2}), one_of({-1, 1, 2}), 1}});
      if (kind == 3 && !is_flattened_) {
        steps.emplace_back(Scale{{1, one_of({1e-3, 1e-5, 1e-8, 0.1}), 1}});
        is_flattened_ = true;
      }
    }
  }

  void add_composite() {
    Composite composite;
    const bool has_one_child_twice = chance(0.3);
    for (int i = whole(1, 3); i > 0; --i) {
      composite.children.push_back(
          static_cast<ShapeId>(whole(0, static_cast<int>(scene_.shapes.size()) - 1)));
    }
    std::sort(composite.children.begin(), composite.children.end());
    composite.children.erase(std::unique(composite.children.begin(), composite.children.end()),
                             composite.children.end());
    add(composite);
    if (chance(0.6)) add_steps(scene_.shapes.back().transform);
    if (has_one_child_twice) add(composite);
  }

  /// A speck or a sky: lengths of one scene may be far apart. It is opaque, because mirrors of such sizes
  /// enlarge the last digit of a ray until it is seen.
  void add_of_another_size() {
    Material& m = scene_.materials.emplace_back(scene_.materials.front());
    m.name = name("m", scene_.materials.size() - 1);
    m.mirror = m.transmit = Rgbd(0);
    m.eta = 1;
    const MaterialId opaque = scene_.materials.size() - 1;
    const double size = one_of({1e-6, 1e-4, 1e-2, 1e2, 1e4, 1e6}) * unit_;
    if (chance(0.5)) {
      add(Sphere{place(), size, opaque});
    } else {
      const Vec3d at = place();
      add(Box{at - size, at, opaque});
    }
  }

  /// A point of the surface of a shape, as if it were not transformed: on a face, an edge or a corner.
  Vec3d on_a_surface() {
    const Shape& shape =
        scene_.shapes[static_cast<std::size_t>(whole(0, static_cast<int>(scene_.shapes.size()) - 1))];
    if (const auto* sphere = std::get_if<Sphere>(&shape.geometry)) {
      Vec3d away(0);
      away[whole(0, 2)] = chance(0.5) ? sphere->radius : -sphere->radius;
      return sphere->center + away;
    }
    if (const auto* box = std::get_if<Box>(&shape.geometry)) {
      Vec3d at(0);
      for (int axis = 0; axis < 3; ++axis) {
        const double share = one_of({0, 1, 0.5});
        at[axis] = box->min[axis] + share * (box->max[axis] - box->min[axis]);
      }
      return at;
    }
    return place();
  }

  void add_light() {
    Vec3d at = chance(0.4) ? on_a_surface() : Vec3d(on_grid(5), on_grid(5), on_grid(5));
    scene_.lights.push_back({name("l", scene_.lights.size()), at, Rgbd(1, 0.9, 0.8), real(0.3, 1.2)});
  }

  void add_camera() {
    Camera camera;
    camera.name = "eye";
    camera.fov_x_degrees = one_of({90, 60, 45, 30});
    if (chance(0.25)) camera.eye = on_a_surface();
    if (chance(0.15)) camera.eye = Vec3d(on_grid(2), on_grid(2), on_grid(2));
    if (chance(0.2)) camera.direction = Vec3d(whole(-1, 1), 0, -1);
    if (chance(0.1)) camera.direction = place() / unit_;
    if (camera.direction.x == 0 && camera.direction.z == 0) camera.direction = Vec3d(0, 0, -1);
    scene_.cameras.push_back(camera);
  }

  /// The whole world is scaled by a transform of its roots in place of its numbers.
  void scale_by_transform() {
    const double by = std::pow(10.0, whole(-3, 3));
    for (const ShapeId root : scene_.roots()) scene_.shapes[root].transform.emplace_back(Scale{Vec3d(by)});
    for (Light& light : scene_.lights) light.position *= by;
    scene_.cameras[0].eye *= by;
  }

  std::mt19937 random_;
  Scene scene_;
  double unit_ = 1;  ///< of the scene's numbers
  double step_ = 1;  ///< of the grid, in units
  bool is_flattened_ = false;
};

}  // namespace

RandomScene nasty_scene(unsigned seed) { return NastyGenerator(seed).make(); }

}  // namespace plumb::tests
