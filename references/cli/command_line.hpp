// The command line. A command is a table: its name and purpose, its options, each bound to a variable, and
// what it runs. The library that parses is known to command_line.cpp alone.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace plumb::cli {

inline constexpr int exit_agrees = 0;
inline constexpr int exit_differs = 1;
inline constexpr int exit_trouble = 2;
inline constexpr int exit_abstains = 3;  ///< of diagnose alone: nothing is certain

/// Takes a text that an option was given, once the whole command line is understood. Throws
/// std::invalid_argument, whose text begins with the option's name.
using Reader = std::function<void(const std::string& text)>;

/// One of a few words.
struct Choice {
  std::vector<std::string> words;
  std::function<void(std::size_t)> take;
  std::string usual{};  ///< the word of the default; empty when none stands for it
};

/// What an option sets. A bool makes a flag; a vector makes an option that takes several values.
using Place = std::variant<bool*, int*, std::size_t*, double*, std::optional<double>*, std::string*,
                           std::vector<std::string>*, Reader, Choice>;

/// The values from the first to the second, both included. Help shows an int without a decimal point.
using Range = std::variant<std::pair<int, int>, std::pair<double, double>>;
inline Range within(int from, int to) { return std::pair(from, to); }
inline Range within(double from, double to) { return std::pair(from, to); }

/// Limits an option further than the type of its variable does.
struct Rules {
  std::string value{};  ///< as help shows it; when empty, help names the type
  bool is_required = false;
  bool shows_default = false;  ///< help shows what the variable holds before
  std::string default_text{};  ///< as help shows it, for a place that is no variable
  std::optional<Range> range{};
  /// Returns what was found and expected instead of a text; nothing when the text is right.
  std::function<std::string(const std::string& text)> complaint{};
  std::vector<std::string> excludes{}, needs{};  ///< names of options that it must not, or must, go with
  bool is_repeatable = false;                    ///< the option's name stands before each value
  bool may_be_alone = false;                     ///< takes any number of values, even none
  char separator = 0;                            ///< stands between several values in one word; 0: none
};

/// An option, an argument or a flag.
struct Option {
  std::string names;  ///< e.g. "-o,--output"; without dashes it is an argument, known by its place
  Place place;
  std::string purpose;
  Rules rules{};
};

using Table = std::vector<Option>;

/// Returns the options of all tables, in this order.
Table joined(std::initializer_list<Table> tables);
/// Returns the table, in which no option may be given together with `other`.
Table excluding(const std::string& other, Table table);

template <class Value>
struct Word {
  const char* word;
  Value value;
};

/// Returns a choice that sets the variable to the value beside the word. Both arguments must outlive it.
template <class Variable, class Value, std::size_t count>
Choice one_of(Variable& variable, const Word<Value> (&words)[count]) {
  Choice choice{{}, [&variable, &words](std::size_t i) { variable = words[i].value; }};
  for (const Word<Value>& each : words) {
    choice.words.emplace_back(each.word);
    if (variable == each.value) choice.usual = each.word;
  }
  return choice;
}

/// Returns the word that stands for the value; empty when none does.
template <class Value, std::size_t count>
std::string word_for(Value value, const Word<Value> (&words)[count]) {
  for (const Word<Value>& each : words)
    if (each.value == value) return each.word;
  return {};
}

struct Request;

struct Command {
  std::string name, purpose;
  std::string footer;  ///< ends its help: an example, and what its exit codes mean
  Table options;
  std::function<int(const Request&)> run;  ///< returns the exit code: 0 agrees, 1 differs, 2 trouble
  bool is_hidden = false;                  ///< true if help does not list it
  bool wants_an_option = false;            ///< true if exactly one must be given
  bool reads_itself = false;  ///< true if it calls Request::read() itself, where it can report trouble
};

struct Program {
  std::string purpose, version, footer;
  std::vector<Command> commands;
};

/// A command line that was understood.
struct Request {
  struct Given {
    std::string option;               ///< its long name, or the argument's name
    std::vector<std::string> values;  ///< as they were given; empty when the option was not
  };
  const Program* program = nullptr;
  const Command* command = nullptr;  ///< null when there is nothing to run
  int exit_code = exit_trouble;      ///< when there is nothing to run
  std::string program_name{};        ///< as it was called
  std::vector<Given> given{};        ///< in the order of the command's table

  bool has(const std::string& option) const;
  /// Gives each Reader its texts. Throws what they throw.
  void read() const;
  /// Calls read(), unless the command does so itself, and runs the command. Returns its exit code.
  int run() const;
};

/// Parses the command line and sets the variables of the command that it asks for. Prints help to standard
/// output, and complaints to standard error, with the name that may have been meant.
Request understood(const Program& program, int argc, char** argv);

/// Returns "-o" and "--output" for "-o,--output"; nothing for an argument that is known by its place.
std::vector<std::string> dashed_names(const Option& option);
/// Returns what help calls the value; empty for a flag.
std::string value_name(const Option& option);
/// Returns the default as help shows it; empty where it shows none.
std::string default_text(const Option& option);

}  // namespace plumb::cli
