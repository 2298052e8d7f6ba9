// Compares the pictures of two directories, or of two patterns, in pairs.
#pragma once

#include <string>

#include "references/gates/findings.hpp"

namespace plumb::cli {

struct CompareOptions {
  std::string reference;
  std::string test;
  std::string json;
  std::string junit;
  std::string report;
  std::string difference;  ///< a file, or of several pairs a directory
  gates::Bounds bounds;
  gates::PairOptions pair;

  /// True if the results are shown on standard output as text.
  bool says_text() const { return json != "-" && junit != "-"; }
};

/// Prints a row of a table for each pair when it is compared. A pair in trouble does not stop the others.
/// Returns the exit code of the worst.
int compare_several(const CompareOptions& options);

/// Says what of the pictures a report does not show; nothing when that is empty.
void say_left_out(const std::string& left_out);

/// Writes --diff and says what it holds; nothing when there is none.
void write_difference(const std::string& path, const gates::Findings& findings, bool says_text);

}  // namespace plumb::cli
