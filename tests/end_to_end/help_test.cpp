// What the program tells of itself, and what it says to a command line it does not understand.
#include <filesystem>
#include <regex>
#include <sstream>

#include "tests/support/end_to_end.hpp"

namespace plumb::tests {
namespace {

struct CommandHelp {
  std::string command;
  std::vector<std::string> arguments;  ///< that it asks for
  std::vector<std::string> options;
};
void PrintTo(const CommandHelp& help, std::ostream* out) { *out << help.command; }

const std::vector<CommandHelp>& all_commands() {
  static const std::vector<CommandHelp> commands{
      {"render",
       {"s.sdf"},
       {"--output", "--encode", "--threads", "--real", "--error", "--size", "--camera", "--depth",
        "--glass-shadow", "--dialect"}},
      {"export",
       {"s.sdf"},
       {"--output", "--to", "--size", "--camera", "--depth", "--glass-shadow", "--dialect"}},
      {"verify",
       {"s.sdf"},
       {"--tolerance", "--stored", "--jobs", "--json", "--real", "--size", "--camera", "--depth",
        "--glass-shadow", "--dialect"}},
      {"diagnose",
       {"s.sdf", "a.pfm"},
       {"--hint", "--json", "--report", "--tolerance", "--size", "--camera", "--depth", "--glass-shadow",
        "--dialect"}},
      {"compare",
       {"a.pfm", "b.pfm"},
       {"--tolerance", "--allow-over", "--relative", "--ignore", "--only", "--channels", "--part",
        "--metrics", "--json", "--junit", "--report", "--diff"}},
      {"judge",
       {"--images", "d"},
       {"--renderer", "--submissions", "--images", "--scenes", "--readable", "--timeout", "--memory",
        "--report", "--json", "--csv", "--junit", "--hint", "--jobs", "--tolerance", "--dialect"}},
      {"lint", {"s.sdf"}, {"--json", "--dialect"}},
      {"needs",
       {"s.sdf"},
       {"--error", "--json", "--size", "--camera", "--depth", "--glass-shadow", "--dialect"}},
      {"references", {"--check"}, {"--check", "--update"}},
      {"regress",
       {"d"},
       {"--update", "--because", "--junit", "--json", "--tolerance", "--threads", "--real", "--size",
        "--camera", "--depth", "--glass-shadow", "--dialect"}},
      {"chart",
       {"s.sdf"},
       {"--json", "--svg", "--png", "--runs", "--fresh", "--size", "--camera", "--depth", "--glass-shadow",
        "--dialect"}}};
  return commands;
}

Outcome run(const std::vector<std::string>& arguments) {
  const Workplace workplace;
  return run_plumb(arguments, workplace.directory());
}

class HelpOfCommand : public testing::TestWithParam<CommandHelp> {};
INSTANTIATE_TEST_SUITE_P(Every, HelpOfCommand, testing::ValuesIn(all_commands()),
                         [](const auto& test) { return test.param.command; });

TEST_P(HelpOfCommand, HasAnExampleAndAllOptions) {
  const auto& [command, arguments, options] = GetParam();
  const Outcome outcome = run({command, "--help"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_TRUE(contains(outcome.out, "Usage: ")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "Example: plumb " + command + " ")) << outcome.out;
  for (const std::string& option : options) EXPECT_TRUE(contains(outcome.out, option)) << option;
}

TEST_P(HelpOfCommand, IsTheSameByItsShortName) {
  const std::string& command = GetParam().command;
  EXPECT_EQ(run({command, "-h"}).out, run({command, "--help"}).out);
}

TEST_P(HelpOfCommand, ItsExampleNamesScenesThatThereAre) {
  const std::string help = run({GetParam().command, "--help"}).out;
  const std::string example = help.substr(help.find("Example: "));
  const std::regex scene("tests/scenes/[a-z0-9-]+\\.sdf");
  for (std::sregex_iterator at(example.begin(), example.end(), scene); at != std::sregex_iterator(); ++at) {
    EXPECT_TRUE(std::filesystem::exists(source_path(at->str()))) << at->str();
  }
}

TEST_P(HelpOfCommand, WithoutArgumentsTheCommandSaysWhatItWants) {
  const Outcome outcome = run({GetParam().command});
  expect_trouble(outcome, {"required", "--help"});
  EXPECT_EQ(outcome.out, "");
}

TEST_P(HelpOfCommand, AnUnknownOptionIsNamed) {
  std::vector<std::string> arguments = GetParam().arguments;
  arguments.insert(arguments.begin(), GetParam().command);
  arguments.emplace_back("--nonsense");
  expect_trouble(run(arguments), {"--nonsense", "--help"});
}

TEST(Help, ListsTheCommandsTheExitCodesAndAnExample) {
  const Outcome outcome = run({"--help"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  for (const CommandHelp& command : all_commands())
    EXPECT_TRUE(contains(outcome.out, "\n  " + command.command + " "));
  EXPECT_TRUE(contains(outcome.out, "Example: plumb verify ")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "0 agrees, 1 differs, 2 trouble")) << outcome.out;
}

TEST(Help, ExplainsEveryPartOfADialect) {
  const std::string help = run({"lint", "--help"}).out;
  for (const char* const part :
       {"strict", "loose", "pre", "post", "trs", "la-ld", "la-ld-brightness", "light-color", "brightness-rgb",
        "refl", "opacity", "transparency", "ior", "gloss", "rough", "skip"}) {
    EXPECT_TRUE(contains(help, part)) << part;
  }
}

TEST(Help, TellsTheVersionAlone) {
  const Outcome outcome = run({"--version"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.out, "plumb " PLUMB_VERSION "\n");
}

TEST(CommandLine, WithoutACommandIsTrouble) {
  const Outcome outcome = run({});
  expect_trouble(outcome, {"--help"});
  EXPECT_EQ(outcome.out, "");
}

TEST(CommandLine, AnUnknownCommandIsNamed) { expect_trouble(run({"nonsense"}), {"nonsense", "--help"}); }

TEST(CommandLine, AnUnknownOptionBeforeTheCommandIsNamed) {
  expect_trouble(run({"--nonsense"}), {"--nonsense", "--help"});
}

TEST(CommandLine, ASurplusArgumentIsNamed) {
  expect_trouble(run({"render", "a.sdf", "surplus"}), {"surplus", "--help"});
}

TEST(CommandLine, AMistypedCommandOrOptionGetsTheNearest) {
  expect_trouble(run({"rendr", "a.sdf"}), {"rendr", "did you mean render?"});
  expect_trouble(run({"render", "a.sdf", "--sise", "3x4"}), {"--sise", "did you mean --size?"});
  expect_trouble(run({"render", "a.sdf", "--sise=3x4"}), {"did you mean --size?"});
  EXPECT_EQ(run({"nonsense"}).err.find("did you mean"), std::string::npos);
}

TEST(CommandLine, AnOptionWithoutItsValueIsNamed) {
  expect_trouble(run({"verify", "a.sdf", "--json"}), {"--json"});
}

struct WrongValue {
  std::string name;
  std::vector<std::string> arguments;
  std::vector<std::string> said;
};
void PrintTo(const WrongValue& value, std::ostream* out) { *out << value.name; }

class WrongOptionValue : public testing::TestWithParam<WrongValue> {};
INSTANTIATE_TEST_SUITE_P(
    Every, WrongOptionValue,
    testing::ValuesIn(std::vector<WrongValue>{
        {"Real", {"render", "s.sdf", "--real", "half"}, {"--real", "half", "long-double"}},
        {"DepthZero", {"render", "s.sdf", "--depth", "0"}, {"--depth", "0", "256"}},
        {"DepthTooDeep", {"export", "s.sdf", "--depth", "257"}, {"--depth", "257", "256"}},
        {"DepthWord", {"render", "s.sdf", "--depth", "deep"}, {"--depth", "deep"}},
        {"Threads", {"render", "s.sdf", "--threads", "0"}, {"--threads", "0"}},
        {"Jobs", {"verify", "s.sdf", "--jobs", "many"}, {"--jobs", "many"}},
        {"Encoding", {"render", "s.sdf", "--encode", "rec709"}, {"--encode", "rec709", "course"}},
        {"GlassShadow",
         {"render", "s.sdf", "--glass-shadow", "some"},
         {"--glass-shadow", "some", "filtered"}},
        {"Renderer", {"export", "s.sdf", "--to", "yafaray"}, {"--to", "yafaray", "povray"}},
        {"Dialect", {"lint", "s.sdf", "--dialect", "klingon"}, {"klingon", "loose", "refl"}},
        {"DialectWithAnEmptyPart", {"lint", "s.sdf", "--dialect", "loose,"}, {"dialect", "loose"}},
        {"DialectLayoutTwice", {"lint", "s.sdf", "--dialect", "ior-ior"}, {"ior-ior"}},
        {"ToleranceNegative", {"compare", "a.pfm", "a.pfm", "--tolerance", "-1"}, {"tolerance", "-1"}},
        {"ToleranceNan", {"compare", "a.pfm", "a.pfm", "--tolerance", "nan"}, {"tolerance"}},
        {"ToleranceInfinite", {"compare", "a.pfm", "a.pfm", "--tolerance", "inf"}, {"tolerance"}},
        {"ToleranceOfVerify", {"verify", "s.sdf", "--tolerance", "-1"}, {"tolerance", "-1"}},
        {"ErrorZero", {"needs", "s.sdf", "--error", "0"}, {"--error", "0", "> 0"}},
        {"ErrorNan", {"render", "s.sdf", "--error", "nan"}, {"--error", "nan"}},
        {"ErrorAndReal", {"render", "s.sdf", "--error", "1", "--real", "float"}, {"--error", "--real"}},
        {"CheckAndUpdate", {"references", "--check", "--update", "s.sdf"}, {"--check", "--update"}},
    }),
    [](const auto& test) { return test.param.name; });

TEST_P(WrongOptionValue, IsNamedInAFewWords) {
  const Workplace workplace;
  workplace.file("s.sdf", std::string(ball_scene));
  workplace.file("a.pfm", "Pf\n1 1\n-1\n" + std::string(4, '\0'));
  const auto before = listing(workplace.directory());
  const Outcome outcome = run_plumb(GetParam().arguments, workplace.directory());
  expect_trouble(outcome, GetParam().said);
  EXPECT_EQ(listing(workplace.directory()), before);
  if (GetParam().name.starts_with("Dialect")) return;  // these list what there is
  std::istringstream lines(outcome.err);
  for (std::string line; std::getline(lines, line);) EXPECT_LT(line.size(), 200U) << line;
}

}  // namespace
}  // namespace plumb::tests
