// The line that is being read. What it says goes into the draft, what is wrong with it into the findings.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tracer/format/dialect.hpp"
#include "tracer/format/draft.hpp"
#include "tracer/format/lexer.hpp"

namespace plumb {

class Line {
 public:
  using Tokens = std::vector<Token>;

  Line(Draft& draft, const Dialect& dialect, int number)
      : draft_(draft), dialect_(dialect), number_(number) {}

  Draft& draft() { return draft_; }
  const Dialect& dialect() const { return dialect_; }
  int number() const { return number_; }

  Place place_of(const Token& token) const { return {number_, token.column}; }
  Place end_of(const Tokens& tokens) const;

  Finding& say(Severity severity, Place place, std::string message, std::string remedy = {});
  /// Reports the error "found TOKEN, MESSAGE".
  void error(const Token& token, const std::string& message, std::string remedy = {});
  void warning(const Token& token, std::string message);
  /// Accepts a spelling of the loose dialect, or reports it. The caller reads on in both cases.
  void loose(const Token& token, const std::string& expected);
  /// Reports that a statement has not as many numbers as its grammar says.
  void wrong_count(const Token& token, std::size_t found, const std::string& expected,
                   std::string remedy = {});
  /// Reports a word that is none of the known ones, and names the nearest of them.
  void unknown_word(const Token& token, const std::string& expected,
                    const std::vector<std::string_view>& known);
  /// Warns of a colour with a negative channel.
  void not_negative(const Token& name, const Rgbd& colour, const char* what);
  /// Warns of a colour that seems to count to 255.
  void not_to_255(const Token& name, const Rgbd& colour, const char* what);

  /// Returns all tokens from `first` on as numbers. Reports the first that is none and then returns nothing.
  std::optional<std::vector<double>> numbers(const Tokens& tokens, std::size_t first);
  /// Takes the name off the front of the tokens, or reports that it is missing.
  std::optional<Token> take_name(const Token& keyword, Tokens& tokens, const char* what);
  /// Defines a name and returns true, or reports that it is taken.
  bool is_new(Names& names, const Token& name, std::size_t id, const char* what);

 private:
  Draft& draft_;
  const Dialect& dialect_;
  int number_;
};

inline constexpr double largest_number = 1e100;
inline constexpr double smallest_length = 1e-100;  ///< of a radius or a scale factor: squares underflow

/// Returns the three numbers from index `at` on.
inline Vec3d vec3(const std::vector<double>& v, std::size_t at) { return {v[at], v[at + 1], v[at + 2]}; }

/// Returns "1 number", "2 numbers" and so on.
std::string count_of(std::size_t n, const char* one);

}  // namespace plumb
