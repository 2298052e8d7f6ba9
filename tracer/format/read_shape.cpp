// Statements: define shape sphere|box|composite NAME ...
#include <algorithm>
#include <cmath>
#include <optional>

#include "tracer/format/statements.hpp"
#include "tracer/text/numbers.hpp"
#include "tracer/text/words.hpp"

namespace plumb {
namespace {

using Tokens = std::vector<Token>;

/// True if the last word is a name. A number there means that the material is missing.
bool is_material(const Token& token) { return !parse_number(token.text).complaint.empty(); }

void shape_count(Line& line, const Token& name, const Token& material, std::size_t found,
                 std::size_t expected, const char* what) {
  const bool missing = !is_material(material);
  line.wrong_count(name, found + (missing ? 1 : 0),
                   std::string(what) + " and the name of a material" +
                       (missing && found + 1 == expected ? "; the material is missing at the end" : ""));
}

void composite(Line& line, const Token& name, const Tokens& tokens) {
  if (tokens.empty()) {
    line.say(Severity::error, line.end_of({name}),
             "found the end of the line, expected the names of the composite's children");
  }
  const ShapeId id = line.draft().scene.shapes.size();
  for (const Token& child : tokens)
    line.draft().child_uses.push_back({id, {child.text, line.place_of(child)}});
}

void box(Line& line, const Token& name, const Token& material, const std::vector<double>& v, Shape& made) {
  if (v.size() != 6) return shape_count(line, name, material, v.size(), 6, "6: two opposite corners x y z");
  made.geometry = Box{glm::min(vec3(v, 0), vec3(v, 3)), glm::max(vec3(v, 3), vec3(v, 0)), 0};
}

void sphere(Line& line, const Token& name, const Token& material, const std::vector<double>& v, Shape& made) {
  if (v.size() != 4) return shape_count(line, name, material, v.size(), 4, "4: center x y z and radius");
  double radius = v[3];
  if (radius < 0 && line.dialect().loose) {
    line.warning(name, "radius of " + in_quotes(name.text) + " is negative: its absolute value is used");
    radius = -radius;
  }
  if (!(radius >= smallest_length)) {
    line.say(Severity::error, line.place_of(name),
             "found radius " + to_text(radius) + " of " + in_quotes(name.text) + ", expected a radius > 0" +
                 (radius < 0 ? "; remove the minus sign (or --dialect loose)"
                             : "; remove the sphere or enlarge it"),
             radius < 0 ? "loose" : "");
  }
  made.geometry = Sphere{vec3(v, 0), radius, 0};
}

void unknown_shape(Line& line, const Token& kind, const Tokens& tokens) {
  std::string hint;
  if (kind.text == "triangle" || kind.text == "cone" || kind.text == "cylinder" || kind.text == "plane") {
    hint = "; the lecture has no " + std::string(kind.text) +
           (kind.text == "plane" ? ": a large box serves"
                                 : ": remove the line, or build it from boxes and spheres");
  } else if (tokens.size() > 4 && parse_number(tokens[1].text).complaint.empty()) {
    hint = "; the kind of the shape is missing before its name";
  } else if (const auto nearest = nearest_name(kind.text, {"sphere", "box", "composite"})) {
    hint = "; did you mean '" + *nearest + "'?";
  }
  line.error(kind, "expected sphere, box or composite" + hint);
  // The names count as known, though broken, so that whoever refers to them gets no second error.
  if (tokens.size() > 1) line.draft().broken_shapes.insert(tokens[1].text);
  line.draft().broken_shapes.insert(kind.text);
}

/// Returns the name of its material; nothing, with one error, where it is not clear which word that is.
std::optional<Token> sphere_or_box(Line& line, const Token& kind, const Token& name, Tokens& tokens,
                                   Shape& made) {
  const bool is_sphere = kind.text == "sphere";
  if (tokens.empty()) {
    line.say(Severity::error, line.end_of({name}),
             is_sphere ? "found the end of the line, expected center (3 numbers), radius and material"
                       : "found the end of the line, expected two corners (6 numbers) and a material");
    return std::nullopt;
  }
  const Token material = tokens.back();
  tokens.pop_back();
  const std::size_t numbers = is_sphere ? 4 : 6;
  if (tokens.size() == numbers + 1 && is_material(tokens.back())) {
    line.error(material, "expected the end of the line after the material " + in_quotes(tokens.back().text));
    return std::nullopt;
  }
  const auto values = line.numbers(tokens, 0);
  if (!values) return material;
  is_sphere ? sphere(line, name, material, *values, made) : box(line, name, material, *values, made);
  return values->size() == numbers || is_material(material) ? std::optional(material) : std::nullopt;
}

}  // namespace

void read_shape(Line& line, const Token& keyword, Tokens& tokens) {
  if (tokens.empty()) {
    line.say(Severity::error, line.end_of({keyword}),
             "found the end of the line, expected sphere, box or composite");
    return;
  }
  const Token kind = tokens.front();
  const bool known = kind.text == "sphere" || kind.text == "box" || kind.text == "composite";
  if (!known) {
    unknown_shape(line, kind, tokens);
    return;
  }
  tokens.erase(tokens.begin());
  const auto name = line.take_name(kind, tokens, "shape");
  if (!name || !line.is_new(line.draft().shape_names, *name, line.draft().scene.shapes.size(), "shape"))
    return;
  Shape made;
  made.name = name->text;
  line.draft().shapes.push_back(line.place_of(*name));
  std::optional<Token> material;
  if (kind.text == "composite") {
    composite(line, *name, tokens);
    made.geometry = Composite{};
  } else {
    material = sphere_or_box(line, kind, *name, tokens, made);
  }
  line.draft().scene.shapes.push_back(std::move(made));
  if (material) {
    line.draft().use_material(line.draft().scene.shapes.size() - 1,
                              {material->text, line.place_of(*material)});
  }
}

}  // namespace plumb
