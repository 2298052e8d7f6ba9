// Where `plumb judge` writes its results, and where it keeps them until then.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "references/cli/command_line.hpp"
#include "references/report/class_report.hpp"

namespace plumb::cli {

struct JudgeOutputs {
  std::string report, json, csv, junit;
  std::string resume;  ///< the journal; empty: in the report, or beside the first of those that are files
  int hint = 3;
};

/// Adds --hint --report --json --csv --junit --resume.
Table judge_output_options(JudgeOutputs& outputs);

/// Throws std::invalid_argument when two of them go to standard output.
void check(const JudgeOutputs& outputs);

/// Returns the files and directories that are written, and where journals of earlier runs may lie.
std::vector<std::string> places_of_results(const JudgeOutputs& outputs);

/// Opens the journal, and says what it holds of an earlier run. Null when nothing is written to a file.
/// Throws std::runtime_error.
std::unique_ptr<submissions::Journal> open_journal(const JudgeOutputs& outputs);

/// Writes each of them. One that cannot be written is reported on standard error and does not stop the
/// others. Returns true when all are written. Puts varied scenes beside the report.
bool write_all(const JudgeOutputs& outputs, const std::vector<submissions::JudgedPicture>& all,
               const report::RunFacts& facts, const std::vector<submissions::JudgedScene>& scenes);

/// Prints the table for the terminal; nothing when a result goes to standard output.
void print(const JudgeOutputs& outputs, const std::vector<submissions::JudgedPicture>& all,
           const report::RunFacts& facts);

}  // namespace plumb::cli
