// Statement: define material NAME ka kd ks m [what follows]
#include <algorithm>
#include <cmath>
#include <optional>

#include "tracer/format/statements.hpp"
#include "tracer/text/numbers.hpp"
#include "tracer/text/words.hpp"

namespace plumb {
namespace {

using Tokens = std::vector<Token>;

void material_keywords(Line& line, const Tokens& tokens, Material& made) {
  std::vector<std::string_view> seen;
  for (std::size_t at = 0; at < tokens.size();) {
    const Token& keyword = tokens[at];
    const bool is_eta = keyword.text == "eta";
    if (!is_eta && keyword.text != "mirror" && keyword.text != "transmit") {
      return line.unknown_word(keyword, "a keyword after m", {"mirror", "transmit", "eta"});
    }
    if (std::find(seen.begin(), seen.end(), keyword.text) != seen.end()) {
      return line.error(keyword, "expected it once in a material; remove one");
    }
    seen.push_back(keyword.text);
    const std::size_t count = is_eta ? 1 : 3;
    if (tokens.size() - at - 1 < count) {
      return line.error(keyword, "expected " + count_of(count, "number") + " after it");
    }
    const auto values = line.numbers(Tokens(tokens.begin() + static_cast<std::ptrdiff_t>(at) + 1,
                                            tokens.begin() + static_cast<std::ptrdiff_t>(at + 1 + count)),
                                     0);
    if (!values) return;
    if (is_eta) made.eta = (*values)[0];
    if (keyword.text == "mirror") made.mirror = vec3(*values, 0);
    if (keyword.text == "transmit") made.transmit = vec3(*values, 0);
    at += count + 1;
  }
}

void field(Line& line, const Token& name, MaterialField meaning, double x, Material& made) {
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
      if (weight != x) line.warning(name, "opacity of " + in_quotes(name.text) + " is outside 0..1: clamped");
      made.transmit = Rgbd(meaning == MaterialField::opacity ? 1 - weight : weight);
      return;
    case MaterialField::ior:
      made.eta = x;
      return;
    case MaterialField::ignored:
      return;
  }
}

void material_numbers(Line& line, const Token& name, const std::vector<double>& v, Material& made) {
  constexpr std::size_t colours = 9;
  const std::size_t expected = colours + line.dialect().material.size();
  const auto m_at = static_cast<std::size_t>(
      std::find(line.dialect().material.begin(), line.dialect().material.end(), MaterialField::shininess) -
      line.dialect().material.begin());
  if (v.size() < colours + 1) {
    return line.wrong_count(name, v.size(), "10: ka kd ks (three numbers each) and m");
  }
  if (v.size() > expected) {
    line.wrong_count(name, v.size(),
                     expected == colours + 1
                         ? "10: ka kd ks (three numbers each) and m; what follows m needs a "
                           "name: mirror r g b, transmit r "
                           "g b, eta x, or a --dialect that says what it means by position"
                         : "at most " + std::to_string(expected) + " in this dialect");
    line.draft().findings.back().extra_numbers = v.size() - colours - 1;
    return;
  }
  made.ka = vec3(v, 0);
  made.kd = vec3(v, 3);
  made.ks = vec3(v, 6);
  if (v.size() == colours + 1 || m_at == 0) {
    made.m = v[colours];  // a material without extra fields has m alone, wherever m stands otherwise
  }
  if (v.size() > colours + 1 && v.size() < expected) {
    line.warning(name, "material " + in_quotes(name.text) + " gives only " +
                           count_of(v.size() - colours - 1, "number") +
                           " after m: the rest take their defaults");
  }
  if (v.size() > colours + 1) {
    if (m_at >= v.size() - colours) return line.wrong_count(name, v.size(), std::to_string(expected));
    for (std::size_t i = 0; colours + i < v.size(); ++i)
      field(line, name, line.dialect().material[i], v[colours + i], made);
  }
  if (made.m < 0) {
    line.say(Severity::error, line.place_of(name),
             "found m = " + to_text(made.m) + " in material " + in_quotes(name.text) + ", expected m >= 0");
  }
}

Tokens split_off_keywords(Tokens& tokens) {
  const auto first = std::find_if(tokens.begin(), tokens.end(), [](const Token& t) {
    return t.text == "mirror" || t.text == "transmit" || t.text == "eta";
  });
  Tokens keywords(first, tokens.end());
  tokens.erase(first, tokens.end());
  return keywords;
}

}  // namespace

void read_material(Line& line, const Token& keyword, Tokens& tokens) {
  const auto name = line.take_name(keyword, tokens, "material");
  if (!name ||
      !line.is_new(line.draft().material_names, *name, line.draft().scene.materials.size(), "material"))
    return;
  line.draft().materials.push_back(line.place_of(*name));
  Material made;
  made.name = name->text;
  const Tokens keywords = split_off_keywords(tokens);
  if (const auto values = line.numbers(tokens, 0)) material_numbers(line, *name, *values, made);
  material_keywords(line, keywords, made);
  const std::pair<const char*, Rgbd> colours[] = {{"ka", made.ka},
                                                  {"kd", made.kd},
                                                  {"ks", made.ks},
                                                  {"mirror", made.mirror},
                                                  {"transmit", made.transmit}};
  for (const auto& [what, colour] : colours) {
    line.not_negative(*name, colour, what);
    line.not_to_255(*name, colour, what);
  }
  const bool names_eta =
      std::any_of(keywords.begin(), keywords.end(), [](const Token& t) { return t.text == "eta"; });
  if (names_eta && !made.transmits())
    line.warning(*name, "eta of " + in_quotes(name->text) +
                            " has no effect: it transmits nothing; add transmit r g b");
  line.draft().scene.materials.push_back(made);
}

}  // namespace plumb
