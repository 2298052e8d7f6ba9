#include "tests/support/random_scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>

namespace plumb::tests {
namespace {

class Generator {
 public:
  explicit Generator(unsigned seed) : random_(seed) {}

  RandomScene make() {
    scene_.ambient = chance(0.8) ? colour(0.4) : Rgbd(0);
    scene_.background = chance(0.7) ? colour(0.6) : Rgbd(0);
    for (int i = whole(1, 6); i > 0; --i) add_material();
    if (chance(0.6)) add_floor();
    for (int i = whole(1, 8); i > 0; --i) add_leaf();
    for (int i = whole(0, 4); i > 0; --i) add_composite();
    for (int i = whole(0, 4); i > 0; --i) add_light();
    add_camera();
    scene_.renders.push_back({scene_.cameras[0].name, "image.ppm", 64, 48});
    RandomScene made{scene_, {}};
    made.options.depth = whole(1, 9);
    made.options.glass_shadow = static_cast<GlassShadow>(whole(0, 2));
    return made;
  }

 private:
  double real(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
  int whole(int low, int high) { return std::uniform_int_distribution(low, high)(random_); }
  bool chance(double p) { return real(0, 1) < p; }
  Vec3d vector(double size) { return {real(-size, size), real(-size, size), real(-size, size)}; }
  Rgbd colour(double most) {
    return chance(0.3) ? Rgbd(real(0, most)) : Rgbd(real(0, most), real(0, most), real(0, most));
  }
  std::string name(const char* what, std::size_t number) { return what + std::to_string(number); }

  void add_material() {
    Material m;
    m.name = name("m", scene_.materials.size());
    m.ka = chance(0.8) ? colour(1) : Rgbd(0);
    m.kd = chance(0.8) ? colour(1) : Rgbd(0);
    m.ks = chance(0.7) ? colour(0.8) : Rgbd(0);
    m.m = chance(0.1) ? 0 : std::exp(real(0, 6));
    if (chance(0.4)) m.mirror = colour(0.5);
    if (chance(0.4)) {
      m.transmit = colour(0.9);
      m.eta = chance(0.15) ? 1 : static_cast<double>(static_cast<float>(real(0.8, 1.9)));
    }
    scene_.materials.push_back(m);
  }

  MaterialId any_material() {
    return static_cast<MaterialId>(whole(0, static_cast<int>(scene_.materials.size()) - 1));
  }

  /// Not flush with anything, so that no faces coincide.
  void add_floor() {
    const double top = real(-4, -2.5);
    scene_.shapes.push_back(
        {name("s", scene_.shapes.size()),
         Box{{real(-20, -10), top - 1, -30}, {real(10, 20), top, real(5, 9)}, any_material()},
         {}});
  }

  void add_leaf() {
    Shape shape{name("s", scene_.shapes.size()), Sphere{}, {}};
    if (chance(0.55)) {
      shape.geometry = Sphere{vector(3) - Vec3d(0, 0, 6), real(0.2, 1.6), any_material()};
    } else {
      const Vec3d corner = vector(3) - Vec3d(0, 0, 6);
      shape.geometry = Box{corner, corner + Vec3d(real(0.2, 2), real(0.2, 2), real(0.2, 2)), any_material()};
    }
    if (chance(0.4)) add_steps(shape.transform);
    scene_.shapes.push_back(shape);
  }

  void add_steps(std::vector<TransformStep>& steps) {
    for (int i = whole(1, 3); i > 0; --i) {
      const int kind = whole(0, 2);
      const double sign = chance(0.2) ? -1 : 1;
      if (kind == 0) steps.emplace_back(Translate{vector(1.5)});
      if (kind == 1) steps.emplace_back(Rotate{real(-40, 40), vector(1) + Vec3d(0, 0, 1.5)});
      if (kind == 2) steps.emplace_back(Scale{{sign * real(0.5, 1.5), real(0.5, 1.5), real(0.5, 1.5)}});
    }
  }

  void add_composite() {
    Composite composite;
    for (int i = whole(1, 3); i > 0; --i) {
      composite.children.push_back(
          static_cast<ShapeId>(whole(0, static_cast<int>(scene_.shapes.size()) - 1)));
    }
    Shape shape{name("s", scene_.shapes.size()), composite, {}};
    // A child that stands twice at the same place coincides with itself: every parent moves it.
    shape.transform.emplace_back(Translate{vector(2)});
    shape.transform.emplace_back(Rotate{real(-60, 60), vector(1) + Vec3d(0, 1.5, 0)});
    if (chance(0.4)) add_steps(shape.transform);
    std::sort(composite.children.begin(), composite.children.end());
    composite.children.erase(std::unique(composite.children.begin(), composite.children.end()),
                             composite.children.end());
    shape.geometry = composite;
    scene_.shapes.push_back(shape);
  }

  void add_light() {
    scene_.lights.push_back(
        {name("l", scene_.lights.size()), vector(8) + Vec3d(0, 4, 0), colour(0.7), real(0.3, 1.2)});
  }

  void add_camera() {
    Camera camera;
    camera.name = "eye";
    camera.fov_x_degrees = real(20, 100);
    camera.eye = vector(1) + Vec3d(0, 0, chance(0.25) ? -5 : 3);
    camera.direction = vector(0.3) + Vec3d(0, 0, -1);
    camera.up = vector(0.3) + Vec3d(0, 1, 0);
    if (chance(0.3)) add_steps(camera.transform);
    scene_.cameras.push_back(camera);
  }

  std::mt19937 random_;
  Scene scene_;
};

}  // namespace

RandomScene random_scene(unsigned seed) { return Generator(seed).make(); }

}  // namespace plumb::tests
