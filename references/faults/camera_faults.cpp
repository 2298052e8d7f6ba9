// Slides "Kameramodell" and "Kameratransformation".
#include <array>
#include <cmath>
#include <numbers>

#include "references/faults/areas.hpp"

namespace plumb::faults {
namespace {

/// How the width of 1 of the image plane is turned into its height.
enum class Aspect { right, ignored, vertical };

/// Pixel (x, y) on the image plane, by its centre or its lower left corner.
template <Aspect aspect, bool by_corner>
Vec2<double> plane_point(int x, int y, int width, int height) {
  const double in_pixel = by_corner ? 0 : 0.5;
  const double right = (x + in_pixel) / width - 0.5;
  const double up = ((height - 1 - y) + in_pixel) / height - 0.5;
  const double per_side = static_cast<double>(height) / width;
  if constexpr (aspect == Aspect::vertical) return {right / per_side, up};
  return {right, aspect == Aspect::ignored ? up : up * per_side};
}

using PlanePoint = decltype(textbook::FormulaTable<double>::image_plane_point);
struct ByCentreOrCorner {
  PlanePoint centre;
  PlanePoint corner;
};
constexpr std::array<ByCentreOrCorner, 3> plane_points{
    {{&formulas::image_plane_point<double>, &plane_point<Aspect::right, true>},
     {&plane_point<Aspect::ignored, false>, &plane_point<Aspect::ignored, true>},
     {&plane_point<Aspect::vertical, false>, &plane_point<Aspect::vertical, true>}}};

void take_the_corner(Subject& s) {
  for (const auto& [centre, corner] : plane_points) {
    if (s.formulas.image_plane_point == centre) s.formulas.image_plane_point = corner;
  }
}

void take_aspect(Subject& s, Aspect aspect) {
  bool by_corner = false;
  for (const auto& known : plane_points) by_corner |= s.formulas.image_plane_point == known.corner;
  const auto& [centre, corner] = plane_points.at(static_cast<std::size_t>(aspect));
  s.formulas.image_plane_point = by_corner ? corner : centre;
}

Mat4<double> matrix_with(const Vec3d& eye, const Vec3d& direction, const Vec3d& up, double sign_of_n) {
  Mat4<double> matrix = formulas::camera_matrix(eye, direction, up);
  matrix[2] *= sign_of_n;
  return matrix;
}

/// Truncates the distance of the plane, measured in pixels, by a field of view that gives that distance.
void truncate_distance(Subject& s) {
  const double pixels = s.job.width * formulas::image_plane_distance(s.camera.fov_x_degrees);
  const double whole = std::max(1.0, std::floor(pixels));
  s.camera.fov_x_degrees = 2 * std::atan(s.job.width / (2 * whole)) * 180 / std::numbers::pi;
}

std::vector<Fault> of_the_image_plane() {
  return {
      {"degrees-into-tan", 1, "Kameramodell", "The field of view goes into tan() in degrees.",
       "d = 0.5 / tan(fov / 2), fov in degrees", "d = 0.5 / tan(fov pi / 360)", "9 of 42", "camera-model.sdf",
       [](Subject& s) {
         s.formulas.image_plane_distance = [](double fov) { return 0.5 / std::tan(fov / 2); };
       },
       nullptr},
      {"full-angle-as-half", 2, "Kameramodell", "The whole field of view is used where half of it belongs.",
       "d = 0.5 / tan(fov)", "d = 0.5 / tan(fov / 2)", "6 of 42", "camera-model.sdf",
       [](Subject& s) {
         s.formulas.image_plane_distance = [](double fov) { return 0.5 / std::tan(formulas::radians(fov)); };
       },
       nullptr},
      {"aspect-ignored", 3, "Kameramodell", "The image plane is a square whatever the picture's shape.",
       "y' = y / h - 0.5", "y' = (y / h - 0.5) h / w", "14 of 42", "camera-model.sdf",
       [](Subject& s) { take_aspect(s, Aspect::ignored); }, nullptr},
      {"field-of-view-vertical", 3, "Kameramodell", "The field of view is taken from bottom to top.",
       "x' = (x / w - 0.5) w / h, y' = y / h - 0.5", "x' = x / w - 0.5, y' = (y / h - 0.5) h / w", "4 of 42",
       "camera-model.sdf", [](Subject& s) { take_aspect(s, Aspect::vertical); }, nullptr},
      {"pixel-corner", 4, "Kameramodell", "The ray goes through the pixel's corner instead of its centre.",
       "x' = x / w - 0.5", "x' = (x + 0.5) / w - 0.5", "38 of 42", "prototype-401.sdf", &take_the_corner,
       nullptr},
      {"image-plane-distance-truncated", 8, "Kameramodell",
       "The distance of the image plane, in pixels, is kept in an integer.",
       "d = int(w / 2 / tan(fov / 2)) / w", "d = 0.5 / tan(fov / 2)", "2 of 42", "camera-model.sdf",
       &truncate_distance, nullptr},
  };
}

std::vector<Fault> of_the_pose() {
  return {
      {"camera-without-effect", 5, "Kameratransformation",
       "Eye, direction and up are read but never used: the camera stays at the origin.", "C = I",
       "C = [u v -n e]", "6 of 42", "camera-transform.sdf",
       [](Subject& s) {
         s.formulas.camera_matrix = [](const Vec3d&, const Vec3d&, const Vec3d&) { return Mat4<double>(1); };
       },
       nullptr},
      {"camera-direction-ignored", 5, "Kameratransformation",
       "Direction and up of the camera are not used; only its eye is.", "C = [x y z e]", "C = [u v -n e]",
       "among 6 of 42", "camera-transform.sdf",
       [](Subject& s) {
         s.formulas.camera_matrix = [](const Vec3d& eye, const Vec3d&, const Vec3d&) {
           return formulas::translation_matrix(eye);
         };
       },
       nullptr},
      {"camera-up-ignored", 5, "Kameratransformation",
       "The camera's up is not used: it is always the y axis.", "u = n x (0 1 0)", "u = n x up",
       "among 6 of 42", "camera-transform.sdf",
       [](Subject& s) {
         s.formulas.camera_matrix = [](const Vec3d& eye, const Vec3d& direction, const Vec3d&) {
           return formulas::camera_matrix(eye, direction, {0, 1, 0});
         };
       },
       nullptr},
      {"camera-transform-ignored", 5, "Kameratransformation",
       "A transform of the camera is read, but it moves nothing.", "C = [u v -n e]",
       "C = [u v -n e] of M e, M n, M up", "among 6 of 42", "camera-moved-by-transform.sdf",
       [](Subject& s) { s.camera.transform.clear(); }, nullptr},
      {"camera-matrix-transposed", 6, "Kameratransformation",
       "The matrix is filled row by row, where GLM takes columns: it is transposed.", "C = [u v -n e]^T",
       "C = [u v -n e]", "4 of 42", "camera-transform.sdf",
       [](Subject& s) {
         s.formulas.camera_matrix = [](const Vec3d& eye, const Vec3d& direction, const Vec3d& up) {
           return glm::transpose(formulas::camera_matrix(eye, direction, up));
         };
       },
       nullptr},
      {"camera-looks-backwards", 6, "Kameratransformation",
       "The third column is +n while the image plane lies at -d: the camera looks backwards.",
       "C = [u v n e]", "C = [u v -n e]", "1 of 42", "camera-transform.sdf",
       [](Subject& s) {
         s.formulas.camera_matrix = [](const Vec3d& eye, const Vec3d& direction, const Vec3d& up) {
           return matrix_with(eye, direction, up, -1);
         };
       },
       nullptr},
      {"camera-direction-added", 7, "Kameratransformation",
       "The camera's direction is added to the ray's instead of turning it.", "d' = n + d", "d' = C d",
       "4 of 42", "camera-transform.sdf",
       [](Subject& s) {
         s.formulas.world_ray = [](const Mat4<double>& c, const Ray<double>& ray) {
           return Ray<double>{Vec3d(c[3]), glm::normalize(ray.direction - Vec3d(c[2]))};
         };
       },
       nullptr},
      {"eye-hard-coded", 7, "Kameratransformation", "The eye is always at the origin.", "e = (0 0 0)",
       "e = the camera's eye", "2 of 42", "camera-transform.sdf",
       [](Subject& s) {
         s.formulas.camera_matrix = [](const Vec3d&, const Vec3d& direction, const Vec3d& up) {
           return formulas::camera_matrix(Vec3d(0), direction, up);
         };
       },
       nullptr},
  };
}

}  // namespace

std::vector<Fault> families_of_the_image_plane() {
  return {
      {"field-of-view-fixed", 5, "Kameramodell", "The field of view is 90 degrees, whatever the scene says.",
       "d = 0.5", "d = 0.5 / tan(fov / 2)", "among 6 of 42", "camera-model.sdf",
       [](Subject& s) { s.camera.fov_x_degrees = 90; }, nullptr},
      {"focal-length-of-its-own", 40, "Kameramodell",
       "The distance of the image plane is a formula of its own.", "d = (180 - fov) / fov / 2",
       "d = 0.5 / tan(fov / 2)", "among 6 of 26", "camera-model.sdf",
       [](Subject& s) { s.formulas.image_plane_distance = [](double fov) { return (180 - fov) / fov / 2; }; },
       nullptr},
      {"image-plane-of-its-own", 40, "Kameramodell",
       "The distance of the image plane is a formula of its own, and its height is 1.",
       "d = (180 - fov) / fov / 2, y' = y / h - 0.5", "d = 0.5 / tan(fov / 2), y' = (y / h - 0.5) h / w",
       "among 6 of 26", "camera-model.sdf",
       [](Subject& s) {
         s.formulas.image_plane_distance = [](double fov) { return (180 - fov) / fov / 2; };
         take_aspect(s, Aspect::vertical);
       },
       nullptr},
      {"half-angle-in-the-numerator", 40, "Kameramodell", "The image plane is twice as far away.",
       "d = 1 / tan(fov / 2)", "d = 0.5 / tan(fov / 2)", "among 6 of 26", "camera-model.sdf",
       [](Subject& s) {
         s.formulas.image_plane_distance = [](double fov) {
           return 1 / std::tan(formulas::radians(fov) / 2);
         };
       },
       nullptr},
      {"whole-angle-in-the-numerator", 40, "Kameramodell", "The image plane is as wide as tan(fov).",
       "d = 1 / tan(fov)", "d = 0.5 / tan(fov / 2)", "among 6 of 26", "camera-model.sdf",
       [](Subject& s) {
         s.formulas.image_plane_distance = [](double fov) { return 1 / std::tan(formulas::radians(fov)); };
       },
       nullptr},
      {"degrees-into-tan-of-the-width", 1, "Kameramodell",
       "The whole field of view goes into tan() in degrees.", "d = 0.5 / |tan(fov)|, fov in degrees",
       "d = 0.5 / tan(fov pi / 360)", "among 9 of 42", "camera-model.sdf",
       [](Subject& s) {
         s.formulas.image_plane_distance = [](double fov) { return 0.5 / std::abs(std::tan(fov)); };
       },
       nullptr},
      {"camera-axes-not-normalised", 6, "Kameratransformation",
       "u and v keep the lengths of their cross products, which scales the picture.", "u = n x up, v = u x n",
       "u = (n x up) / |n x up|, v = u x n", "not counted", "camera-transform.sdf",
       [](Subject& s) {
         s.formulas.camera_matrix = [](const Vec3d& eye, const Vec3d& direction, const Vec3d& up) {
           const double length = glm::length(glm::cross(glm::normalize(direction), up));
           Mat4<double> matrix = formulas::camera_matrix(eye, direction, up);
           matrix[0] *= length;
           matrix[1] *= length;
           return matrix;
         };
       },
       nullptr},
      {"aspect-in-whole-numbers", 43, "Kameramodell",
       "Height by width is divided in whole numbers, which gives 0: all rows are alike.", "y' = 0",
       "y' = (y / h - 0.5) h / w", "1 of 26", "camera-model.sdf",
       [](Subject& s) {
         s.formulas.image_plane_point = [](int x, int, int width, int) {
           return Vec2<double>{(x + 0.5) / width - 0.5, 0};
         };
       },
       nullptr},
  };
}

std::vector<Fault> of_the_camera() {
  std::vector<Fault> all = of_the_image_plane();
  for (const Fault& fault : of_the_pose()) all.push_back(fault);
  return all;
}

}  // namespace plumb::faults
