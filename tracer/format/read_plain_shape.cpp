// The commonest line of large scenes, read in one go: define shape sphere|box NAME NUMBERS MATERIAL
#include <charconv>
#include <cmath>

#include "tracer/format/statements.hpp"

namespace plumb {
namespace {

/// Reads from the front of the text, where blanks are single.
class Cursor {
 public:
  explicit Cursor(std::string_view text) : begin_(text.data()), at_(begin_), end_(begin_ + text.size()) {}

  std::size_t offset() const { return static_cast<std::size_t>(at_ - begin_); }
  bool is_at_end_of_line() const { return at_ == end_ || *at_ == '\n' || *at_ == '\r'; }

  bool skip(std::string_view word) {
    const bool stands_here = std::string_view(at_, end_).starts_with(word);
    if (stands_here) at_ += word.size();
    return stands_here;
  }

  /// Reads up to a blank or another control character. Returns an empty word where a comment begins or ends
  /// it.
  std::string_view word() {
    const char* const first = at_;
    while (at_ != end_ && static_cast<unsigned char>(*at_) > ' ' && *at_ != '#') ++at_;
    const std::string_view found(first, at_);
    return found.starts_with("//") || (at_ != end_ && *at_ == '#') ? std::string_view() : found;
  }

  /// Reads a number of the grammar, if it is beyond doubt, and the blank after it.
  bool number(double& value) {
    const auto [after, error] = std::from_chars(at_, end_, value);
    at_ = after;
    return error == std::errc() && std::abs(value) <= largest_number && skip(" ");
  }

 private:
  const char* begin_;
  const char* at_;
  const char* end_;
};

/// Reads a valid sphere or box, or returns false.
bool read_geometry(Cursor& cursor, bool is_sphere, Shape& made) {
  double v[6];
  for (int i = 0; i < (is_sphere ? 4 : 6); ++i) {
    if (!cursor.number(v[i])) return false;
  }
  const Vec3d a(v[0], v[1], v[2]);
  if (is_sphere) {
    made.geometry = Sphere{a, v[3], 0};
    return v[3] >= smallest_length;
  }
  const Vec3d b(v[3], v[4], v[5]);
  made.geometry = Box{glm::min(a, b), glm::max(b, a), 0};
  return true;
}

}  // namespace

std::size_t read_plain_shape(Draft& draft, std::string_view text, int line) {
  Cursor cursor(text);
  if (!cursor.skip("define shape ")) return 0;
  const bool is_sphere = cursor.skip("sphere ");
  if (!is_sphere && !cursor.skip("box ")) return 0;
  const auto name_column = static_cast<int>(cursor.offset()) + 1;
  const std::string_view name = cursor.word();
  const Names::Key key = draft.shape_names.key_of(name);
  Shape made;
  if (name.empty() || !cursor.skip(" ") || !read_geometry(cursor, is_sphere, made)) return 0;
  const auto material_column = static_cast<int>(cursor.offset()) + 1;
  const std::string_view material = cursor.word();
  if (material.empty() || !cursor.is_at_end_of_line()) return 0;
  const ShapeId id = draft.scene.shapes.size();
  if (draft.shape_names.define(key, id, line)) return 0;
  made.name = name;
  draft.shapes.push_back({line, name_column});
  draft.scene.shapes.push_back(std::move(made));
  draft.use_material(id, {material, {line, material_column}});
  return cursor.offset();
}

}  // namespace plumb
