#include "references/submissions/varied_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <set>

#include "tracer/format/lexer.hpp"
#include "tracer/text/numbers.hpp"

namespace plumb::submissions {
namespace {

/// The share of a radius, because shadows and highlights then move by some pixels of a small picture, and
/// objects stay in view.
constexpr double of_a_radius = 0.2;
constexpr double of_an_edge = 0.06;
constexpr double of_a_light = 0.1;
constexpr double of_a_way = 0.04;
constexpr double of_a_size = 0.1;
constexpr double of_a_view = 0.03;
constexpr double of_a_colour = 0.2;

std::string text_of(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.5g", value);
  return text;
}

/// One line: its words, and what stands in their places.
class Words {
 public:
  explicit Words(std::string_view line) {
    std::vector<Token> tokens;
    tokenize(line, tokens);
    for (const Token& token : tokens) {
      if (!token.text.starts_with("//")) words_.emplace_back(token.text);
    }
  }

  std::size_t size() const { return words_.size(); }
  const std::string& operator[](std::size_t i) const { return words_[i]; }
  void set(std::size_t i, std::string word) { words_[i] = std::move(word); }
  void set(std::size_t i, double value) { words_[i] = text_of(value); }

  std::optional<double> number(std::size_t i) const {
    if (i >= words_.size()) return std::nullopt;
    const Number number = parse_number(words_[i]);
    return number.complaint.empty() ? std::optional(number.value) : std::nullopt;
  }
  std::optional<Vec3d> triple(std::size_t i) const {
    const auto x = number(i);
    const auto y = number(i + 1);
    const auto z = number(i + 2);
    return x && y && z ? std::optional(Vec3d(*x, *y, *z)) : std::nullopt;
  }
  void set(std::size_t i, const Vec3d& v) {
    for (int c = 0; c < 3; ++c) set(i + static_cast<std::size_t>(c), v[c]);
  }

  std::string joined() const {
    std::string line;
    for (const std::string& word : words_) line += (line.empty() ? "" : " ") + word;
    return line;
  }

 private:
  std::vector<std::string> words_;
};

using Names = std::map<std::string, std::string>;

/// Makes new names, no two of which are equal in a scene.
class NewNames {
 public:
  NewNames(const Variation& variation, std::size_t count)
      : variation_(variation), half_(500 + 4 * static_cast<double>(count)) {}

  void add(Names& names, const std::string& old, char initial) {
    std::string made;
    do {
      made = initial + std::to_string(static_cast<std::uint64_t>(half_ * (1 + variation_.random())));
    } while (!used_.insert(made).second);
    names[old] = made;
  }

 private:
  const Variation& variation_;
  double half_;  ///< of the numbers to choose from: several times as many as are needed
  std::set<std::string> used_;
};

class TextVariation {
 public:
  TextVariation(const Scene& scene, const Variation& variation) : variation_(variation) {
    NewNames names(variation,
                   scene.materials.size() + scene.lights.size() + scene.cameras.size() + scene.shapes.size());
    for (const Material& one : scene.materials) names.add(materials_, one.name, 'm');
    for (const Light& one : scene.lights) names.add(lights_, one.name, 'l');
    for (const Camera& one : scene.cameras) names.add(cameras_, one.name, 'c');
    for (const Shape& one : scene.shapes) {
      if (!is_composite(one)) names.add(shapes_, one.name, 's');
    }
  }

  std::string line(std::string_view line) {
    Words words(line);
    if (words.size() == 0) return {};
    std::size_t at = 1;
    std::string kind = words[0];
    if (kind == "define" && words.size() > 1)
      kind = words[at++];
    else if (kind.starts_with("define"))
      kind.erase(0, 6);
    statement(kind, words, at);
    return words.joined();
  }

 private:
  void statement(const std::string& kind, Words& words, std::size_t at) {
    if (kind == "material") return material(words, at);
    if (kind == "shape") return shape(words, at);
    if (kind == "light") return light(words, at);
    if (kind == "camera") return camera(words, at);
    if (kind == "transform") return transform(words, at);
    if (kind == "render" || kind == "renderer") return render(words, at);
    colour(words, at);  // ambient, background
  }

  static void rename(const Names& names, Words& words, std::size_t at) {
    if (at >= words.size()) return;
    if (const auto found = names.find(words[at]); found != names.end()) words.set(at, found->second);
  }

  double vary(double value, double share) const { return value * (1 + share * variation_.random()); }

  void colour(Words& words, std::size_t at) const {
    const auto old = words.triple(at);
    if (!old) return;
    Vec3d made(0);
    for (std::size_t c = 0; c < 3; ++c) {
      const double from = (*old)[static_cast<int>(variation_.order.at(c))];
      const double to = vary(from, variation_.colours * of_a_colour);
      made[static_cast<int>(c)] = from <= 1 ? std::min(to, 1.0) : to;
    }
    words.set(at, made);
  }

  /// Moves a position. What is 0 stays, because lying on an axis or standing upright may be what matters.
  void position(Words& words, std::size_t at, const Vec3d& reach) const {
    const auto old = words.triple(at);
    if (!old) return;
    for (int c = 0; c < 3; ++c) {
      const double by = reach[c] * variation_.places * variation_.random();
      if ((*old)[c] != 0) words.set(at + static_cast<std::size_t>(c), (*old)[c] + by);
    }
  }

  void material(Words& words, std::size_t at) const {
    rename(materials_, words, at);
    for (std::size_t i = 0; i < 3; ++i) colour(words, at + 1 + 3 * i);
    for (std::size_t i = at + 1; i < words.size(); ++i) {
      if (words[i] == "mirror" || words[i] == "transmit") colour(words, i + 1);
    }
  }

  void shape(Words& words, std::size_t at) const {
    if (at + 1 >= words.size()) return;
    const std::string kind = words[at];
    if (kind == "composite") {
      for (std::size_t i = at + 2; i < words.size(); ++i) rename(shapes_, words, i);
      return;
    }
    rename(shapes_, words, at + 1);
    rename(materials_, words, words.size() - 1);
    kind == "sphere" ? sphere(words, at + 2) : box(words, at + 2);
  }

  void sphere(Words& words, std::size_t at) const {
    const auto radius = words.number(at + 3);
    if (!radius) return;
    position(words, at, Vec3d(of_a_radius * std::abs(*radius)));
    words.set(at + 3, vary(*radius, variation_.places * of_a_size));
  }

  void box(Words& words, std::size_t at) const {
    const auto a = words.triple(at);
    const auto b = words.triple(at + 3);
    if (!a || !b) return;
    const Vec3d reach = of_an_edge * glm::abs(*b - *a);
    position(words, at, reach);
    position(words, at + 3, reach);
  }

  void light(Words& words, std::size_t at) const {
    const bool has_kind =
        at + 1 < words.size() && (words[at] == "ambient" || words[at] == "diffuse") && !words.number(at + 1);
    if (has_kind && words[at] == "ambient") return colour(words, at + 2);
    if (has_kind) ++at;
    rename(lights_, words, at);
    if (const auto old = words.triple(at + 1)) position(words, at + 1, Vec3d(of_a_light * glm::length(*old)));
    colour(words, at + 4);
    if (words.size() >= at + 10) colour(words, at + 7);  // La, then Ld
  }

  void camera(Words& words, std::size_t at) const {
    rename(cameras_, words, at);
    if (const auto fov = words.number(at + 1))
      words.set(at + 1, std::min(vary(*fov, variation_.places * of_a_view), 179.0));
  }

  void transform(Words& words, std::size_t at) const {
    const bool is_shape = at < words.size() && shapes_.contains(words[at]);
    rename(is_shape ? shapes_ : cameras_, words, at);
    if (at + 1 >= words.size() || words[at + 1] != "translate") return;
    if (const auto old = words.triple(at + 2)) position(words, at + 2, Vec3d(of_a_way * glm::length(*old)));
  }

  /// The camera comes first, except in loose spellings, where the file may.
  void render(Words& words, std::size_t at) const {
    const bool is_first = at < words.size() && cameras_.contains(words[at]);
    rename(cameras_, words, is_first ? at : at + 1);
  }

  const Variation& variation_;
  Names materials_, lights_, cameras_, shapes_;
};

}  // namespace

std::string varied_text(std::string_view text, const Scene& scene, const Variation& variation) {
  TextVariation vary(scene, variation);
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  std::string all;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    const std::string line = vary.line(text.substr(0, end));
    if (!line.empty()) all += line + "\n";
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return all;
}

}  // namespace plumb::submissions
