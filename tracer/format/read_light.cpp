// Statements: define light NAME ..., ambient r g b, background r g b
#include <algorithm>
#include <cmath>
#include <optional>

#include "tracer/format/statements.hpp"
#include "tracer/text/numbers.hpp"

namespace plumb {
namespace {

using Tokens = std::vector<Token>;

/// `light ambient NAME r g b` and `light diffuse NAME x y z r g b`
void light_by_kind(Line& line, Tokens& tokens) {
  const bool is_ambient = tokens[0].text == "ambient";
  line.loose(tokens[0], is_ambient ? "'ambient r g b'" : "'light NAME position color brightness'");
  const Token name = tokens[1];
  const auto values = line.numbers(tokens, 2);
  if (!values) return;
  if (values->size() != (is_ambient ? 3U : 6U)) {
    return line.wrong_count(name, values->size(), is_ambient ? "3: r g b" : "6: position x y z, color r g b");
  }
  if (is_ambient) {
    line.draft().ambient_of_lights += vec3(*values, 0);
  } else if (line.is_new(line.draft().light_names, name, line.draft().scene.lights.size(), "light")) {
    line.draft().lights.push_back(line.place_of(name));
    line.draft().scene.lights.push_back({std::string(name.text), vec3(*values, 0), vec3(*values, 3), 1});
  }
}

void light_numbers(Line& line, const Token& name, const std::vector<double>& v, Light& made) {
  if (v.size() >= 6) {
    made.position = vec3(v, 0);
    made.color = vec3(v, 3);
  }
  if (v.size() == 7) {
    made.brightness = v[6];
  } else if (v.size() == 6 && line.dialect().light_color) {
    made.brightness = 1;
  } else if (v.size() == 9 && line.dialect().nine == NineNumbers::brightness_rgb) {
    made.color *= vec3(v, 6);
  } else if ((v.size() == 9 && line.dialect().nine == NineNumbers::la_ld) ||
             (v.size() == 10 && line.dialect().la_ld_brightness)) {
    if (v.size() == 10) made.brightness = v[9];
    line.draft().ambient_of_lights += made.brightness * made.color;
    made.color = vec3(v, 6);
  } else {
    const bool known = v.size() == 6 || v.size() == 9 || v.size() == 10;
    const std::string remedy = v.size() == 6    ? "light-color"
                               : v.size() == 9  ? "la-ld"
                               : v.size() == 10 ? "la-ld-brightness"
                                                : "";
    line.wrong_count(
        name, v.size(),
        "7: position x y z, color r g b, brightness" + (known ? " (or --dialect " + remedy + ")" : ""),
        remedy);
  }
}

}  // namespace

void read_light(Line& line, const Token& keyword, Tokens& tokens) {
  if (tokens.size() > 1 && (tokens[0].text == "ambient" || tokens[0].text == "diffuse") &&
      !parse_number(tokens[1].text).complaint.empty()) {
    return light_by_kind(line, tokens);
  }
  const auto name = line.take_name(keyword, tokens, "light");
  if (!name || !line.is_new(line.draft().light_names, *name, line.draft().scene.lights.size(), "light"))
    return;
  Light made;
  made.name = name->text;
  if (const auto values = line.numbers(tokens, 0)) light_numbers(line, *name, *values, made);
  line.not_negative(*name, made.intensity(), "intensity");
  line.not_to_255(*name, made.color, "colour");
  line.draft().lights.push_back(line.place_of(*name));
  line.draft().scene.lights.push_back(made);
}

void read_colour(Line& line, const Token& keyword, const Tokens& tokens, Rgbd& colour, int& earlier_line) {
  const auto values = line.numbers(tokens, 0);
  if (!values) return;
  if (values->size() == 1) line.loose(keyword, "three numbers r g b, not a single grey one");
  if (values->size() != 1 && values->size() != 3)
    return line.wrong_count(keyword, values->size(), "3: r g b");
  if (earlier_line != 0) {
    line.warning(keyword, "'" + std::string(keyword.text) + "' is given again; line " +
                              std::to_string(earlier_line) + " no longer counts");
  }
  earlier_line = line.number();
  colour = values->size() == 1 ? Rgbd((*values)[0]) : vec3(*values, 0);
}

}  // namespace plumb
