// The teaching set tells all faults apart, no smaller one does, and the matrix in the documents is the
// measured one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <random>
#include <set>
#include <sstream>

#include "references/teaching/document.hpp"
#include "references/teaching/tell_apart.hpp"
#include "tests/support/run.hpp"
#include "tracer/format/reader.hpp"

namespace plumb::tests {
namespace {

std::string shipped_text() { return read_file(tests::source_path("tests/scenes/TEACHING.md")); }

std::vector<std::string> shipped_set() {
  std::vector<std::string> names;
  std::istringstream lines(shipped_text());
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("- `")) names.push_back(line.substr(3, line.size() - 4));
  }
  return names;
}

/// Of the shipped set alone.
teaching::Matrix measured_matrix() {
  std::vector<teaching::Lesson> lessons;
  for (const std::string& name : shipped_set())
    lessons.push_back({name, load_scene(tests::source_path("tests/scenes/" + name), {})});
  return teaching::Matrix(lessons, [](double) {});
}

teaching::Indices first(std::size_t count) {
  teaching::Indices all;
  for (std::size_t i = 0; i < count; ++i) all.push_back(i);
  return all;
}

void expect_that_all_are_told_apart_but_the_named(const teaching::Matrix& matrix) {
  const std::string text = shipped_text();
  for (const teaching::Pair& pair : teaching::pairs_left(matrix, first(shipped_set().size()))) {
    const std::string line =
        "- " + teaching::picture_name(pair.a) + " and " + teaching::picture_name(pair.b) + "\n";
    EXPECT_NE(text.find(line), std::string::npos) << line;
  }
}

void expect_that_each_is_needed(const teaching::Matrix& matrix) {
  const std::size_t count = shipped_set().size();
  const std::size_t left = teaching::pairs_left(matrix, first(count)).size();
  for (std::size_t i = 0; i < count; ++i) {
    teaching::Indices rest = first(count);
    std::erase(rest, i);
    EXPECT_GT(teaching::pairs_left(matrix, rest).size(), left) << shipped_set()[i];
  }
}

TEST(Teaching, OnlyASceneThatTellsThemApartIsNamed) {
  const auto lesson = [](const std::string& name) {
    return teaching::Lesson{name, load_scene(tests::source_path("tests/scenes/" + name), {})};
  };
  const std::vector<const faults::Fault*> faults{faults::find_fault("specular-not-clamped"),
                                                 faults::find_fault("specular-absolute")};
  const teaching::Lesson even = lesson("phong-even-exponent.sdf");
  EXPECT_EQ(teaching::scene_that_tells_apart({even, lesson("box.sdf")}, faults), std::nullopt);
  EXPECT_EQ(teaching::scene_that_tells_apart({even, lesson("phong-odd-exponent.sdf")}, faults),
            "phong-odd-exponent.sdf");
}

/// The rows of the matrix in the document, by fault.
std::map<std::string, std::string> shipped_rows() {
  const std::string text = shipped_text();
  const std::size_t begin = text.find("```\n") + 4;
  std::istringstream lines(text.substr(begin, text.find("```", begin) - begin));
  std::map<std::string, std::string> rows;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t end = line.find(' ');
    std::string cells = line.substr(end);
    std::erase(cells, ' ');
    if (end != 0) rows[line.substr(0, end)] = cells;
  }
  return rows;
}

void expect_that_the_document_has(const teaching::Matrix& matrix) {
  const auto rows = shipped_rows();
  const std::vector<teaching::Lesson> lessons = teaching::lessons_in(tests::source_path("tests/scenes"));
  ASSERT_EQ(rows.size(), faults::fault_catalogue().size()) << "build/plumb faults --corpus tests/scenes > "
                                                              "tests/scenes/TEACHING.md";
  for (std::size_t i = 0; i < shipped_set().size(); ++i) {
    const auto column = std::find_if(lessons.begin(), lessons.end(), [&](const teaching::Lesson& lesson) {
      return lesson.name == shipped_set()[i];
    });
    ASSERT_NE(column, lessons.end());
    for (std::size_t fault = 0; fault < faults::fault_catalogue().size(); ++fault) {
      const std::string id(faults::fault_catalogue()[fault].id);
      ASSERT_EQ(rows.at(id).size(), lessons.size());
      EXPECT_EQ(rows.at(id)[static_cast<std::size_t>(column - lessons.begin())] == '#',
                matrix.shows(i, fault))
          << id << " in " << column->name;
    }
  }
}

/// One test, because measuring takes longer than all that is asked of the result.
TEST(Teaching, TheShippedSetTellsAllApartNeedsEachAndIsDocumented) {
  ASSERT_FALSE(shipped_set().empty());
  const teaching::Matrix matrix = measured_matrix();
  expect_that_all_are_told_apart_but_the_named(matrix);
  expect_that_each_is_needed(matrix);
  expect_that_the_document_has(matrix);
}

bool hits_all(const std::vector<teaching::Indices>& wishes, unsigned chosen) {
  return std::all_of(wishes.begin(), wishes.end(), [&](const teaching::Indices& wish) {
    return std::any_of(wish.begin(), wish.end(), [&](std::size_t i) { return (chosen >> i & 1U) != 0; });
  });
}

TEST(SmallestHittingSet, IsAsSmallAsTheBestOfAllSets) {
  constexpr unsigned indices = 10;
  std::mt19937 random(5);
  int smaller_than_greedy = 0;
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<teaching::Indices> wishes;
    for (unsigned i = 0; i < 5 + random() % 20; ++i) {
      std::set<std::size_t> wish;
      for (unsigned k = 0; k < 2 + random() % 3; ++k) wish.insert(random() % indices);
      wishes.emplace_back(wish.begin(), wish.end());
    }
    const auto found = teaching::smallest_hitting_set(wishes, 1'000'000);
    ASSERT_TRUE(found);
    unsigned chosen = 0;
    for (const std::size_t i : *found) chosen |= 1U << i;
    EXPECT_TRUE(hits_all(wishes, chosen));
    int best = indices;
    for (unsigned set = 0; set < 1U << indices; ++set) {
      if (hits_all(wishes, set)) best = std::min(best, __builtin_popcount(set));
    }
    EXPECT_EQ(static_cast<int>(found->size()), best);
    smaller_than_greedy += found->size() < teaching::greedy_hitting_set(wishes).size() ? 1 : 0;
  }
  EXPECT_GT(smaller_than_greedy, 0) << "the greedy set is always the best here: nothing is tested";
}

TEST(SmallestHittingSet, SaysWhenItIsNotProven) {
  EXPECT_FALSE(teaching::smallest_hitting_set({{0, 1}, {1, 2}, {0, 2}}, 1));
}

}  // namespace
}  // namespace plumb::tests
