// What several end-to-end tests need: a small scene, what is in a directory, a shell around the program.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "references/system/process.hpp"
#include "tests/support/run.hpp"

namespace plumb::tests {

/// A sphere before a background that is bright in blue; `out.ppm`, 32 x 24 pixels. The sphere is line 2.
inline constexpr std::string_view ball_scene =
    "define material red 0.4 0.1 0.1 0.6 0.2 0.1 0.3 0.2 0.1 20\n"
    "define shape sphere ball 0 0 -3 1 red\n"
    "define light key 4 6 2 1 1 1 1\n"
    "ambient 0.2 0.2 0.2\n"
    "background 0.1 0.15 3\n"
    "define camera eye 60 0 0 0 0 0 -1 0 1 0\n"
    "render eye out.ppm 32 24\n";
inline constexpr int ball_scene_lines = 7;

/// The text with the first `from` replaced by `to`.
inline std::string replaced(std::string_view text, std::string_view from, std::string_view to) {
  std::string result(text);
  const std::size_t at = result.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  if (at != std::string::npos) result.replace(at, from.size(), to);
  return result;
}

/// A parameter of a test that is printed, and so named by CTest, without quotes.
struct Word {
  const char* text;
};
inline void PrintTo(const Word& word, std::ostream* out) { *out << word.text; }

/// All that is below the directory, but for what the harness itself leaves there (its output, the cache).
inline std::vector<std::string> listing(const std::string& directory) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(directory)) {
    const std::string name = entry.path().lexically_relative(directory).string();
    if (name != ".out" && name != ".err" && name != "output.txt" && !name.starts_with(".cache")) {
      names.push_back(name);
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Runs a command of /bin/sh in the directory; in it, "$0" is the program. The output is both of its streams.
inline system::ProcessResult run_shell(const std::string& command, const std::string& directory) {
  system::ProcessLimits limits;
  limits.seconds = 120;
  limits.memory_bytes = std::numeric_limits<std::size_t>::max();  // an address sanitizer reserves terabytes
  const std::string with_environment =
      "export PLUMB_CACHE='" + directory + "/.cache' LSAN_OPTIONS='" + leak_options() + "'; " + command;
  return system::run_process({"/bin/sh", "-c", with_environment, PLUMB_BINARY}, directory, limits);
}

/// The program said in its own words what is wrong, all of `parts` among them: it did not crash.
inline void expect_own_words(const std::string& said, const std::vector<std::string>& parts) {
  EXPECT_FALSE(said.empty());
  for (const std::string& part : parts)
    EXPECT_TRUE(contains(said, part)) << part << " is missing in\n" << said;
  for (const char* const crash :
       {"terminate called", "what():", "Sanitizer", "Segmentation", "core dumped", "Assertion", "std::"}) {
    EXPECT_FALSE(contains(said, crash)) << said;
  }
}

/// Exit code 2 and a message on standard error that holds all the parts.
inline void expect_trouble(const Outcome& outcome, const std::vector<std::string>& parts) {
  EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
  expect_own_words(outcome.err, parts);
}

inline void expect_trouble(const system::ProcessResult& result, const std::vector<std::string>& parts) {
  EXPECT_EQ(result.exit_code, 2) << result.output;
  EXPECT_EQ(result.signal, 0) << result.output;
  EXPECT_FALSE(result.timed_out);
  expect_own_words(result.output, parts);
}

}  // namespace plumb::tests
