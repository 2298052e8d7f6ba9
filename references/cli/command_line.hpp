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

/// Takes a text that an option was given, once the whole command line is understood. Throws
/// std::invalid_argument, whose text begins with the option's name.
using Reader = std::function<void(const std::string& text)>;

/// One of a few words.
struct Choice {
  std::vector<std::string> words;
  std::function<void(std::size_t)> take;
  std::string usual{};  ///< the word of the default; empty when no word stands for it
};

/// What an option sets. A bool makes a flag, a vector an option that takes several values.
using Place = std::variant<bool*, int*, std::size_t*, double*, std::optional<double>*, std::string*,
                           std::vector<std::string>*, Reader, Choice>;

/// From the first to the second, both included. Help shows whole numbers as such.
using Range = std::variant<std::pair<int, int>, std::pair<double, double>>;
inline Range within(int from, int to) { return std::pair(from, to); }
inline Range within(double from, double to) { return std::pair(from, to); }

/// What an option may be, beside what its variable says.
struct Rules {
  std::string value{};  ///< as help shows it; empty: by the type
  bool is_required = false;
  bool shows_default = false;  ///< what the variable holds before
  std::string default_text{};  ///< as help shows it, of what is no variable
  std::optional<Range> range{};
  /// Returns what was found and expected instead of a text; nothing when the text is right.
  std::function<std::string(const std::string& text)> complaint{};
  std::vector<std::string> excludes{}, needs{};  ///< other options, which excludes or is needed by this one
  bool is_repeatable = false;                    ///< each value wants the option's name again
  bool may_be_alone = false;                     ///< takes any number of values, even none
  char separator = 0;                            ///< of several values in one word; 0: there is none
};

/// An option, an argument or a flag.
struct Option {
  std::string names;  ///< e.g. "-o,--output"; what has no dashes stands by its place
  Place place;
  std::string purpose;
  Rules rules{};
};

using Table = std::vector<Option>;

/// The options of all, in this order.
Table joined(std::initializer_list<Table> tables);
/// Each of them without the other.
Table excluding(const std::string& other, Table table);

template <class Value>
struct Word {
  const char* word;
  Value value;
};

/// Sets the variable to what stands beside the word; `words` is not copied.
template <class Variable, class Value, std::size_t count>
Choice one_of(Variable& variable, const Word<Value> (&words)[count]) {
  Choice choice{{}, [&variable, &words](std::size_t i) { variable = words[i].value; }};
  for (const Word<Value>& each : words) {
    choice.words.emplace_back(each.word);
    if (variable == each.value) choice.usual = each.word;
  }
  return choice;
}

/// The word that stands for the value.
template <class Value, std::size_t count>
std::string word_for(Value value, const Word<Value> (&words)[count]) {
  for (const Word<Value>& each : words)
    if (each.value == value) return each.word;
  return {};
}

struct Request;

struct Command {
  std::string name, purpose;
  std::string footer;  ///< of its help: an example, and what its exit codes mean
  Table options;
  std::function<int(const Request&)> run;  ///< returns the exit code: 0 agrees, 1 differs, 2 trouble
  bool is_hidden = false;                  ///< from help
  bool wants_an_option = false;            ///< exactly one
  bool reads_itself = false;               ///< calls Request::read(), where it can tell of trouble
};

struct Program {
  std::string purpose, version, footer;
  std::vector<Command> commands;
};

/// A command line that was understood.
struct Request {
  struct Given {
    std::string option;               ///< its long name, or that of its place
    std::vector<std::string> values;  ///< as they were given; empty when it was not
  };
  const Program* program = nullptr;
  const Command* command = nullptr;  ///< null when there is nothing to run
  int exit_code = exit_trouble;      ///< when there is nothing to run
  std::string program_name{};        ///< as it was called
  std::vector<Given> given{};        ///< in the order of the command's table

  bool has(const std::string& option) const;
  /// Lets the readers read their texts. Throws what they throw.
  void read() const;
  /// Reads, and runs the command.
  int run() const;
};

/// Sets the variables of the command that is asked for. Help goes to standard output; complaints go to
/// standard error, with the name that may have been meant.
Request understood(const Program& program, int argc, char** argv);

/// "-o" and "--output" of "-o,--output"; none of what stands by its place.
std::vector<std::string> dashed_names(const Option& option);
/// What help calls the value; empty for a flag.
std::string value_name(const Option& option);
/// As help shows it; empty where it shows none.
std::string default_text(const Option& option);

}  // namespace plumb::cli
