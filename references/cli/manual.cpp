// Man pages and completions, made from the tables of the commands. For whoever packages plumb: no help lists
// it.

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "references/cli/commands.hpp"
#include "tracer/system/files.hpp"

namespace plumb::cli {
namespace {

namespace fs = std::filesystem;

/// An option as a shell and a reader see it.
struct OptionWords {
  std::vector<std::string> names;    ///< with their dashes; empty for what stands by its place
  std::string value;                 ///< empty for a flag
  std::vector<std::string> choices;  ///< of the value, when there are few
  bool is_required = false, takes_several = false;
  std::string set_to;  ///< when it is not given; empty when that is said otherwise
  std::string description;
};

struct CommandWords {
  std::string name, purpose, footer;
  std::vector<OptionWords> options;
};

OptionWords words_of(const Option& option) {
  const Choice* const choice = std::get_if<Choice>(&option.place);
  return {dashed_names(option),
          value_name(option),
          choice == nullptr ? std::vector<std::string>() : choice->words,
          option.rules.is_required,
          std::holds_alternative<std::vector<std::string>*>(option.place) || option.rules.is_repeatable,
          default_text(option),
          option.purpose};
}

OptionWords flag_words(std::vector<std::string> names, std::string description) {
  return {std::move(names), "", {}, false, false, "", std::move(description)};
}

/// The parser adds it to every command.
OptionWords help() { return flag_words({"-h", "--help"}, "Print this help message and exit"); }

std::vector<CommandWords> commands_of(const Program& plumb) {
  std::vector<CommandWords> all;
  for (const Command& command : plumb.commands) {
    if (command.is_hidden) continue;
    all.push_back({command.name, command.purpose, command.footer, {help()}});
    for (const Option& option : command.options) all.back().options.push_back(words_of(option));
  }
  return all;
}

std::string with_each(std::string text, const std::map<char, std::string>& written) {
  std::string result;
  for (const char c : text) {
    const auto at = written.find(c);
    result += at == written.end() ? std::string(1, c) : at->second;
  }
  return result;
}

/// A line that begins with a dot or a quote would be a request.
std::string in_roff(const std::string& text) {
  const std::string line = with_each(text, {{'\\', "\\\\"}, {'-', "\\-"}, {'\n', "\n.br\n"}});
  return (line.starts_with(".") || line.starts_with("'") ? "\\&" : "") + line;
}

constexpr const char* environment =
    ".SH ENVIRONMENT\n.TP\n.B PLUMB_DATA\nshare/plumb of an installation, with scenes, images and chart; "
    "default: beside the "
    "program.\n.TP\n.B PLUMB_CACHE\nWhere pictures of POV\\-Ray are kept; default: ~/.cache/plumb.\n"
    ".TP\n.B PLUMB_REFERENCES\nA directory of reference images of your own.\n"
    ".SH FILES\nScenes that the examples call tests/scenes lie in share/plumb/scenes of an installation.\n";

/// As it stands in a synopsis.
std::string place_of(const OptionWords& option) {
  const std::string name = option.value + (option.takes_several ? "..." : "");
  return option.is_required ? name : "[" + name + "]";
}

std::string man_page(const std::string& name, const CommandWords& words,
                     const std::vector<CommandWords>& below) {
  std::string text = ".TH " + name + " 1 \"\" \"plumb " PLUMB_VERSION "\" \"User Commands\"\n";
  text += ".SH NAME\n" + in_roff(name + " - " + words.purpose) + "\n.SH SYNOPSIS\n.B " +
          in_roff(words.name.empty() ? "plumb" : "plumb " + words.name) + "\n[OPTIONS]";
  for (const OptionWords& option : words.options)
    if (option.names.empty()) text += " " + in_roff(place_of(option));
  text += below.empty() ? "\n" : " COMMAND\n.SH COMMANDS\n";
  for (const CommandWords& command : below)
    text += ".TP\n.B " + in_roff(command.name) + "\n" + in_roff(command.purpose) + " See plumb\\-" +
            command.name + "(1).\n";
  text += ".SH OPTIONS\n";
  for (const OptionWords& option : words.options) {
    std::string names;
    for (const std::string& each : option.names) names += (names.empty() ? "" : ", ") + each;
    text += ".TP\n.B " + in_roff(names + (names.empty() || option.value.empty() ? "" : " ") + option.value) +
            "\n" + in_roff(option.description) + "\n";
    if (!option.set_to.empty()) text += ".br\nDefault: " + in_roff(option.set_to) + ".\n";
    if (option.choices.empty()) continue;
    text += ".br\nOne of";
    for (const std::string& choice : option.choices) text += " " + in_roff(choice);
    text += ".\n";
  }
  return text + ".SH EXAMPLES AND EXIT CODES\n" + in_roff(words.footer) + "\n" + environment;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

std::vector<std::string> names_of(const CommandWords& words) {
  std::vector<std::string> all;
  for (const OptionWords& option : words.options)
    all.insert(all.end(), option.names.begin(), option.names.end());
  return all;
}

std::string names_of(const std::vector<CommandWords>& commands) {
  std::vector<std::string> all;
  for (const CommandWords& command : commands) all.push_back(command.name);
  return joined(all);
}

std::string bash(const CommandWords& plumb, const std::vector<CommandWords>& commands) {
  std::string text =
      "# Completion of plumb for bash; made by plumb manual.\n_plumb() {\n  local "
      "word=${COMP_WORDS[COMP_CWORD]} "
      "before=${COMP_WORDS[COMP_CWORD-1]} offered=\n  if [ \"$COMP_CWORD\" -eq 1 ]; then\n    offered='" +
      names_of(commands) + " " + joined(names_of(plumb)) +
      "'\n  else\n    case ${COMP_WORDS[1]}:$before in\n";
  for (const CommandWords& command : commands)
    for (const OptionWords& option : command.options)
      for (const std::string& name : option.names)
        if (!option.choices.empty())
          text += "      " + command.name + ":" + name + ") offered='" + joined(option.choices) + "' ;;\n";
  text += "    esac\n    [ -n \"$offered\" ] || case ${COMP_WORDS[1]}:$word in\n";
  for (const CommandWords& command : commands)
    text += "      " + command.name + ":-*) offered='" + joined(names_of(command)) + "' ;;\n";
  return text +
         "    esac\n  fi\n  mapfile -t COMPREPLY < <(compgen -W \"$offered\" -- \"$word\")\n}\n"
         "complete -o bashdefault -o default -F _plumb plumb\n";
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

std::string in_quotes_of_zsh(const std::string& text) {
  return with_each(first_line(text),
                   {{'\'', "'\\''"}, {'[', "\\["}, {']', "\\]"}, {':', "\\:"}, {'\n', " "}});
}

std::string zsh_option(const OptionWords& option) {
  if (option.names.empty())
    return std::string("      '") + (option.takes_several ? "*:" : ":") + in_quotes_of_zsh(option.value) +
           ":_files' \\\n";
  std::string text;
  for (const std::string& name : option.names) {
    text += "      '*" + name + "[" + in_quotes_of_zsh(option.description) + "]";
    if (!option.choices.empty())
      text += ":" + in_quotes_of_zsh(option.value) + ":(" + joined(option.choices) + ")";
    else if (!option.value.empty())
      text += ":" + in_quotes_of_zsh(option.value) + ":_files";
    text += "' \\\n";
  }
  return text;
}

std::string zsh(const std::vector<CommandWords>& commands) {
  std::string text =
      "#compdef plumb\n# Completion of plumb for zsh; made by plumb manual.\n_plumb() {\n  local -a "
      "commands=(\n";
  for (const CommandWords& command : commands)
    text += "    '" + command.name + ":" + in_quotes_of_zsh(command.purpose) + "'\n";
  text +=
      "  )\n  if (( CURRENT == 2 )); then\n    _describe command commands\n    return\n  fi\n"
      "  local chosen=$words[2]\n  shift words\n  (( CURRENT-- ))\n  case $chosen in\n";
  for (const CommandWords& command : commands) {
    text += "  " + command.name + ")\n    _arguments \\\n";
    for (const OptionWords& option : command.options) text += zsh_option(option);
    text += "      && return ;;\n";
  }
  return text + "  esac\n}\n_plumb \"$@\"\n";
}

std::string in_quotes_of_fish(const std::string& text) {
  return "'" + with_each(first_line(text), {{'\'', "\\'"}, {'\\', "\\\\"}, {'\n', " "}}) + "'";
}

std::string fish(const std::vector<CommandWords>& commands) {
  std::string text = "# Completion of plumb for fish; made by plumb manual.\n";
  for (const CommandWords& command : commands) {
    text += "complete -c plumb -n __fish_use_subcommand -f -a " + command.name + " -d " +
            in_quotes_of_fish(command.purpose) + "\n";
    for (const OptionWords& option : command.options) {
      if (option.names.empty()) continue;
      text += "complete -c plumb -n '__fish_seen_subcommand_from " + command.name + "'";
      for (const std::string& name : option.names)
        text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      if (!option.value.empty()) text += " -r";
      if (!option.choices.empty()) text += " -f -a " + in_quotes_of_fish(joined(option.choices));
      text += " -d " + in_quotes_of_fish(option.description) + "\n";
    }
  }
  return text;
}

int write_all(const Program& plumb, const std::string& directory) {
  const std::vector<CommandWords> commands = commands_of(plumb);
  const CommandWords itself{
      "",
      "tell whether a ray tracer is right, and if not, which formula is wrong",
      plumb.footer,
      {help(), flag_words({"--version"}, "Display program version information and exit")}};
  fs::create_directories(directory + "/man1");
  fs::create_directories(directory + "/completions");
  write_file(directory + "/man1/plumb.1", man_page("plumb", itself, commands));
  for (const CommandWords& command : commands)
    write_file(directory + "/man1/plumb-" + command.name + ".1",
               man_page("plumb-" + command.name, command, {}));
  write_file(directory + "/completions/plumb.bash", bash(itself, commands));
  write_file(directory + "/completions/_plumb", zsh(commands));
  write_file(directory + "/completions/plumb.fish", fish(commands));
  return exit_agrees;
}

}  // namespace

/// Writes man1/plumb*.1, completions/plumb.bash, completions/_plumb (zsh) and completions/plumb.fish.
Command manual_command() {
  auto directory = std::make_shared<std::string>();
  return {.name = "manual",
          .purpose = "Write man pages and completions to a directory.",
          .footer = "Example: plumb manual build/manual\nExit codes: 0 written, 2 trouble.",
          .options = {{"directory",
                       directory.get(),
                       "where they are written",
                       {.value = "DIR", .is_required = true}}},
          .run = [directory](const Request& request) { return write_all(*request.program, *directory); },
          .is_hidden = true};
}

}  // namespace plumb::cli
