// Statement: [define] camera NAME fov-x [eye direction up]
#include <algorithm>
#include <cmath>
#include <optional>

#include "tracer/format/statements.hpp"
#include "tracer/text/numbers.hpp"

namespace plumb {
namespace {

using Tokens = std::vector<Token>;

void camera_numbers(Line& line, const Token& name, const std::vector<double>& v, Camera& made) {
  const std::string grammar = "1 or 10: fov-x, then eye x y z, direction x y z, up x y z";
  if (v.empty()) return line.wrong_count(name, 0, grammar);
  if (v.size() != 1 && v.size() != 10) {
    const bool known = v.size() == 3 || v.size() == 4 || v.size() > 10;
    if (!known) return line.wrong_count(name, v.size(), grammar);
    if (!line.dialect().loose) {
      return line.wrong_count(name, v.size(), grammar + " (or --dialect loose)", "loose");
    }
  }
  made.fov_x_degrees = v[0];
  if (!(v[0] > 0 && v[0] < 180)) {
    line.error(name, "expected a camera with 0 < fov-x < 180 degrees, not " + to_text(v[0]));
  }
  if (v.size() == 3 || v.size() == 12) {
    line.draft().camera_resolution = {v[v.size() - 2], v[v.size() - 1], line.place_of(name)};
  }
  if (v.size() >= 4) {
    made.eye = vec3(v, 1);
  }
  if (v.size() == 4) line.warning(name, "four numbers of a camera are read as fov-x and eye");
  if (v.size() > 10 && v.size() != 12) line.warning(name, "what follows the camera's up vector is ignored");
  if (v.size() < 10) return;
  made.direction = vec3(v, 4);
  made.up = vec3(v, 7);
}

}  // namespace

void read_camera(Line& line, const Token& keyword, Tokens& tokens) {
  const auto name = line.take_name(keyword, tokens, "camera");
  if (!name || !line.is_new(line.draft().camera_names, *name, line.draft().scene.cameras.size(), "camera"))
    return;
  Camera made;
  made.name = name->text;
  line.draft().cameras.push_back(line.place_of(*name));
  const auto values = line.numbers(tokens, 0);
  if (values) camera_numbers(line, *name, *values, made);
  line.draft().scene.cameras.push_back(std::move(made));
}

}  // namespace plumb
