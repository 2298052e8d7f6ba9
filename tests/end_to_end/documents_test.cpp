// Every command that the README shows is run as it stands there.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>

#include "references/faults/fault.hpp"
#include "tests/support/end_to_end.hpp"

namespace plumb::tests {
namespace {

/// Lines of the ```sh blocks, without their comments.
std::vector<std::string> shown_commands() {
  std::vector<std::string> commands;
  std::istringstream lines(read_file(source_path("README.md")));
  bool is_shell = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) {
      is_shell = line == "```sh";
    } else if (is_shell) {
      commands.push_back(line.substr(0, line.find("  #")));
    }
  }
  return commands;
}

TEST(Readme, EveryCommandRuns) {
  const auto commands = shown_commands();
  ASSERT_GE(commands.size(), 8U);
  const Workplace workplace;
  for (const char* folder : {"tests", "references", "scripts"}) {
    std::filesystem::create_directory_symlink(source_path(folder), workplace.path(folder));
  }
  std::filesystem::create_directory(workplace.path("build"));
  std::filesystem::create_symlink(PLUMB_BINARY, workplace.path("build/plumb"));
  for (const std::string& command : commands) {
    ASSERT_TRUE(command.starts_with("build/plumb ") || command.starts_with("mkdir ")) << command;
    system::ProcessLimits no_memory_limit;  // AddressSanitizer reserves terabytes of address space
    no_memory_limit.memory_bytes = ~std::size_t{0};
    const auto result =
        system::run_process({"/bin/sh", "-c", command}, workplace.directory(), no_memory_limit);
    EXPECT_EQ(result.exit_code, 0) << command << "\n" << result.output;
  }
  std::set<std::string> left;
  for (const auto& entry : std::filesystem::directory_iterator(workplace.directory()))
    left.insert(entry.path().filename().string());
  for (const char* const known : {"tests", "references", "scripts", "build", ".cache", "output.txt"})
    left.erase(known);
  EXPECT_TRUE(left.empty()) << "the commands leave " << *left.begin() << " in the clone";
}

TEST(Readme, IsShort) {
  const std::string readme = read_file(source_path("README.md"));
  EXPECT_LE(std::count(readme.begin(), readme.end(), '\n'), 150);
}

/// What a document says of the catalogue's size is what it is.
TEST(Documents, CountTheFaultsAsTheProgramDoes) {
  const std::size_t size = faults::fault_catalogue().size();
  std::size_t said = 0;
  for (const char* const name :
       {"README.md", "RESULTS.md", "BENCHMARKS.md", "DESIGN.md", "CONTRIBUTING.md"}) {
    const std::string text = read_file(source_path(name));
    const std::regex counts("([0-9]+) (faults|mistakes)\\b");
    for (std::sregex_iterator at(text.begin(), text.end(), counts), end; at != end; ++at, ++said)
      EXPECT_EQ(at->str(1), std::to_string(size)) << name << ": " << at->str();
  }
  EXPECT_GT(said, 2U);
}

TEST(Readme, NamesTheTwoCommandsAndTheyAreThere) {
  const std::string readme = read_file(source_path("README.md"));
  for (const char* script : {"scripts/verify", "scripts/test"}) {
    EXPECT_NE(readme.find(script), std::string::npos);
    const auto permissions = std::filesystem::status(source_path(script)).permissions();
    EXPECT_NE(permissions & std::filesystem::perms::owner_exec, std::filesystem::perms::none) << script;
  }
  EXPECT_NE(read_file(source_path(".ci/run")).find("scripts/test"), std::string::npos);
}

/// Skipped tests would look like a success.
TEST(ScriptsTest, RefusesToRunWithoutTheToolsOfItsTests) {
  const Workplace workplace;
  for (const char* const folder : {"scripts", "bin"})
    std::filesystem::create_directory(workplace.path(folder));
  workplace.file("scripts/test", read_file(source_path("scripts/test")));
  workplace.file("scripts/packages", "#!/bin/sh\n");
  workplace.file("scripts/build", "#!/bin/sh\necho building; exit 2\n");
  const auto chmod = [&](const char* what) {
    std::filesystem::permissions(workplace.path(what), std::filesystem::perms::owner_all);
  };
  chmod("scripts/packages");
  chmod("scripts/build");
  for (const char* const tool : {"povray", "idiff", "oiiotool"}) {
    const auto run = [&] {
      return run_shell(
          "dirname=$(command -v dirname); ln -sf \"$dirname\" bin/dirname; PATH=$PWD/bin "
          "/bin/sh scripts/test",
          workplace.directory());
    };
    const auto without = run();
    EXPECT_EQ(without.exit_code, 2);
    EXPECT_EQ(without.output.find(std::string(tool) + " is not on PATH"), 0U) << without.output;
    workplace.file(std::string("bin/") + tool, "#!/bin/sh\n");
    chmod((std::string("bin/") + tool).c_str());
    EXPECT_EQ(run().output.find(std::string(tool) + " is not"), std::string::npos);
  }
}

}  // namespace
}  // namespace plumb::tests
