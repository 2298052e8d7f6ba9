#include "tracer/format/dialect.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>

namespace plumb {
namespace {

struct FieldName {
  std::string_view name;
  MaterialField field;
};

constexpr std::array<FieldName, 8> field_names{{{"m", MaterialField::shininess},
                                                {"refl", MaterialField::reflection},
                                                {"opacity", MaterialField::opacity},
                                                {"transparency", MaterialField::transparency},
                                                {"ior", MaterialField::ior},
                                                {"gloss", MaterialField::ignored},
                                                {"rough", MaterialField::ignored},
                                                {"skip", MaterialField::ignored}}};

struct Part {
  std::string_view name;
  std::string_view meaning;
  void (*apply)(Dialect&);
};

constexpr std::array<Part, 9> parts_of_dialect{{
    {"strict", "the course grammar (the default)", [](Dialect&) {}},
    {"loose",
     "spellings that cannot be misread: // comments, 'define ambient|background|transform|render', "
     "'amblight', one "
     "number for a grey, 'rotateX a', 'light ambient|diffuse NAME', a resolution after the camera, other "
     "orders in "
     "'render', 'image . ppm', a missing blank after 'define', a negative radius",
     [](Dialect& d) { d.loose = true; }},
    {"pre", "successive transforms pre-multiply, M = T M (the default)",
     [](Dialect& d) { d.order = TransformOrder::pre; }},
    {"post", "successive transforms post-multiply, M = M T",
     [](Dialect& d) { d.order = TransformOrder::post; }},
    {"trs", "M = T R S whatever the order of the lines", [](Dialect& d) { d.order = TransformOrder::trs; }},
    {"la-ld", "a light of nine numbers is position, La, Ld; ambient = sum of La (sheet of 2015)",
     [](Dialect& d) { d.nine = NineNumbers::la_ld; }},
    {"la-ld-brightness",
     "a light of ten numbers is position, La, Ld, brightness; ambient = sum of brightness La",
     [](Dialect& d) { d.la_ld_brightness = true; }},
    {"light-color", "a light of six numbers is position, colour; brightness 1",
     [](Dialect& d) { d.light_color = true; }},
    {"brightness-rgb", "a light of nine numbers is position, colour, brightness per channel",
     [](Dialect& d) { d.nine = NineNumbers::brightness_rgb; }},
}};

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> pieces;
  for (;;) {
    const std::size_t end = text.find(separator);
    pieces.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return pieces;
    text.remove_prefix(end + 1);
  }
}

/// A layout such as refl-opacity-ior; m stands first unless it is named.
std::optional<std::vector<MaterialField>> parse_material_layout(std::string_view text) {
  std::vector<MaterialField> fields;
  for (const std::string_view piece : split(text, '-')) {
    const auto* known = std::find_if(field_names.begin(), field_names.end(),
                                     [&](const FieldName& f) { return f.name == piece; });
    if (known == field_names.end()) return std::nullopt;
    const bool repeated = known->field != MaterialField::ignored &&
                          std::find(fields.begin(), fields.end(), known->field) != fields.end();
    if (repeated) return std::nullopt;
    fields.push_back(known->field);
  }
  if (std::find(fields.begin(), fields.end(), MaterialField::shininess) == fields.end()) {
    fields.insert(fields.begin(), MaterialField::shininess);
  }
  return fields;
}

}  // namespace

Dialect parse_dialect(std::string_view names) {
  Dialect dialect;
  for (const std::string_view name : split(names, ',')) {
    const auto* part = std::find_if(parts_of_dialect.begin(), parts_of_dialect.end(),
                                    [&](const Part& p) { return p.name == name; });
    if (part != parts_of_dialect.end()) {
      part->apply(dialect);
    } else if (const auto layout = parse_material_layout(name)) {
      dialect.material = *layout;
    } else {
      throw std::invalid_argument("unknown dialect '" + std::string(name) + "'; known are\n" +
                                  describe_dialects());
    }
  }
  return dialect;
}

std::string describe_dialects() {
  std::string text;
  for (const Part& part : parts_of_dialect) {
    std::string line = "  " + std::string(part.name);
    line.resize(std::max<std::size_t>(line.size(), 20), ' ');
    text += line + " " + std::string(part.meaning) + "\n";
  }
  return text +
         "  FIELD-FIELD-...     what follows m in a material, by position, of refl, opacity (1 = solid),\n"
         "                      transparency (1 = clear), ior, gloss, rough, skip; with m when m is not\n"
         "                      first. E.g. refl-opacity-ior, ior-transparency, transparency-ior-m\n"
         "Join several by commas: --dialect loose,refl-opacity-ior,post\n";
}

std::vector<std::string> known_material_layouts(std::size_t numbers_after_m) {
  switch (numbers_after_m) {
    case 1:
      return {"refl", "opacity", "transparency", "gloss", "ior"};
    case 2:
      return {"refl-opacity", "refl-transparency", "ior-opacity",        "ior-transparency",
              "opacity-ior",  "transparency-ior",  "transparency-ior-m", "opacity-ior-m"};
    case 3:
      return {"refl-opacity-ior",  "refl-transparency-ior",  "refl-ior-opacity",  "refl-ior-transparency",
              "gloss-opacity-ior", "gloss-transparency-ior", "ior-opacity-gloss", "ior-transparency-gloss"};
    case 4:
      return {"opacity-refl-ior-rough", "transparency-refl-ior-rough"};
    default:
      return {};
  }
}

}  // namespace plumb
