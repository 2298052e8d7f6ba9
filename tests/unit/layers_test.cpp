// The architecture, read off the #includes: each layer may use only those below it.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include "tests/support/run.hpp"

namespace plumb::tests {
namespace {

namespace fs = std::filesystem;

/// What a folder may include of ours besides itself. A folder that is not named here must not exist.
const std::map<std::string, std::set<std::string>>& allowed() {
  static const std::map<std::string, std::set<std::string>> table{
      {"tracer/formulas", {}},
      {"tracer/scene", {"tracer/formulas"}},
      {"tracer/image", {"tracer/image/codecs"}},  // the boundary of the module alone
      {"tracer/image/codecs", {"tracer/image"}},
      {"tracer/image/decoder", {"tracer/image", "tracer/image/codecs"}},
      {"tracer/textbook", {"tracer/formulas", "tracer/scene", "tracer/image"}},
      {"tracer/engine", {"tracer/formulas", "tracer/scene", "tracer/image"}},
      {"tracer/methods", {"tracer/formulas", "tracer/scene"}},
      {"exporters", {"tracer/formulas", "tracer/scene"}},
      {"references/faults",
       {"tracer/formulas", "tracer/scene", "tracer/image", "tracer/textbook", "references"}},
      {"references/diagnosis",
       {"tracer/formulas", "tracer/scene", "tracer/image", "tracer/textbook", "references",
        "references/faults"}},
      {"references/judging",
       {"tracer/scene", "tracer/image", "tracer/textbook", "references", "references/diagnosis",
        "references/faults", "references/report", "references/teaching"}},
      {"references/teaching",
       {"tracer/formulas", "tracer/scene", "tracer/image", "references", "references/diagnosis",
        "references/faults", "references/report"}},
      {"references/stability",
       {"tracer/formulas", "tracer/scene", "tracer/image", "tracer/textbook", "tracer/methods", "exporters",
        "references", "references/methods", "references/report"}},
      {"references/methods",
       {"tracer/formulas", "tracer/scene", "tracer/image", "tracer/textbook", "tracer/methods"}},
      {"references/metrics", {"tracer/engine"}},  // its choice of vectors alone
      {"references",
       {"tracer/formulas", "tracer/scene", "tracer/image", "tracer/textbook", "tracer/engine", "exporters",
        "references/metrics"}},
      {"references/chart",
       {"tracer/formulas", "tracer/scene", "tracer/image", "tracer/textbook", "tracer/engine", "exporters",
        "references", "references/methods"}},
      {"references/report", {"tracer/image", "references"}},
      {"references/needs",
       {"tracer/formulas", "tracer/scene", "tracer/image", "tracer/textbook", "tracer/engine", "references"}},
      {"references/cli",
       {"tracer/formulas", "tracer/scene", "tracer/image", "tracer/textbook", "tracer/engine", "exporters",
        "references", "references/chart", "references/diagnosis", "references/faults", "references/metrics",
        "references/judging", "references/needs", "references/report", "references/stability",
        "references/teaching"}}};
  return table;
}

bool is_source(const fs::path& path) { return path.extension() == ".hpp" || path.extension() == ".cpp"; }

struct Include {
  std::string from;
  std::string from_file;
  std::string to;
};

std::vector<Include> includes() {
  std::vector<Include> found;
  const std::string top = source_path("");
  for (const char* part : {"tracer", "exporters", "references"}) {
    for (const auto& file : fs::recursive_directory_iterator(top + part)) {
      if (!is_source(file.path())) continue;
      const std::string folder = fs::relative(file.path().parent_path(), top).string();
      std::istringstream lines(read_file(file.path().string()));
      for (std::string line; std::getline(lines, line);) {
        constexpr std::string_view start = "#include \"";
        if (!line.starts_with(start)) continue;
        const std::string target = line.substr(start.size(), line.rfind('"') - start.size());
        found.push_back({folder, file.path().string(), fs::path(target).parent_path().string()});
      }
    }
  }
  return found;
}

TEST(Layers, EveryTestFileIsBuilt) {
  const std::string built =
      read_file(source_path("tests/CMakeLists.txt")) + read_file(source_path("tests/bench/CMakeLists.txt"));
  for (const auto& entry : fs::recursive_directory_iterator(source_path("tests"))) {
    std::string name = entry.path().lexically_relative(source_path("tests")).string();
    if (entry.path().extension() != ".cpp" || name.starts_with("fuzz/")) continue;
    if (name.starts_with("bench/")) name.erase(0, 6);
    const fs::path beside = entry.path().parent_path() / "CMakeLists.txt";
    if (fs::exists(beside) &&
        read_file(beside.string()).find(entry.path().filename().string()) != std::string::npos)
      continue;
    EXPECT_NE(built.find(name), std::string::npos) << name << " is in no CMakeLists.txt of the tests";
  }
}

TEST(Layers, IncludesRunOneWay) {
  const auto all = includes();
  ASSERT_GT(all.size(), 100U) << "the test reads too few files to mean anything";
  for (const Include& include : all) {
    ASSERT_TRUE(allowed().contains(include.from)) << include.from_file << " is in a folder that has no layer";
    const bool is_allowed = include.to == include.from || allowed().at(include.from).contains(include.to);
    EXPECT_TRUE(is_allowed) << include.from_file << " includes a file of " << include.to;
  }
}

TEST(Layers, OnlyTheModuleKnowsOpenImageIO) {
  for (const char* part : {"tracer", "exporters", "references"}) {
    for (const auto& file : fs::recursive_directory_iterator(source_path(part))) {
      if (!is_source(file.path()) || file.path().filename() == "oiio_module.cpp") continue;
      EXPECT_EQ(read_file(file.path().string()).find("#include <OpenImageIO"), std::string::npos)
          << file.path();
    }
  }
}

TEST(Layers, TheTopLevelIsFixed) {
  const std::set<std::string> fixed{"tracer",  "exporters", "references", "tests",
                                    "scripts", "build",     ".ci",        ".git"};
  for (const auto& entry : fs::directory_iterator(source_path(""))) {
    if (!entry.is_directory()) continue;
    EXPECT_TRUE(fixed.contains(entry.path().filename().string())) << entry.path();
  }
}

}  // namespace
}  // namespace plumb::tests
