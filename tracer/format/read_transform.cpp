// Statement: transform NAME translate|rotate|scale ...
#include <algorithm>
#include <cmath>
#include <optional>

#include "tracer/format/statements.hpp"

namespace plumb {
namespace {

using Tokens = std::vector<Token>;

std::optional<TransformStep> rotate_step(Line& line, const Token& kind, double degrees, const Vec3d& axis) {
  if (axis != Vec3d(0) && std::isnormal(glm::dot(axis, axis))) return Rotate{degrees, axis};
  line.error(kind,
             "expected a rotation axis that has a direction, not " +
                 std::string(axis == Vec3d(0) ? "0 0 0; give an axis such as 0 1 0, or remove the line"
                                              : "one as long or short as this; give an axis such as 0 1 0"));
  return std::nullopt;
}

std::optional<TransformStep> scale_step(Line& line, const Token& kind, const Vec3d& by) {
  const Vec3d size = glm::abs(by);
  if (std::min({size.x, size.y, size.z}) >= smallest_length) return Scale{by};
  line.error(kind,
             "expected no factor of 0: it flattens the object so that it has no inverse; use a small factor");
  return std::nullopt;
}

std::optional<TransformStep> transform_step(Line& line, const Token& kind, const Tokens& tokens) {
  const bool about_axis = kind.text.size() == 7 && kind.text.starts_with("rotate");
  if (kind.text != "translate" && kind.text != "rotate" && kind.text != "scale" &&
      !(about_axis && std::string_view("xyzXYZ").find(kind.text.back()) != std::string_view::npos)) {
    line.unknown_word(kind, "a transformation", {"translate", "rotate", "scale"});
    return std::nullopt;
  }
  const auto values = line.numbers(tokens, 1);
  if (!values) return std::nullopt;
  const std::size_t n = values->size();
  if (kind.text == "translate") {
    if (n == 3) return Translate{vec3(*values, 0)};
    line.wrong_count(kind, n, "3: x y z");
  } else if (kind.text == "scale") {
    if (n == 1 || n == 3) return scale_step(line, kind, n == 1 ? Vec3d((*values)[0]) : vec3(*values, 0));
    line.wrong_count(kind, n, "1 or 3: s, or x y z");
  } else if (about_axis) {
    line.loose(kind, "rotate degrees x y z");
    Vec3d axis(0);
    axis[(kind.text.back() | 0x20) - 'x'] = 1;
    if (n == 1) return Rotate{(*values)[0], axis};
    line.wrong_count(kind, n, "1: degrees");
  } else {
    if (n == 4) return rotate_step(line, kind, (*values)[0], vec3(*values, 1));
    line.wrong_count(kind, n, "4: degrees and the axis x y z");
  }
  return std::nullopt;
}

}  // namespace

void read_transform(Line& line, const Token& keyword, Tokens& tokens) {
  const auto target = line.take_name(keyword, tokens, "shape or camera");
  if (!target) return;
  if (tokens.empty()) {
    line.say(Severity::error, line.end_of({*target}),
             "found the end of the line, expected translate, rotate or scale");
    return;
  }
  const Token kind = tokens.front();
  if (const auto step = transform_step(line, kind, tokens)) {
    line.draft().transforms.push_back({{target->text, line.place_of(*target)}, *step});
  }
}

}  // namespace plumb
