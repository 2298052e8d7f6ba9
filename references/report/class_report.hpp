// A class of tracers at a glance: words, CSV, JUnit and pages.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "references/submissions/grade.hpp"
#include "references/submissions/journal.hpp"

namespace plumb::report {

/// How much is told of a fault: 1 its slide, 2 what is wrong there, too, 3 the formula, too.
using HintLevel = int;

/// Returns what a fault is called at that level, in one line.
std::string named(const faults::Fault& fault, HintLevel hint);

/// Returns the same, with the faults that give the same picture in its place (level 3 names a few of them),
/// and how sure it is.
std::string found_in_words(const diagnosis::FoundFault& found, HintLevel hint);

/// What holds for a run as a whole.
struct RunFacts {
  std::optional<std::uint64_t> seed;              ///< of --shuffle
  std::vector<std::string> unvaried;              ///< scenes that were judged unchanged in spite of it
  std::vector<std::string> of_no_scene;           ///< pictures_of_no_scene(), which nobody judged
  std::string not_enforced;                       ///< limits_not_enforced(), of a run that confines programs
  const submissions::Journal* journal = nullptr;  ///< holds the pictures; may be null
};

/// Returns the number of pictures that have a verdict.
std::size_t judged_count(const std::vector<submissions::JudgedPicture>& all);

/// A line per picture, RFC 4180; a cell that a spreadsheet would take for a formula gets a ' before it.
std::string overview_csv(const std::vector<submissions::JudgedPicture>& all, HintLevel hint);

/// Returns a suite with a case per picture. Trouble and what was not judged are errors, not failures.
std::string overview_junit(const std::vector<submissions::JudgedPicture>& all, HintLevel hint);

/// Writes index.html, a page per submission, and at level 3 faults.html with a lesson on each fault found.
/// Throws std::runtime_error.
void write_overview(const std::string& directory, const std::vector<submissions::JudgedPicture>& all,
                    HintLevel hint, const RunFacts& facts = {});

}  // namespace plumb::report
