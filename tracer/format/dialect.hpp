// Named ways in which people deviate from the course grammar. Nothing is guessed: a file is read
// strictly unless a dialect is named.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace plumb {

/// Meaning of one number after ka, kd and ks of a material.
enum class MaterialField {
  shininess,     ///< m
  reflection,    ///< kr, grey
  opacity,       ///< 1 = solid: kt = 1 - x, grey
  transparency,  ///< 1 = clear: kt = x, grey
  ior,           ///< eta
  ignored,       ///< glossiness, roughness: not in the lecture
};

/// How successive `transform` lines T1, T2, ... of one object combine.
enum class TransformOrder {
  pre,   ///< M = T M (default: scale, rotate, translate gives T R S)
  post,  ///< M = M T
  trs,   ///< M = T R S whatever the order of the lines
};

/// Meaning of the nine numbers of a light.
enum class NineNumbers { refused, la_ld, brightness_rgb };

struct Dialect {
  std::vector<MaterialField> material{MaterialField::shininess};
  TransformOrder order = TransformOrder::pre;
  bool loose = false;             ///< spellings that cannot be misread
  bool light_color = false;       ///< a light of six numbers: position, colour
  bool la_ld_brightness = false;  ///< a light of ten: position, La, Ld, brightness
  NineNumbers nine = NineNumbers::refused;
};

/// Reads names joined by commas, e.g. "loose,refl-opacity-ior,post".
/// Throws std::invalid_argument naming the part that is unknown and what there is.
Dialect parse_dialect(std::string_view names);

/// Name and meaning of every part, for --help.
std::string describe_dialects();

/// Material layouts that people are known to use for so many numbers after m, the commonest first.
std::vector<std::string> known_material_layouts(std::size_t numbers_after_m);

}  // namespace plumb
