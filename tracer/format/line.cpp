#include "tracer/format/line.hpp"

#include <algorithm>
#include <cmath>

#include "tracer/text/numbers.hpp"
#include "tracer/text/words.hpp"

namespace plumb {

std::string count_of(std::size_t n, const char* one) {
  return std::to_string(n) + " " + one + (n == 1 ? "" : "s");
}

Place Line::end_of(const Tokens& tokens) const {
  return {number_, tokens.back().column + static_cast<int>(tokens.back().text.size())};
}

Finding& Line::say(Severity severity, Place place, std::string message, std::string remedy) {
  return draft_.say(severity, place, std::move(message), std::move(remedy));
}

void Line::error(const Token& token, const std::string& message, std::string remedy) {
  say(Severity::error, place_of(token), "found " + in_quotes(token.text) + ", " + message, std::move(remedy));
}

void Line::warning(const Token& token, std::string message) {
  say(Severity::warning, place_of(token), std::move(message));
}

void Line::loose(const Token& token, const std::string& expected) {
  if (!dialect_.loose) error(token, "expected " + expected + " (or --dialect loose)", "loose");
}

void Line::wrong_count(const Token& token, std::size_t found, const std::string& expected,
                       std::string remedy) {
  say(Severity::error, place_of(token), "found " + count_of(found, "number") + ", expected " + expected,
      std::move(remedy));
}

void Line::unknown_word(const Token& token, const std::string& expected,
                        const std::vector<std::string_view>& known) {
  std::string list;
  for (const std::string_view word : known) {
    if (!list.empty()) list += word == known.back() ? " or " : ", ";
    list += word;
  }
  const auto nearest = nearest_name(token.text, known);
  error(token, "expected " + expected + ": " + list +
                   (nearest ? "; did you mean " + in_quotes(*nearest) + "?" : ""));
}

void Line::not_negative(const Token& name, const Rgbd& colour, const char* what) {
  if (colour.x < 0 || colour.y < 0 || colour.z < 0)
    warning(name, std::string(what) + " of " + in_quotes(name.text) + " is negative: it takes light away");
}

void Line::not_to_255(const Token& name, const Rgbd& colour, const char* what) {
  constexpr double most = 10;  // because 1 is white, and nobody was seen to ask for more than 5
  const double largest = std::max({colour.x, colour.y, colour.z});
  if (largest > most)
    warning(name, std::string(what) + " of " + in_quotes(name.text) + " is " + to_text(largest) +
                      ", where 1 is white: if it counts to 255, divide by 255");
}

std::optional<std::vector<double>> Line::numbers(const Tokens& tokens, std::size_t first) {
  std::vector<double> values;
  for (std::size_t i = first; i < tokens.size(); ++i) {
    const Number number = parse_number(tokens[i].text);
    if (!number.complaint.empty()) {
      error(tokens[i], "expected a number; " + number.complaint);
      return std::nullopt;
    }
    if (std::abs(number.value) > largest_number) {
      error(tokens[i], "expected a number between -1e100 and 1e100: squares of larger ones overflow");
      return std::nullopt;
    }
    values.push_back(number.value);
  }
  return values;
}

std::optional<Token> Line::take_name(const Token& keyword, Tokens& tokens, const char* what) {
  if (tokens.empty()) {
    say(Severity::error, end_of({keyword}),
        std::string("found the end of the line, expected the name of a ") + what);
    return std::nullopt;
  }
  const Token name = tokens.front();
  tokens.erase(tokens.begin());
  return name;
}

bool Line::is_new(Names& names, const Token& name, std::size_t id, const char* what) {
  const auto earlier = names.define(name.text, id, number_);
  if (earlier) {
    error(name, std::string("expected a new name: a ") + what + " of that name is defined in line " +
                    std::to_string(*earlier) + "; rename one of them");
  }
  return !earlier;
}

}  // namespace plumb
