// One run of somebody's tracer on one scene.
#pragma once

#include <string>
#include <vector>

#include "references/submissions/grade.hpp"

namespace plumb::references {

/// By which a picture that is handed in is known, in lower case and in upper case.
std::vector<std::string> picture_extensions();

/// Throws std::runtime_error when nothing can be confined as the runs of this submission are.
void require_confined_runs(const Submission& submission, const JudgeOptions& options);

/// Fills in what the run tells; the picture, when there is one, is then the regular file that is returned, in
/// `own_directory`, out of the program's reach. Empty when there is none: then the verdict says why.
std::string picture_of_run(const Submission& submission, const JudgedScene& scene,
                           const JudgeOptions& options, const std::string& own_directory,
                           JudgedPicture& result);

/// The picture of that scene in the submission's directory, NAME and an image's extension; as above.
std::string picture_handed_in(const Submission& submission, const JudgedScene& scene,
                              const JudgeOptions& options, const std::string& own_directory,
                              JudgedPicture& result);

/// What the command's words and --readable let every run see, beside its submission.
std::vector<std::string> files_of_command(const JudgeOptions& options);

/// What no run sees in there: the submissions, but for its own, and the results of this and earlier runs.
std::vector<std::string> hidden_from_runs(const JudgeOptions& options);

}  // namespace plumb::references
