#include "references/cli/manual.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <sstream>

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

/// What stands between the braces of a type like TEXT:{full,none}.
std::vector<std::string> choices_in(const std::string& type) {
  const std::size_t open = type.find(":{"), close = type.find('}', open);
  std::vector<std::string> all;
  if (open == std::string::npos || close == std::string::npos) return all;
  std::istringstream list(type.substr(open + 2, close - open - 2));
  for (std::string word; std::getline(list, word, ',');) all.push_back(word);
  return all;
}

OptionWords words_of(const CLI::Option& option) {
  OptionWords words;
  for (const std::string& name : option.get_snames()) words.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) words.names.push_back("--" + name);
  const std::string type = option.get_type_name();
  if (option.get_positional())
    words.value = option.get_name();
  else if (option.get_items_expected_max() > 0)
    words.value = type.substr(0, type.find(':'));
  words.choices = choices_in(type);
  words.is_required = option.get_required();
  words.takes_several = option.get_items_expected_max() > 1;
  words.set_to = option.get_default_str();
  words.description = option.get_description();
  return words;
}

CommandWords words_of(const CLI::App& app) {
  CommandWords words{app.get_name(), app.get_description(), app.get_footer(), {}};
  for (const CLI::Option* option : app.get_options()) words.options.push_back(words_of(*option));
  return words;
}

std::vector<CommandWords> commands_of(const CLI::App& plumb) {
  std::vector<CommandWords> all;
  for (const CLI::App* app : plumb.get_subcommands({}))
    if (!app->get_group().empty()) all.push_back(words_of(*app));
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

int write_all(const CLI::App& plumb, const std::string& directory) {
  const std::vector<CommandWords> commands = commands_of(plumb);
  CommandWords itself = words_of(plumb);
  itself.name.clear();  // the library has the path of the program there
  itself.purpose = "tell whether a ray tracer is right, and if not, which formula is wrong";
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

Command add_manual(CLI::App& plumb) {
  CLI::App* app =
      plumb.add_subcommand("manual", "Write man pages and completions to a directory.")->group("");
  auto directory = std::make_shared<std::string>();
  app->add_option("directory", *directory, "where they are written")->type_name("DIR")->required();
  app->footer("Example: plumb manual build/manual\nExit codes: 0 written, 2 trouble.");
  return {app, [&plumb, directory] { return write_all(plumb, *directory); }};
}

}  // namespace plumb::cli
