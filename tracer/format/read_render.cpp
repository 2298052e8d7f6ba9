// Statement: render CAMERA FILE XRES YRES
#include <algorithm>
#include <cmath>
#include <optional>

#include "tracer/format/statements.hpp"
#include "tracer/text/numbers.hpp"

namespace plumb {
namespace {

using Tokens = std::vector<Token>;

bool is_number(const Token& token) { return parse_number(token.text).complaint.empty(); }

std::optional<int> read_side(Line& line, const Token& token) {
  const double value = parse_number(token.text).value;
  if (value >= 1 && value <= largest_side && value == std::floor(value)) return static_cast<int>(value);
  line.error(token, "expected a whole number of pixels from 1 to " + std::to_string(largest_side));
  return std::nullopt;
}

/// Sets the size, or reports what is wrong with it.
bool read_size(Line& line, const Token& width, const Token& height, RenderRequest& request) {
  const auto w = read_side(line, width);
  const auto h = read_side(line, height);
  if (!w || !h) return false;
  if (static_cast<double>(*w) * *h > largest_pixel_count) {
    line.error(width, "expected at most 268435456 pixels in all; choose a smaller size");
    return false;
  }
  request.width = *w;
  request.height = *h;
  return true;
}

bool is_strict(const Tokens& tokens) {
  const auto has_point = [&](std::size_t i) { return tokens[i].text.find('.') != std::string_view::npos; };
  if (tokens.size() == 4 && has_point(0) && !has_point(1)) return false;  // the file before the camera
  return tokens.size() == 4 && !is_number(tokens[1]) && tokens[1].text != "." && is_number(tokens[2]) &&
         is_number(tokens[3]);
}

/// `.ppm` or `.`, but not `./image.ppm`
bool continues_a_name(const Token& token) {
  return token.text.front() == '.' && !is_number(token) && !token.text.starts_with("./") &&
         !token.text.starts_with("../");
}

/// Reports what is not the course grammar, and the dialect that reads it, if one does.
void report(Line& line, const Token& keyword, const Tokens& tokens) {
  const auto blank = std::find_if(tokens.begin(), tokens.end(), continues_a_name);
  if (blank != tokens.end() && blank != tokens.begin()) {
    return line.error(*std::prev(blank),
                      "expected a file name without blanks: write image.ppm (or --dialect loose)", "loose");
  }
  const auto numbers = std::count_if(tokens.begin(), tokens.end(), is_number);
  const bool is_readable = !tokens.empty() && (numbers == 0 || numbers == 2 || numbers == 3);
  line.error(keyword,
             std::string("expected 'render CAMERA FILE XRES YRES' and nothing else") +
                 (is_readable ? " (or --dialect loose)" : ""),
             is_readable ? "loose" : "");
}

/// Words in their order, with `image . ppm` joined to one, and numbers in theirs.
struct Sorted {
  std::vector<std::string> words;
  std::vector<Token> places;  // of the words
  Tokens numbers;
};

Sorted sorted(const Tokens& tokens) {
  Sorted result;
  for (const Token& token : tokens) {
    const bool joins =
        !result.words.empty() && (continues_a_name(token) || result.words.back().back() == '.');
    if (is_number(token)) {
      result.numbers.push_back(token);
    } else if (joins) {
      result.words.back() += token.text;
    } else {
      result.words.emplace_back(token.text);
      result.places.push_back(token);
    }
  }
  return result;
}

/// Reads camera, file, size and number of samples in any order. Of two words the file is the one with a point
/// in it, or the second one.
void read_loose(Line& line, const Token& keyword, const Tokens& tokens) {
  const Sorted found = sorted(tokens);
  const std::size_t n = found.numbers.size();
  if (found.words.size() > 2 || n == 1 || n > 3) {
    return line.error(keyword, "expected 'render CAMERA FILE XRES YRES'");
  }
  Draft::RenderLine render;
  render.camera.place = line.place_of(keyword);
  const auto has_point = [&](std::size_t i) { return found.words[i].find('.') != std::string::npos; };
  const bool two = found.words.size() == 2;
  const bool file_is_first = !found.words.empty() && has_point(0) && !(two && has_point(1));
  for (std::size_t i = 0; i < found.words.size(); ++i) {
    const bool is_file = file_is_first ? i == 0 : i == 1;
    if (is_file) {
      render.request.file = found.words[i];
    } else {
      render.camera = {found.places[i].text, line.place_of(found.places[i])};
    }
  }
  render.has_size = n != 0;
  if (n == 3) line.warning(found.numbers[2], "number of samples ignored: one sample a pixel is traced");
  if (n >= 2 && !read_size(line, found.numbers[0], found.numbers[1], render.request)) return;
  line.draft().renders.push_back(std::move(render));
}

}  // namespace

void read_render(Line& line, const Token& keyword, Tokens& tokens) {
  line.draft().has_render_line = true;
  if (keyword.text != "render" || !is_strict(tokens)) {
    return line.dialect().loose ? read_loose(line, keyword, tokens) : report(line, keyword, tokens);
  }
  RenderRequest request;
  request.camera = tokens[0].text;
  request.file = tokens[1].text;
  if (!read_size(line, tokens[2], tokens[3], request)) return;
  line.draft().renders.push_back({{tokens[0].text, line.place_of(tokens[0])}, request});
}

}  // namespace plumb
