// Runs somebody's tracer on one scene.
#pragma once

#include <string>
#include <vector>

#include "references/submissions/grade.hpp"

namespace plumb::submissions {

/// Returns the extensions by which a picture that is handed in is known, in lower case and in upper case.
std::vector<std::string> picture_extensions();

/// Throws std::runtime_error when the runs of this submission cannot be confined.
void require_confined_runs(const Submission& submission, const JudgeOptions& options);

/// Runs the tracer and fills in what the run tells. Returns the picture: a regular file in `own_directory`,
/// out of the program's reach. Empty when there is none; the verdict then says why.
std::string picture_of_run(const Submission& submission, const JudgedScene& scene,
                           const JudgeOptions& options, const std::string& own_directory,
                           JudgedPicture& result);

/// Returns, likewise, the picture of that scene in the submission's directory: NAME and an image's extension.
std::string picture_handed_in(const Submission& submission, const JudgedScene& scene,
                              const JudgeOptions& options, const std::string& own_directory,
                              JudgedPicture& result);

/// Returns what the command's words and --readable let every run see, besides its submission.
std::vector<std::string> files_of_command(const JudgeOptions& options);

/// Returns what no run sees in there: submissions, except its own, and the results of this and earlier runs.
std::vector<std::string> hidden_from_runs(const JudgeOptions& options);

}  // namespace plumb::submissions
