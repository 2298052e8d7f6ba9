// The pictures of two directories, or of two patterns, compared in pairs.
#pragma once

#include <string>

#include "references/cli/compare_pair.hpp"

namespace plumb::cli {

struct CompareOptions {
  std::string reference;
  std::string test;
  std::string json;
  std::string junit;
  std::string report;
  std::string difference;  ///< a file, or of several pairs a directory
  references::Bounds bounds;
  PairOptions pair;

  /// Whether the results are told on standard output as text.
  bool says_text() const { return json != "-" && junit != "-"; }
};

/// Tells a row of a table for each pair when it is compared; a pair in trouble leaves the others theirs.
/// Returns the exit code of the worst.
int compare_several(const CompareOptions& options);

/// Writes --diff and says what it holds; nothing when there is none.
void write_difference(const std::string& path, const Findings& findings, bool says_text);

}  // namespace plumb::cli
