// Named ways in which people deviate from the course grammar. Nothing is guessed: a file is read
// strictly unless a dialect is named.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace plumb {

/// The meaning of one number after ka, kd and ks of a material.
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

/// The meaning of a light's nine numbers.
enum class NineNumbers { refused, la_ld, brightness_rgb };

struct Dialect {
  std::vector<MaterialField> material{MaterialField::shininess};
  TransformOrder order = TransformOrder::pre;
  bool loose = false;             ///< accepts spellings that cannot be misread
  bool light_color = false;       ///< accepts a light of six numbers: position, colour
  bool la_ld_brightness = false;  ///< accepts a light of ten: position, La, Ld, brightness
  NineNumbers nine = NineNumbers::refused;
};

/// Reads names joined by commas, e.g. "loose,refl-opacity-ior,post". Throws std::invalid_argument naming the
/// unknown part and all known ones.
Dialect parse_dialect(std::string_view names);

/// Returns name and meaning of every part, one per line, for --help.
std::string describe_dialects();

/// Returns the material layouts that people are known to use for this number of values after m, commonest
/// first.
std::vector<std::string> known_material_layouts(std::size_t numbers_after_m);

}  // namespace plumb
