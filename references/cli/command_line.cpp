#include "references/cli/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <deque>
#include <sstream>

#include "tracer/text/words.hpp"

namespace plumb::cli {
namespace {

template <class... Visitors>
struct Visitor : Visitors... {
  using Visitors::operator()...;
};
template <class... Visitors>
Visitor(Visitors...) -> Visitor<Visitors...>;

void choose(const Option& option, const std::vector<std::string>& values) {
  const Choice* const choice = std::get_if<Choice>(&option.place);
  if (choice == nullptr || values.empty()) return;
  const auto at = std::find(choice->words.begin(), choice->words.end(), values.front());
  choice->take(static_cast<std::size_t>(at - choice->words.begin()));
}

/// Help as the library writes it, but for what an option excludes: it has that in the order of addresses,
/// here it stands in the order of the table.
class HelpInOrder : public CLI::Formatter {
 public:
  void know(CLI::Option* option) { order_.push_back(option); }

  std::string make_option_opts(const CLI::Option* option) const override {
    constexpr std::string_view label = " Excludes:";
    std::string text = Formatter::make_option_opts(option);
    const std::size_t at = text.find(label);
    if (at == std::string::npos) return text;
    text.resize(at + label.size());
    for (CLI::Option* const other : order_)
      if (option->get_excludes().count(other) > 0) text += " " + other->get_name();
    return text;
  }

 private:
  std::vector<CLI::Option*> order_;
};

/// A program as the library knows it, for one command line.
class Parser {
 public:
  explicit Parser(const Program& program) : program_(program), app_(program.purpose) {
    app_.formatter(help_);
    app_.set_version_flag("--version", program.version);
    app_.require_subcommand(0, 1);  // so that an unknown word is named
    app_.footer(program.footer);
    for (const Command& command : program.commands) add(command);
  }

  Request parse(int argc, char** argv) {
    Request request{&program_};
    try {
      app_.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      const int code = app_.exit(error);
      const std::string slip = code == 0 ? "" : likely_slip();
      if (!slip.empty()) std::fprintf(stderr, "%s\n", slip.c_str());
      request.exit_code = code == 0 ? exit_agrees : exit_trouble;
      return request;
    }
    request.program_name = app_.get_name();
    for (const Command& command : program_.commands)
      if (app_.got_subcommand(command.name)) give(command, request);
    if (request.command == nullptr) std::fputs(app_.help().c_str(), stderr);
    return request;
  }

 private:
  void add(const Command& command) {
    CLI::App& app = *app_.add_subcommand(command.name, command.purpose);
    app.footer(command.footer);
    if (command.is_hidden) app.group("");
    if (command.wants_an_option) app.require_option(1);
    std::vector<CLI::Option*> added;
    for (const Option& option : command.options) help_->know(added.emplace_back(add(app, option)));
    for (std::size_t i = 0; i < added.size(); ++i) {
      for (const std::string& other : command.options[i].rules.excludes)
        added[i]->excludes(app.get_option(other));
      for (const std::string& other : command.options[i].rules.needs) added[i]->needs(app.get_option(other));
    }
  }

  CLI::Option* add(CLI::App& app, const Option& option) {
    const Rules& rules = option.rules;
    CLI::Option* const added =
        std::visit([&](const auto& place) { return bound(app, option, place); }, option.place);
    if (!rules.value.empty()) added->type_name(rules.value);
    added->default_str(default_text(option));
    added->required(rules.is_required);
    if (rules.is_repeatable) added->allow_extra_args(false);
    if (rules.may_be_alone) added->expected(0, CLI::detail::expected_max_vector_size);
    if (rules.separator != 0) added->delimiter(rules.separator);
    if (rules.range)
      std::visit([&](const auto& range) { added->check(CLI::Range(range.first, range.second)); },
                 *rules.range);
    if (rules.complaint)
      added->check(CLI::Validator([check = rules.complaint](std::string& text) { return check(text); }, ""));
    return added;
  }

  CLI::Option* bound(CLI::App& app, const Option& option, bool* flag) {
    return app.add_flag(option.names, *flag, option.purpose);
  }
  template <class Value>
  CLI::Option* bound(CLI::App& app, const Option& option, Value* value) {
    return app.add_option(option.names, *value, option.purpose);
  }
  CLI::Option* bound(CLI::App& app, const Option& option, const Reader&) {
    if (option.rules.is_repeatable) return bound(app, option, &lists_.emplace_back());
    return bound(app, option, &texts_.emplace_back());
  }
  CLI::Option* bound(CLI::App& app, const Option& option, const Choice& choice) {
    return bound(app, option, &texts_.emplace_back())->check(CLI::IsMember(choice.words));
  }

  void give(const Command& command, Request& request) const {
    request.command = &command;
    const CLI::App& app = *app_.get_subcommand(command.name);
    for (const Option& option : command.options) {
      const CLI::Option& parsed = *app.get_option(option.names.substr(option.names.find(',') + 1));
      request.given.push_back({parsed.get_name(), parsed.results()});
      choose(option, parsed.results());
    }
  }

  /// Returns "did you mean --size?", for the first argument that was not expected; empty when nothing is
  /// near.
  std::string likely_slip() const {
    const std::vector<std::string> words = app_.remaining(true);
    const auto parsed = app_.get_subcommands();
    const auto option =
        std::find_if(words.begin(), words.end(), [](const auto& word) { return word.starts_with("--"); });
    std::vector<std::string> known;
    std::string word;
    if (option != words.end()) {
      word = option->substr(0, option->find('='));
      for (const CLI::Option* each : (parsed.empty() ? app_ : *parsed.front()).get_options())
        for (const std::string& name : each->get_lnames()) known.push_back("--" + name);
    } else if (!words.empty() && parsed.empty()) {
      word = words.front();
      for (const Command& command : program_.commands) known.push_back(command.name);
    }
    const auto near = nearest_name(word, {known.begin(), known.end()});
    return near ? "did you mean " + *near + "?" : "";
  }

  const Program& program_;
  const std::shared_ptr<HelpInOrder> help_ = std::make_shared<HelpInOrder>();
  CLI::App app_;
  std::deque<std::string> texts_;
  std::deque<std::vector<std::string>> lists_;
};

}  // namespace

Table joined(std::initializer_list<Table> tables) {
  Table all;
  for (const Table& table : tables) all.insert(all.end(), table.begin(), table.end());
  return all;
}

Table excluding(const std::string& other, Table table) {
  for (Option& option : table) option.rules.excludes.push_back(other);
  return table;
}

bool Request::has(const std::string& option) const {
  return std::any_of(given.begin(), given.end(),
                     [&](const Given& each) { return each.option == option && !each.values.empty(); });
}

void Request::read() const {
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (const Reader* const reader = std::get_if<Reader>(&command->options[i].place))
      for (const std::string& value : given[i].values) (*reader)(value);
  }
}

int Request::run() const {
  if (!command->reads_itself) read();
  return command->run(*this);
}

Request understood(const Program& program, int argc, char** argv) {
  return Parser(program).parse(argc, argv);
}

std::vector<std::string> dashed_names(const Option& option) {
  std::vector<std::string> names;
  std::istringstream list(option.names);
  for (std::string name; std::getline(list, name, ',');)
    if (name.starts_with("-")) names.push_back(name);
  return names;
}

std::string value_name(const Option& option) {
  if (dashed_names(option).empty()) return option.names;
  if (!option.rules.value.empty()) return option.rules.value;
  return std::visit(
      Visitor{[](bool*) { return ""; }, [](int*) { return "INT"; }, [](std::size_t*) { return "UINT"; },
              [](double*) { return "FLOAT"; }, [](std::optional<double>*) { return "FLOAT"; },
              [](const auto&) { return "TEXT"; }},
      option.place);
}

std::string default_text(const Option& option) {
  if (!option.rules.shows_default) return option.rules.default_text;
  std::ostringstream text;
  std::visit(Visitor{[&](const Choice& choice) { text << choice.usual; }, [&](int* value) { text << *value; },
                     [&](std::size_t* value) { text << *value; }, [&](double* value) { text << *value; },
                     [&](std::string* value) { text << *value; }, [](const auto&) {}},
             option.place);
  return text.str();
}

}  // namespace plumb::cli
