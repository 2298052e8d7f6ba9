#include "tracer/scene/reader.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "tracer/scene/draft.hpp"
#include "tracer/scene/lexer.hpp"

namespace plumb {
namespace {

std::string count_of(std::size_t n, const char* one) {
  return std::to_string(n) + " " + one + (n == 1 ? "" : "s");
}

class Reader {
 public:
  explicit Reader(const Dialect& dialect) : dialect_(dialect) {}

  ReadResult read(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    while (!text.empty() && !is_binary_) {
      const std::size_t end = text.find('\n');
      ++line_;
      read_line(text.substr(0, end));
      text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    }
    draft_.last_line = line_;
    if (!is_binary_ && !has_statements_) {
      say(Severity::error, {1, 1}, "found no statement, expected a scene; the file is empty");
    } else if (!is_binary_) {
      resolve(draft_, dialect_.order);
    }
    std::stable_sort(draft_.findings.begin(), draft_.findings.end(), [](const Finding& a, const Finding& b) {
      return std::pair(a.line, a.column) < std::pair(b.line, b.column);
    });
    return {std::move(draft_.scene), std::move(draft_.findings)};
  }

 private:
  using Tokens = std::vector<Token>;

  // --- what is said about the file ---------------------------------------------------------

  Finding& say(Severity severity, Place place, std::string message, std::string remedy = {}) {
    return draft_.say(severity, place, std::move(message), std::move(remedy));
  }
  Place place_of(const Token& token) const { return {line_, token.column}; }
  Place end_of(const Tokens& tokens) const {
    return {line_, tokens.back().column + static_cast<int>(tokens.back().text.size())};
  }
  void error(const Token& token, std::string message, std::string remedy = {}) {
    say(Severity::error, place_of(token), "found " + quoted(token.text) + ", " + message, std::move(remedy));
  }
  void warning(const Token& token, std::string message) {
    say(Severity::warning, place_of(token), std::move(message));
  }

  /// Accepts a spelling of the loose dialect, or reports it; the reading goes on in both cases.
  void loose(const Token& token, const std::string& expected) {
    if (!dialect_.loose) error(token, "expected " + expected + " (or --dialect loose)", "loose");
  }

  // --- numbers -----------------------------------------------------------------------------

  /// All tokens from `first` as numbers; nothing, with one error, if one of them is none.
  std::optional<std::vector<double>> numbers(const Tokens& tokens, std::size_t first) {
    std::vector<double> values;
    for (std::size_t i = first; i < tokens.size(); ++i) {
      const Number number = parse_number(tokens[i].text);
      if (!number.complaint.empty()) {
        error(tokens[i], "expected a number; " + number.complaint);
        return std::nullopt;
      }
      values.push_back(number.value);
    }
    return values;
  }

  static Vec3d vec3(const std::vector<double>& v, std::size_t at) { return {v[at], v[at + 1], v[at + 2]}; }

  /// Reports that a statement has another count of numbers than its grammar.
  void wrong_count(const Tokens& tokens, std::size_t found, const std::string& expected,
                   std::string remedy = {}) {
    say(Severity::error, place_of(tokens.front()),
        "found " + count_of(found, "number") + ", expected " + expected, std::move(remedy));
  }

  void not_negative(const Token& name, const Rgbd& colour, const char* what) {
    if (colour.x < 0 || colour.y < 0 || colour.z < 0) {
      warning(name, std::string(what) + " of " + quoted(name.text) + " is negative: it takes light away");
    }
  }

  // --- lines and statements ----------------------------------------------------------------

  void read_line(std::string_view line) {
    if (const std::size_t zero = line.find('\0'); zero != std::string_view::npos) {
      say(Severity::error, {line_, static_cast<int>(zero) + 1},
          "found a zero byte, expected text; this is a binary file, not a scene");
      is_binary_ = true;
      return;
    }
    Tokens tokens = tokenize(line);
    if (!tokens.empty() && tokens.back().text.starts_with("//")) {
      loose(tokens.back(), "'#' before a comment");
      tokens.pop_back();
    }
    if (tokens.empty()) return;
    has_statements_ = true;
    statement(tokens);
  }

  void statement(Tokens& tokens) {
    split_glued_define(tokens);
    const Token keyword = tokens.front();
    const std::string_view word = keyword.text;
    if (word == "define") return define(tokens);
    tokens.erase(tokens.begin());
    if (word == "ambient") return colour_statement(keyword, tokens, draft_.scene.ambient, ambient_line_);
    if (word == "background")
      return colour_statement(keyword, tokens, draft_.scene.background, background_line_);
    if (word == "camera") return camera(keyword, tokens);
    if (word == "transform") return transform(keyword, tokens);
    if (word == "render") return render(keyword, tokens);
    if (word == "renderer") {
      loose(keyword, "'render CAMERA FILE XRES YRES'");
      return dialect_.loose ? render(keyword, tokens) : void();
    }
    unknown_word(keyword, "a statement",
                 {"define", "ambient", "background", "camera", "transform", "render"});
  }

  /// `definematerial red ...`
  void split_glued_define(Tokens& tokens) {
    constexpr std::string_view define = "define";
    const Token first = tokens.front();
    if (!first.text.starts_with(define) || first.text.size() == define.size()) return;
    const std::string_view rest = first.text.substr(define.size());
    if (rest != "material" && rest != "shape" && rest != "light" && rest != "camera") return;
    loose(first, "a blank after 'define'");
    tokens.front().text = define;
    tokens.insert(tokens.begin() + 1, Token{rest, first.column + static_cast<int>(define.size())});
  }

  void unknown_word(const Token& token, const std::string& expected,
                    const std::vector<std::string_view>& known) {
    std::string list;
    for (const std::string_view word : known) {
      if (!list.empty()) list += word == known.back() ? " or " : ", ";
      list += word;
    }
    const auto nearest = nearest_name(token.text, known);
    error(token,
          "expected " + expected + ": " + list + (nearest ? "; did you mean '" + *nearest + "'?" : ""));
  }

  void define(Tokens& tokens) {
    const Token keyword = tokens.front();
    if (tokens.size() < 2) {
      say(Severity::error, end_of(tokens),
          "found the end of the line, expected material, shape, light or camera");
      return;
    }
    const Token kind = tokens[1];
    tokens.erase(tokens.begin(), tokens.begin() + 2);
    if (kind.text == "material") return material(kind, tokens);
    if (kind.text == "shape") return shape(kind, tokens);
    if (kind.text == "light") return light(kind, tokens);
    if (kind.text == "camera") return camera(kind, tokens);
    if (kind.text == "ambient" || kind.text == "amblight" || kind.text == "background" ||
        kind.text == "transform" || kind.text == "render") {
      const bool is_ambient = kind.text == "amblight" || kind.text == "ambient";
      loose(keyword, "'" + std::string(is_ambient ? "ambient" : kind.text) + "' without 'define'");
      if (is_ambient) return colour_statement(kind, tokens, draft_.scene.ambient, ambient_line_);
      if (kind.text == "background") {
        return colour_statement(kind, tokens, draft_.scene.background, background_line_);
      }
      return kind.text == "transform" ? transform(kind, tokens) : render(kind, tokens);
    }
    unknown_word(kind, "what to define", {"material", "shape", "light", "camera"});
  }

  /// Takes the name off the front of the tokens, or reports that it is missing.
  std::optional<Token> take_name(const Token& keyword, Tokens& tokens, const char* what) {
    if (tokens.empty()) {
      say(Severity::error, end_of({keyword}),
          std::string("found the end of the line, expected the name of a ") + what);
      return std::nullopt;
    }
    const Token name = tokens.front();
    tokens.erase(tokens.begin());
    return name;
  }

  bool is_new(Names& names, const Token& name, std::size_t id, const char* what) {
    const auto earlier = names.define(name.text, id, line_);
    if (earlier) {
      error(name, std::string("expected a new name: a ") + what + " of that name is defined in line " +
                      std::to_string(*earlier) + "; rename one of them");
    }
    return !earlier;
  }

  // --- material ----------------------------------------------------------------------------

  void material(const Token& keyword, Tokens& tokens) {
    const auto name = take_name(keyword, tokens, "material");
    if (!name || !is_new(draft_.material_names, *name, draft_.scene.materials.size(), "material")) return;
    draft_.materials.push_back(place_of(*name));
    Material made;
    made.name = name->text;
    const Tokens keywords = split_off_keywords(tokens);
    if (const auto values = numbers(tokens, 0)) material_numbers(*name, *values, made);
    material_keywords(keywords, made);
    not_negative(*name, made.ka, "ka");
    not_negative(*name, made.kd, "kd");
    not_negative(*name, made.ks, "ks");
    not_negative(*name, made.mirror, "mirror");
    not_negative(*name, made.transmit, "transmit");
    draft_.scene.materials.push_back(made);
  }

  static Tokens split_off_keywords(Tokens& tokens) {
    const auto first = std::find_if(tokens.begin(), tokens.end(), [](const Token& t) {
      return t.text == "mirror" || t.text == "transmit" || t.text == "eta";
    });
    Tokens keywords(first, tokens.end());
    tokens.erase(first, tokens.end());
    return keywords;
  }

  void material_numbers(const Token& name, const std::vector<double>& v, Material& made) {
    constexpr std::size_t colours = 9;
    const std::size_t expected = colours + dialect_.material.size();
    const auto m_at = static_cast<std::size_t>(
        std::find(dialect_.material.begin(), dialect_.material.end(), MaterialField::shininess) -
        dialect_.material.begin());
    if (v.size() < colours + 1) {
      return wrong_count({name}, v.size(), "10: ka kd ks (three numbers each) and m");
    }
    if (v.size() > expected) {
      wrong_count({name}, v.size(),
                  expected == colours + 1 ? "10: ka kd ks (three numbers each) and m; what follows m needs a "
                                            "name: mirror r g b, transmit r "
                                            "g b, eta x, or a --dialect that says what it means by position"
                                          : "at most " + std::to_string(expected) + " in this dialect");
      draft_.findings.back().extra_numbers = v.size() - colours - 1;
      return;
    }
    made.ka = vec3(v, 0);
    made.kd = vec3(v, 3);
    made.ks = vec3(v, 6);
    if (v.size() == colours + 1 || m_at == 0) {
      made.m = v[colours];  // a material without extra fields has m alone, wherever m stands otherwise
    }
    if (v.size() > colours + 1) {
      if (m_at >= v.size() - colours) return wrong_count({name}, v.size(), std::to_string(expected));
      for (std::size_t i = 0; colours + i < v.size(); ++i)
        field(name, dialect_.material[i], v[colours + i], made);
    }
    if (made.m < 0) error(name, "expected m >= 0 in this material");
  }

  void field(const Token& name, MaterialField meaning, double x, Material& made) {
    const double weight = std::clamp(x, 0.0, 1.0);
    switch (meaning) {
      case MaterialField::shininess:
        made.m = x;
        return;
      case MaterialField::reflection:
        made.mirror = Rgbd(x);
        return;
      case MaterialField::opacity:
      case MaterialField::transparency:
        if (weight != x) warning(name, "opacity of " + quoted(name.text) + " is outside 0..1: clamped");
        made.transmit = Rgbd(meaning == MaterialField::opacity ? 1 - weight : weight);
        return;
      case MaterialField::ior:
        made.eta = x;
        return;
      case MaterialField::ignored:
        return;
    }
  }

  void material_keywords(const Tokens& tokens, Material& made) {
    std::vector<std::string_view> seen;
    for (std::size_t at = 0; at < tokens.size();) {
      const Token& keyword = tokens[at];
      const bool is_eta = keyword.text == "eta";
      if (!is_eta && keyword.text != "mirror" && keyword.text != "transmit") {
        return unknown_word(keyword, "a keyword after m", {"mirror", "transmit", "eta"});
      }
      if (std::find(seen.begin(), seen.end(), keyword.text) != seen.end()) {
        return error(keyword, "expected it once in a material; remove one");
      }
      seen.push_back(keyword.text);
      const std::size_t count = is_eta ? 1 : 3;
      if (tokens.size() - at - 1 < count) {
        return error(keyword, "expected " + count_of(count, "number") + " after it");
      }
      const auto values = numbers(Tokens(tokens.begin() + static_cast<std::ptrdiff_t>(at) + 1,
                                         tokens.begin() + static_cast<std::ptrdiff_t>(at + 1 + count)),
                                  0);
      if (!values) return;
      if (is_eta) made.eta = (*values)[0];
      if (keyword.text == "mirror") made.mirror = vec3(*values, 0);
      if (keyword.text == "transmit") made.transmit = vec3(*values, 0);
      at += count + 1;
    }
  }

  // --- shapes ------------------------------------------------------------------------------

  void shape(const Token& keyword, Tokens& tokens) {
    if (tokens.empty()) {
      say(Severity::error, end_of({keyword}), "found the end of the line, expected sphere, box or composite");
      return;
    }
    const Token kind = tokens.front();
    const bool known = kind.text == "sphere" || kind.text == "box" || kind.text == "composite";
    if (!known) {
      unknown_shape(kind, tokens);
      return;
    }
    tokens.erase(tokens.begin());
    const auto name = take_name(kind, tokens, "shape");
    if (!name || !is_new(draft_.shape_names, *name, draft_.scene.shapes.size(), "shape")) return;
    Shape made;
    made.name = name->text;
    draft_.shapes.push_back({place_of(*name), {}, {}, {}});
    if (kind.text == "composite") {
      composite(*name, tokens);
      made.geometry = Composite{};
    } else if (!tokens.empty()) {
      draft_.shapes.back().material = Reference{tokens.back().text, place_of(tokens.back())};
      const Token material = tokens.back();
      tokens.pop_back();
      if (const auto values = numbers(tokens, 0)) {
        kind.text == "sphere" ? sphere(*name, material, *values, made) : box(*name, material, *values, made);
      }
    } else {
      say(Severity::error, end_of({*name}),
          kind.text == "sphere"
              ? "found the end of the line, expected center (3 numbers), radius and material"
              : "found the end of the line, expected two corners (6 numbers) and a material");
    }
    draft_.scene.shapes.push_back(std::move(made));
  }

  void unknown_shape(const Token& kind, const Tokens& tokens) {
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
    error(kind, "expected sphere, box or composite" + hint);
    // Known, though broken: whoever refers to it gets no second error.
    if (tokens.size() > 1) draft_.broken_shapes.push_back(tokens[1].text);
    draft_.broken_shapes.push_back(kind.text);
  }

  /// A material at the end is a name; a number there means that the name is missing.
  void shape_count(const Token& name, const Token& material, std::size_t found, std::size_t expected,
                   const char* what) {
    const bool missing = parse_number(material.text).complaint.empty();
    wrong_count({name}, found + (missing ? 1 : 0),
                std::string(what) + " and the name of a material" +
                    (missing && found + 1 == expected ? "; the material is missing at the end" : ""));
    if (missing) draft_.shapes.back().material.reset();
  }

  void sphere(const Token& name, const Token& material, const std::vector<double>& v, Shape& made) {
    if (v.size() != 4) return shape_count(name, material, v.size(), 4, "4: center x y z and radius");
    double radius = v[3];
    if (radius < 0 && dialect_.loose) {
      warning(name, "radius of " + quoted(name.text) + " is negative: its absolute value is used");
      radius = -radius;
    }
    if (!(radius > 0)) {
      say(Severity::error, place_of(name),
          "found radius " + std::to_string(radius) + " of " + quoted(name.text) + ", expected a radius > 0" +
              (radius < 0 ? "; remove the minus sign (or --dialect loose)"
                          : "; remove the sphere or enlarge it"),
          radius < 0 ? "loose" : "");
    }
    made.geometry = Sphere{vec3(v, 0), radius, 0};
  }

  void box(const Token& name, const Token& material, const std::vector<double>& v, Shape& made) {
    if (v.size() != 6) return shape_count(name, material, v.size(), 6, "6: two opposite corners x y z");
    made.geometry = Box{glm::min(vec3(v, 0), vec3(v, 3)), glm::max(vec3(v, 0), vec3(v, 3)), 0};
  }

  void composite(const Token& name, const Tokens& tokens) {
    if (tokens.empty()) {
      say(Severity::error, end_of({name}),
          "found the end of the line, expected the names of the composite's children");
    }
    for (const Token& child : tokens) draft_.shapes.back().children.push_back({child.text, place_of(child)});
  }

  // --- lights, ambient, background ---------------------------------------------------------

  void light(const Token& keyword, Tokens& tokens) {
    if (tokens.size() > 1 && (tokens[0].text == "ambient" || tokens[0].text == "diffuse") &&
        !parse_number(tokens[1].text).complaint.empty()) {
      return light_by_kind(tokens);
    }
    const auto name = take_name(keyword, tokens, "light");
    if (!name || !is_new(draft_.light_names, *name, draft_.scene.lights.size(), "light")) return;
    Light made;
    made.name = name->text;
    if (const auto values = numbers(tokens, 0)) light_numbers(*name, *values, made);
    not_negative(*name, made.intensity(), "intensity");
    draft_.scene.lights.push_back(made);
  }

  void light_numbers(const Token& name, const std::vector<double>& v, Light& made) {
    if (v.size() >= 6) {
      made.position = vec3(v, 0);
      made.color = vec3(v, 3);
    }
    if (v.size() == 7) {
      made.brightness = v[6];
    } else if (v.size() == 6 && dialect_.light_color) {
      made.brightness = 1;
    } else if (v.size() == 9 && dialect_.nine == NineNumbers::brightness_rgb) {
      made.color *= vec3(v, 6);
    } else if ((v.size() == 9 && dialect_.nine == NineNumbers::la_ld) ||
               (v.size() == 10 && dialect_.la_ld_brightness)) {
      if (v.size() == 10) made.brightness = v[9];
      draft_.ambient_of_lights += made.brightness * made.color;
      made.color = vec3(v, 6);
    } else {
      const bool known = v.size() == 6 || v.size() == 9 || v.size() == 10;
      const std::string remedy = v.size() == 6    ? "light-color"
                                 : v.size() == 9  ? "la-ld"
                                 : v.size() == 10 ? "la-ld-brightness"
                                                  : "";
      wrong_count(
          {name}, v.size(),
          "7: position x y z, color r g b, brightness" + (known ? " (or --dialect " + remedy + ")" : ""),
          remedy);
    }
  }

  /// `light ambient NAME r g b` and `light diffuse NAME x y z r g b`
  void light_by_kind(Tokens& tokens) {
    const bool is_ambient = tokens[0].text == "ambient";
    loose(tokens[0], is_ambient ? "'ambient r g b'" : "'light NAME position color brightness'");
    const Token name = tokens[1];
    const auto values = numbers(tokens, 2);
    if (!values) return;
    if (values->size() != (is_ambient ? 3U : 6U)) {
      return wrong_count({name}, values->size(), is_ambient ? "3: r g b" : "6: position x y z, color r g b");
    }
    if (is_ambient) {
      draft_.ambient_of_lights += vec3(*values, 0);
    } else if (is_new(draft_.light_names, name, draft_.scene.lights.size(), "light")) {
      draft_.scene.lights.push_back({std::string(name.text), vec3(*values, 0), vec3(*values, 3), 1});
    }
  }

  void colour_statement(const Token& keyword, const Tokens& tokens, Rgbd& colour, int& earlier_line) {
    const auto values = numbers(tokens, 0);
    if (!values) return;
    if (values->size() == 1) loose(keyword, "three numbers r g b, not a single grey one");
    if (values->size() != 1 && values->size() != 3) return wrong_count({keyword}, values->size(), "3: r g b");
    if (earlier_line != 0) {
      warning(keyword, "'" + std::string(keyword.text) + "' is given again; line " +
                           std::to_string(earlier_line) + " no longer counts");
    }
    earlier_line = line_;
    colour = values->size() == 1 ? Rgbd((*values)[0]) : vec3(*values, 0);
  }

  // --- camera ------------------------------------------------------------------------------

  void camera(const Token& keyword, Tokens& tokens) {
    const auto name = take_name(keyword, tokens, "camera");
    if (!name || !is_new(draft_.camera_names, *name, draft_.scene.cameras.size(), "camera")) return;
    Camera made;
    made.name = name->text;
    draft_.cameras.push_back({place_of(*name), {}});
    const auto values = numbers(tokens, 0);
    if (values) camera_numbers(*name, *values, made);
    draft_.scene.cameras.push_back(std::move(made));
  }

  void camera_numbers(const Token& name, const std::vector<double>& v, Camera& made) {
    const std::string grammar = "1 or 10: fov-x, then eye x y z, direction x y z, up x y z";
    if (v.empty()) return wrong_count({name}, 0, grammar);
    if (v.size() != 1 && v.size() != 10) {
      const bool known = v.size() == 3 || v.size() == 4 || v.size() > 10;
      if (!known) return wrong_count({name}, v.size(), grammar);
      if (!dialect_.loose) {
        return wrong_count({name}, v.size(), grammar + " (or --dialect loose)", "loose");
      }
    }
    made.fov_x_degrees = v[0];
    if (!(v[0] > 0 && v[0] < 180)) {
      error(name, "expected a camera with 0 < fov-x < 180 degrees, not " + std::to_string(v[0]));
    }
    if (v.size() == 3) {
      draft_.camera_resolution = {v[1], v[2], place_of(name)};
    } else if (v.size() >= 4) {
      made.eye = vec3(v, 1);
    }
    if (v.size() == 4) warning(name, "four numbers of a camera are read as fov-x and eye");
    if (v.size() > 10) warning(name, "what follows the camera's up vector is ignored");
    if (v.size() < 10) return;
    made.direction = vec3(v, 4);
    made.up = vec3(v, 7);
  }

  // --- transform ---------------------------------------------------------------------------

  void transform(const Token& keyword, Tokens& tokens) {
    const auto target = take_name(keyword, tokens, "shape or camera");
    if (!target) return;
    if (tokens.empty()) {
      say(Severity::error, end_of({*target}),
          "found the end of the line, expected translate, rotate or scale");
      return;
    }
    const Token kind = tokens.front();
    if (const auto step = transform_step(kind, tokens)) {
      draft_.transforms.push_back({{target->text, place_of(*target)}, *step});
    }
  }

  std::optional<TransformStep> transform_step(const Token& kind, const Tokens& tokens) {
    const bool about_axis = kind.text.size() == 7 && kind.text.starts_with("rotate");
    if (kind.text != "translate" && kind.text != "rotate" && kind.text != "scale" &&
        !(about_axis && std::string_view("xyzXYZ").find(kind.text.back()) != std::string_view::npos)) {
      unknown_word(kind, "a transformation", {"translate", "rotate", "scale"});
      return std::nullopt;
    }
    const auto values = numbers(tokens, 1);
    if (!values) return std::nullopt;
    const std::size_t n = values->size();
    if (kind.text == "translate") {
      if (n == 3) return Translate{vec3(*values, 0)};
      wrong_count({kind}, n, "3: x y z");
    } else if (kind.text == "scale") {
      if (n == 1 || n == 3) return scale_step(kind, n == 1 ? Vec3d((*values)[0]) : vec3(*values, 0));
      wrong_count({kind}, n, "1 or 3: s, or x y z");
    } else if (about_axis) {
      loose(kind, "rotate degrees x y z");
      Vec3d axis(0);
      axis[(kind.text.back() | 0x20) - 'x'] = 1;
      if (n == 1) return Rotate{(*values)[0], axis};
      wrong_count({kind}, n, "1: degrees");
    } else {
      if (n == 4) return rotate_step(kind, (*values)[0], vec3(*values, 1));
      wrong_count({kind}, n, "4: degrees and the axis x y z");
    }
    return std::nullopt;
  }

  std::optional<TransformStep> scale_step(const Token& kind, const Vec3d& by) {
    if (by.x != 0 && by.y != 0 && by.z != 0) return Scale{by};
    error(kind,
          "expected no factor of 0: it flattens the object so that it has no inverse; use a small factor");
    return std::nullopt;
  }

  std::optional<TransformStep> rotate_step(const Token& kind, double degrees, const Vec3d& axis) {
    if (axis != Vec3d(0) && std::isnormal(glm::dot(axis, axis))) return Rotate{degrees, axis};
    error(kind,
          "expected a rotation axis that has a direction, not " +
              std::string(axis == Vec3d(0) ? "0 0 0; give an axis such as 0 1 0, or remove the line"
                                           : "one as long or short as this; give an axis such as 0 1 0"));
    return std::nullopt;
  }

  // --- render ------------------------------------------------------------------------------

  void render(const Token& keyword, Tokens& tokens) {
    if (keyword.text == "render" && render_strict(tokens)) return;
    if (!dialect_.loose) return render_hint(keyword, tokens);
    render_loose(keyword, tokens);
  }

  static bool is_number(const Token& token) { return parse_number(token.text).complaint.empty(); }

  bool render_strict(const Tokens& tokens) {
    if (tokens.size() != 4 || !is_number(tokens[2]) || !is_number(tokens[3])) return false;
    if (is_number(tokens[1]) || tokens[1].text == ".") return false;
    return add_render(tokens[0], tokens[1].text, tokens[2], tokens[3]);
  }

  bool add_render(const Token& camera, std::string_view file, const Token& width, const Token& height) {
    const auto w = side(width);
    const auto h = side(height);
    if (!w || !h) return true;  // reported
    if (static_cast<double>(*w) * *h > largest_pixel_count) {
      error(width, "expected at most 268435456 pixels in all; choose a smaller size");
      return true;
    }
    draft_.renders.push_back(
        {{camera.text, place_of(camera)}, {std::string(camera.text), std::string(file), *w, *h}});
    return true;
  }

  std::optional<int> side(const Token& token) {
    const double value = parse_number(token.text).value;
    if (value >= 1 && value <= largest_side && value == std::floor(value)) return static_cast<int>(value);
    error(token, "expected a whole number of pixels from 1 to " + std::to_string(largest_side));
    return std::nullopt;
  }

  void render_hint(const Token& keyword, const Tokens& tokens) {
    const bool blank_in_name = std::any_of(
        tokens.begin(), tokens.end(), [](const Token& t) { return t.text.front() == '.' && !is_number(t); });
    if (blank_in_name && tokens.size() > 4) {
      return error(tokens.size() > 1 ? tokens[1] : keyword,
                   "expected a file name without blanks: write image.ppm (or --dialect loose)", "loose");
    }
    const bool readable = std::count_if(tokens.begin(), tokens.end(), is_number) != 1 && !tokens.empty();
    error(keyword,
          "expected 'render CAMERA FILE XRES YRES' with nothing else" +
              std::string(readable ? " (or --dialect loose)" : ""),
          readable ? "loose" : "");
  }

  /// Camera, file, size and number of samples in any order that cannot be misread.
  void render_loose(const Token& keyword, const Tokens& tokens) {
    std::vector<Token> words;
    std::vector<Token> sizes;
    std::string file;
    for (const Token& token : tokens) {
      if (is_number(token)) {
        sizes.push_back(token);
      } else if (token.text.front() == '.' && !token.text.starts_with("./") &&
                 !token.text.starts_with("../") && !words.empty()) {
        file = (file.empty() ? std::string(words.back().text) : file) + std::string(token.text);
      } else if (!file.empty() && file.back() == '.') {
        file += token.text;
      } else {
        words.push_back(token);
      }
    }
    if (words.size() > 2 || sizes.size() == 1 || sizes.size() > 3) {
      return error(keyword, "expected 'render CAMERA FILE XRES YRES'");
    }
    if (sizes.size() == 3) warning(sizes[2], "number of samples ignored: one sample a pixel is traced");
    Draft::RenderLine line;
    line.camera.place = place_of(keyword);
    for (const Token& word : words) {
      const bool names_file = word.text.find('.') != std::string_view::npos;
      if (!names_file) {
        line.camera = {word.text, place_of(word)};
      } else {
        line.request.file = word.text;
      }
    }
    if (!file.empty()) line.request.file = file;
    if (words.size() == 2 && !file.empty()) line.camera = {words[0].text, place_of(words[0])};
    if (words.size() == 1 && !file.empty()) line.camera = {{}, place_of(keyword)};
    if (sizes.size() >= 2) {
      const auto w = side(sizes[0]);
      const auto h = side(sizes[1]);
      if (!w || !h) return;
      line.request.width = *w;
      line.request.height = *h;
    } else {
      warning(keyword, "no size given: 480 x 320");
    }
    draft_.renders.push_back(std::move(line));
  }

  const Dialect& dialect_;
  Draft draft_;
  int line_ = 0;
  bool is_binary_ = false;
  bool has_statements_ = false;
  int ambient_line_ = 0;
  int background_line_ = 0;
};

}  // namespace

bool ReadResult::has_errors() const {
  return std::any_of(findings.begin(), findings.end(),
                     [](const Finding& f) { return f.severity == Severity::error; });
}

ReadResult read_scene(std::string_view text, const Dialect& dialect) { return Reader(dialect).read(text); }

std::string to_string(const Finding& finding, const std::string& file) {
  return file + ":" + std::to_string(finding.line) + ":" + std::to_string(finding.column) +
         (finding.severity == Severity::error ? ": error: " : ": warning: ") + finding.message;
}

}  // namespace plumb
