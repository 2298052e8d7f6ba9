// LECTURE.md: every file, symbol, test and scene that it names exists.
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "tests/support/run.hpp"

namespace plumb::tests {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> pieces;
  std::istringstream stream(text);
  for (std::string piece; std::getline(stream, piece, separator);) pieces.push_back(piece);
  return pieces;
}

/// What stands between backticks.
std::vector<std::string> names_in(const std::string& cell) {
  const auto pieces = split(cell, '`');
  std::vector<std::string> names;
  for (std::size_t i = 1; i < pieces.size(); i += 2) names.push_back(pieces[i]);
  return names;
}

struct Row {
  std::string text;
  std::vector<std::string> where;   // a file, then symbols in it
  std::vector<std::string> others;  // tests and scenes
};

/// Rows of all tables of LECTURE.md; "where" is the column of that name.
std::vector<Row> rows() {
  std::vector<Row> found;
  std::size_t where = 0;
  for (const std::string& line : split(read_file(source_path("LECTURE.md")), '\n')) {
    if (!line.starts_with("| ")) continue;
    const auto cells = split(line, '|');
    const auto head = std::find(cells.begin(), cells.end(), " where ");
    if (head != cells.end()) {
      where = static_cast<std::size_t>(head - cells.begin());
      continue;
    }
    Row row{line, names_in(cells.at(where)), {}};
    for (std::size_t i = where + 1; i < cells.size(); ++i) {
      for (const std::string& name : names_in(cells[i])) row.others.push_back(name);
    }
    found.push_back(row);
  }
  return found;
}

TEST(Lecture, EverySymbolStandsInItsFile) {
  const auto all = rows();
  ASSERT_GT(all.size(), 30U);
  for (const Row& row : all) {
    ASSERT_GE(row.where.size(), 2U) << row.text;
    const std::string source = read_file(source_path(row.where.front()));
    for (std::size_t i = 1; i < row.where.size(); ++i) {
      EXPECT_NE(source.find(row.where[i]), std::string::npos)
          << row.where[i] << " is not in " << row.where.front();
    }
  }
}

TEST(Lecture, EveryTestAndSceneExists) {
  for (const Row& row : rows()) {
    ASSERT_FALSE(row.others.empty()) << row.text;
    for (const std::string& name : row.others) {
      const std::string path = name.ends_with(".sdf") ? "tests/scenes/" + name : name;
      EXPECT_TRUE(std::filesystem::is_regular_file(source_path(path)))
          << path << " is named in: " << row.text;
    }
  }
}

}  // namespace
}  // namespace plumb::tests
