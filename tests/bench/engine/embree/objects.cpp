#include "tests/bench/engine/embree/objects.hpp"

#include <map>
#include <stdexcept>
#include <string>

#include "tests/bench/engine/embree/primitives.hpp"

namespace plumb::bench {
namespace {

void report_error(void*, RTCError, const char* text) {
  throw std::runtime_error(std::string("Embree: ") + text);
}

bool count_bytes(void* bytes, ssize_t change, bool) {
  *static_cast<std::int64_t*>(bytes) += change;
  return true;
}

}  // namespace

/// Walks the hierarchy once, flattening all but composites with several parents.
class SceneBuilder {
 public:
  SceneBuilder(EmbreeScene& target, const Scene& scene)
      : target_(target), scene_(scene), parents_(scene.shapes.size()), groups_(1) {
    for (const Shape& shape : scene.shapes) {
      const auto* composite = std::get_if<Composite>(&shape.geometry);
      if (composite == nullptr) continue;
      for (const ShapeId child : composite->children) ++parents_[child];
    }
  }

  void build() {
    for (const ShapeId root : scene_.roots()) place(root, Mat4<double>(1), 0);
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      target_.scenes_.push_back(rtcNewScene(target_.device_));
      attach_primitives(target_.device_, target_.scenes_.back(), groups_[i]);
      if (i > 0) rtcCommitScene(target_.scenes_.back());
    }
    std::vector<std::int32_t> first_of_group[2];
    for (const Group& group : groups_) list_materials(group, first_of_group);
    add_slot(Mat4<double>(1), first_of_group, 0);
    for (std::size_t i = 0; i < instances_.size(); ++i) {
      attach_instance(static_cast<unsigned>(i), instances_[i]);
      add_slot(glm::inverse(instances_[i].world_from_group), first_of_group, instances_[i].group);
    }
    target_.objects_.has_instances = !instances_.empty();
    rtcCommitScene(target_.scenes_.front());
  }

 private:
  struct Instance {
    std::size_t group;
    Mat4<double> world_from_group;
  };

  void place(ShapeId id, const Mat4<double>& parent, std::size_t group) {
    const Shape& shape = scene_.shapes[id];
    const Mat4<double> m = parent * transform_of<double>(shape.transform).matrix;
    if (const auto* box = std::get_if<Box>(&shape.geometry)) return add_box(groups_[group], *box, m);
    if (const auto* sphere = std::get_if<Sphere>(&shape.geometry)) return place_sphere(*sphere, m, group);
    if (group == 0 && parents_[id] > 1) {
      instances_.push_back({group_of(id), m});
      return;
    }
    for (const ShapeId child : std::get<Composite>(shape.geometry).children) place(child, m, group);
  }

  void place_sphere(const Sphere& sphere, const Mat4<double>& m, std::size_t group) {
    if (const double factor = similarity_factor(m); factor > 0)
      return add_sphere(groups_[group], sphere, m, factor);
    if (group != 0) throw std::runtime_error("an ellipsoid inside an instance needs two levels of instances");
    groups_.emplace_back();
    add_sphere(groups_.back(), sphere, Mat4<double>(1), 1);
    instances_.push_back({groups_.size() - 1, m});
  }

  std::size_t group_of(ShapeId composite) {
    const auto [known, is_new] = group_of_.try_emplace(composite, groups_.size());
    if (!is_new) return known->second;
    const std::size_t group = known->second;
    groups_.emplace_back();
    for (const ShapeId child : std::get<Composite>(scene_.shapes[composite].geometry).children)
      place(child, Mat4<double>(1), group);
    return group;
  }

  void attach_instance(unsigned number, const Instance& instance) const {
    const RTCGeometry geometry = rtcNewGeometry(target_.device_, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(geometry, target_.scenes_[instance.group]);
    float columns[12];
    for (int i = 0; i < 12; ++i) columns[i] = static_cast<float>(instance.world_from_group[i / 3][i % 3]);
    rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
    attach_geometry(target_.scenes_.front(), geometry, first_instance + number);
  }

  void list_materials(const Group& group, std::vector<std::int32_t> (&first)[2]) const {
    auto& all = target_.objects_.material;
    first[0].push_back(static_cast<std::int32_t>(all.size()));
    all.insert(all.end(), group.sphere_materials.begin(), group.sphere_materials.end());
    first[1].push_back(static_cast<std::int32_t>(all.size()));
    all.insert(all.end(), group.quad_materials.begin(), group.quad_materials.end());
  }

  void add_slot(const Mat4<double>& inverse, const std::vector<std::int32_t> (&first)[2],
                std::size_t group) const {
    Objects& objects = target_.objects_;
    for (int kind = 0; kind < 2; ++kind) objects.first_primitive[kind].push_back(first[kind][group]);
    for (int i = 0; i < 9; ++i) objects.normal_matrix[i].push_back(static_cast<float>(inverse[i / 3][i % 3]));
  }

  EmbreeScene& target_;
  const Scene& scene_;
  std::vector<std::size_t> parents_;
  std::vector<Group> groups_;  // the world first
  std::vector<Instance> instances_;
  std::map<ShapeId, std::size_t> group_of_;
};

EmbreeScene::EmbreeScene(const Scene& scene, int threads)
    : device_(rtcNewDevice(("threads=" + std::to_string(threads) + ",user_threads=0").c_str())) {
  if (device_ == nullptr) throw std::runtime_error("Embree makes no device");
  rtcSetDeviceErrorFunction(device_, report_error, nullptr);
  rtcSetDeviceMemoryMonitorFunction(device_, count_bytes, &bytes_);
  SceneBuilder(*this, scene).build();
}

EmbreeScene::~EmbreeScene() {
  for (const RTCScene scene : scenes_) rtcReleaseScene(scene);
  rtcReleaseDevice(device_);
}

}  // namespace plumb::bench
