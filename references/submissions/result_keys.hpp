// What a result depends on, as one short text. While it is equal, the result need not be made again.
#pragma once

#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "references/submissions/grade.hpp"

namespace plumb::submissions {

/// Its functions may be called from several threads at once.
class ResultKeys {
 public:
  /// `options` must outlive it.
  explicit ResultKeys(const JudgeOptions& options);

  /// Returns the SHA-256 of this program, the options, the scene, and the state of all files of the
  /// submission and of the command, as far as a run sees them. Throws std::runtime_error when one of those is
  /// gone.
  std::string of(const Submission& submission, const JudgedScene& scene);

 private:
  std::string state_of(const Submission& submission);
  std::string state_of_file(const std::string& path);

  const JudgeOptions& options_;
  std::vector<std::string> hidden_;  ///< from all runs, so that it may change
  std::string common_;
  std::map<std::string, std::string> files_;  ///< by path, so that large ones are looked at once
  std::mutex mutex_;
};

}  // namespace plumb::submissions
