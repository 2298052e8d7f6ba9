#include "tracer/format/reader.hpp"

#include <algorithm>

#include "tracer/format/draft.hpp"
#include "tracer/format/lexer.hpp"
#include "tracer/format/statements.hpp"
#include "tracer/system/huge_pages.hpp"
#include "tracer/text/words.hpp"

namespace plumb {
namespace {

using Tokens = std::vector<Token>;

/// `definematerial red ...`
void split_glued_define(Line& line, Tokens& tokens) {
  constexpr std::string_view define = "define";
  const Token first = tokens.front();
  if (!first.text.starts_with(define) || first.text.size() == define.size()) return;
  const std::string_view rest = first.text.substr(define.size());
  if (rest != "material" && rest != "shape" && rest != "light" && rest != "camera") return;
  line.loose(first, "a blank after 'define'");
  tokens.front().text = define;
  tokens.insert(tokens.begin() + 1, Token{rest, first.column + static_cast<int>(define.size())});
}

std::size_t end_of_line(std::string_view text) {
  return static_cast<std::size_t>(
      std::find_if(text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }) - text.begin());
}

class Reader {
 public:
  explicit Reader(const Dialect& dialect) : dialect_(dialect) {}

  ReadResult read(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    make_room(text);
    while (!text.empty() && !is_binary_) {
      ++draft_.last_line;
      std::size_t end = read_plain_shape(draft_, text, draft_.last_line);
      if (end > 0) {
        has_statements_ = true;
      } else {
        end = end_of_line(text);
        read_line(text.substr(0, end));
      }
      text.remove_prefix(std::min(end + (text.substr(end).starts_with("\r\n") ? 2 : 1), text.size()));
    }
    if (!is_binary_ && !has_statements_) {
      draft_.say(Severity::error, {1, 1}, "found no statement, expected a scene; the file is empty");
    } else if (!is_binary_) {
      resolve(draft_, dialect_.order);
    }
    std::stable_sort(draft_.findings.begin(), draft_.findings.end(), [](const Finding& a, const Finding& b) {
      return std::pair(a.line, a.column) < std::pair(b.line, b.column);
    });
    return {std::move(draft_.scene), std::move(draft_.findings)};
  }

 private:
  /// Makes room for as many shapes as there can be, so that none is moved later. Memory that is not written
  /// to costs nothing.
  void make_room(std::string_view text) {
    constexpr std::size_t shortest_shape = std::string_view("define shape composite a b\n").size();
    const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
    const std::size_t shapes = std::min(lines, text.size() / shortest_shape + 1);
    draft_.scene.shapes.reserve(shapes);
    prefer_huge_pages(draft_.scene.shapes.data(), shapes * sizeof(Shape));
    draft_.shapes.reserve(shapes);
    draft_.shape_names.reserve(shapes);
  }

  void read_line(std::string_view text) {
    Line line(draft_, dialect_, draft_.last_line);
    if (const std::size_t zero = text.find('\0'); zero != std::string_view::npos) {
      line.say(Severity::error, {line.number(), static_cast<int>(zero) + 1},
               "found a zero byte, expected text; this is a binary file, not a scene");
      is_binary_ = true;
      return;
    }
    Tokens& tokens = tokens_;
    tokenize(text, tokens);
    if (!tokens.empty() && tokens.back().text.starts_with("//")) {
      line.loose(tokens.back(), "'#' before a comment");
      tokens.pop_back();
    }
    if (tokens.empty()) return;
    has_statements_ = true;
    split_glued_define(line, tokens);
    const Token keyword = tokens.front();
    tokens.erase(tokens.begin());
    keyword.text == "define" ? define(line, keyword, tokens) : statement(line, keyword, tokens);
  }

  void statement(Line& line, const Token& keyword, Tokens& tokens) {
    const std::string_view word = keyword.text;
    if (word == "ambient") return read_colour(line, keyword, tokens, draft_.scene.ambient, ambient_line_);
    if (word == "background")
      return read_colour(line, keyword, tokens, draft_.scene.background, background_line_);
    if (word == "camera") return read_camera(line, keyword, tokens);
    if (word == "transform") return read_transform(line, keyword, tokens);
    if (word == "render") return read_render(line, keyword, tokens);
    if (word == "renderer") {
      line.loose(keyword, "'render CAMERA FILE XRES YRES'");
      return dialect_.loose ? read_render(line, keyword, tokens) : void();
    }
    line.unknown_word(keyword, "a statement",
                      {"define", "ambient", "background", "camera", "transform", "render"});
  }

  void define(Line& line, const Token& keyword, Tokens& tokens) {
    const auto kind = line.take_name(keyword, tokens, "material, shape, light or camera");
    if (!kind) return;
    if (kind->text == "material") return read_material(line, *kind, tokens);
    if (kind->text == "shape") return read_shape(line, *kind, tokens);
    if (kind->text == "light") return read_light(line, *kind, tokens);
    if (kind->text == "camera") return read_camera(line, *kind, tokens);
    if (kind->text == "amblight") {
      line.loose(*kind, "'ambient r g b'");
      return read_colour(line, *kind, tokens, draft_.scene.ambient, ambient_line_);
    }
    if (kind->text == "ambient" || kind->text == "background" || kind->text == "transform" ||
        kind->text == "render") {
      line.loose(keyword, in_quotes(kind->text) + " without 'define'");
      return statement(line, *kind, tokens);
    }
    if (kind->text == "sphere" || kind->text == "box" || kind->text == "composite") {
      return line.error(*kind,
                        "expected what to define; write 'define shape " + std::string(kind->text) + "'");
    }
    line.unknown_word(*kind, "what to define", {"material", "shape", "light", "camera"});
  }

  const Dialect& dialect_;
  Draft draft_;
  Tokens tokens_;  ///< of the line that is read, kept for their memory
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
