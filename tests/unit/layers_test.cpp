// The architecture: what a room includes, its library links, and links run one way.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/run.hpp"

namespace plumb::tests {
namespace {

namespace fs = std::filesystem;

/// A folder with a library, as the build has them: the folder, its library, the libraries that it links.
struct Room {
  std::string library;
  std::vector<std::string> uses;
};

std::map<std::string, Room> rooms() {
  std::map<std::string, Room> all;
  std::istringstream lines(read_file((fs::path(PLUMB_BINARY).parent_path() / "rooms.txt").string()));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string folder, word;
    words >> folder;
    Room& room = all[folder];
    words >> room.library;
    while (words >> word) room.uses.push_back(word);
  }
  return all;
}

/// All libraries that a room links, or that those link.
std::set<std::string> below(const std::map<std::string, Room>& all, const Room& room) {
  std::set<std::string> found;
  std::vector<std::string> ahead = room.uses;
  while (!ahead.empty()) {
    const std::string library = ahead.back();
    ahead.pop_back();
    if (!found.insert(library).second) continue;
    for (const auto& [folder, other] : all)
      if (other.library == library) ahead.insert(ahead.end(), other.uses.begin(), other.uses.end());
  }
  return found;
}

/// The room that a folder belongs to: itself, or the nearest above it. Empty when there is none.
std::string room_of(const std::map<std::string, Room>& all, fs::path folder) {
  while (!folder.empty() && !all.contains(folder.string())) folder = folder.parent_path();
  return folder.string();
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

TEST(Layers, IncludesFollowTheLinksOfTheLibraries) {
  const auto all = includes();
  const auto rooms_built = rooms();
  ASSERT_GT(all.size(), 100U) << "the test reads too few files to mean anything";
  ASSERT_GT(rooms_built.size(), 20U);
  for (const Include& include : all) {
    const std::string from = room_of(rooms_built, include.from), to = room_of(rooms_built, include.to);
    ASSERT_NE(from, "") << include.from_file << " is in a folder that has no library";
    if (from == to) continue;
    ASSERT_NE(to, "") << include.from_file << " includes a file of " << include.to
                      << ", which has no library";
    EXPECT_TRUE(below(rooms_built, rooms_built.at(from)).contains(rooms_built.at(to).library))
        << include.from_file << " includes a file of " << include.to << ", which " << from
        << " does not link";
  }
}

TEST(Layers, LinksRunOneWay) {
  const auto all = rooms();
  for (const auto& [folder, room] : all) EXPECT_FALSE(below(all, room).contains(room.library)) << folder;
}

TEST(Layers, NoSourceLiesLooseInReferences) {
  for (const auto& entry : fs::directory_iterator(source_path("references")))
    EXPECT_FALSE(is_source(entry.path())) << entry.path();
}

void expect_only_in(const std::string& source, const std::string& text) {
  for (const char* part : {"tracer", "exporters", "references"}) {
    for (const auto& file : fs::recursive_directory_iterator(source_path(part))) {
      if (!is_source(file.path())) continue;
      const bool has_it = read_file(file.path().string()).find(text) != std::string::npos;
      EXPECT_EQ(has_it, file.path() == source_path(source)) << file.path() << ": " << text;
    }
  }
}

TEST(Layers, OnePlaceKnowsWhereTheSourceWas) {
  expect_only_in("tracer/system/installation.cpp", "PLUMB_SOURCE_DIRECTORY");
}

TEST(Layers, OnlyTheModuleKnowsOpenImageIO) {
  expect_only_in("tracer/image/oiio_module.cpp", "#include <OpenImageIO");
}

TEST(Layers, OneFileKnowsTheParserOfTheCommandLine) {
  expect_only_in("references/cli/command_line.cpp", "#include <CLI/");
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
