// Judges other people's tracers by their pictures. Each submission gets a verdict on each scene, whatever
// happens.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "references/diagnosis/diagnosis.hpp"
#include "references/submissions/sandbox/sandbox.hpp"
#include "tracer/format/dialect.hpp"
#include "tracer/scene/render_options.hpp"

namespace plumb::submissions {

class Journal;

enum class Judged {
  right,
  right_apart,  ///< but for a few pixels
  faults,       ///< known faults explain the picture, all or in part
  unexplained,  ///< wrong, in a way that is not known
  wrong_size,
  no_image,
  unreadable,  ///< also when it is cut off
  crashed,     ///< by a signal, or with an exit code and no picture
  timed_out,
  too_much_cpu,
  too_much_memory,
  too_many_processes,
  too_much_output,
  trouble,    ///< ours, with this picture alone; says nothing about the submission
  not_judged  ///< the run was interrupted before
};

/// Returns the name in reports, e.g. "too-much-output".
const char* to_string(Judged verdict);

/// Returns the verdict of that name. Throws std::invalid_argument when there is none.
Judged verdict_named(const std::string& name);

struct JudgedScene {
  std::string name;  ///< that of the file, without .sdf
  std::string text;  ///< what a program is given
  Scene scene;
};

struct Submission {
  std::string name;
  std::string path;  ///< {submission}, absolute, or the directory of its pictures; may be empty
};

/// Where a journal keeps a result; its size is 0 when it keeps none.
struct KeptLine {
  std::uint64_t at = 0;
  std::size_t size = 0;
};

struct JudgedPicture {
  std::string submission;
  std::string scene;
  Judged verdict = Judged::not_judged;
  std::string message;      ///< one line; empty for a right picture that was looked at in full
  std::string printed;      ///< what the program printed
  double wall_seconds = 0;  ///< of the program
  std::optional<diagnosis::Diagnosis> diagnosis;  ///< when there was a picture of the right size
  KeptLine kept;                                  ///< with its pictures
};

struct JudgeOptions {
  std::vector<std::string> command;   ///< with {scene} {image} {submission}; empty: pictures only
  std::string submissions_directory;  ///< hidden from each submission, except its own; may be empty
  std::vector<std::string> readable;  ///< paths that a program may read in the hidden places
  std::vector<std::string> results;   ///< what the run writes; it tells of right pictures and is hidden, too
  SandboxLimits limits;
  int jobs = 2;
  bool keeps_pictures = false;  ///< in the journal instead of in memory
  Dialect dialect;
  RenderOptions render;
  std::optional<double> tolerance;                     ///< as in diagnose()
  Journal* journal = nullptr;                          ///< may be null
  std::function<void(double)> progress;                ///< called by one thread at a time
  std::function<void(const std::string&)> complain;    ///< called on trouble with the journal, likewise
  std::function<bool()> stops = [] { return false; };  ///< asked often; once true, no more are begun
};

/// Returns the scenes *.sdf of a directory, by name; those of plumb itself when it is empty. Throws
/// std::runtime_error.
std::vector<JudgedScene> scenes_to_judge(const std::string& directory, const Dialect& dialect);

/// Returns each entry of a directory, by name. Throws std::runtime_error when there is none.
std::vector<Submission> submissions_in(const std::string& directory);

/// Returns the submissions in a directory of pictures: its directories, and links to such. Returns the
/// directory itself when there are none, or when they are all links beside pictures.
std::vector<Submission> pictures_in(const std::string& directory);

/// Returns the files below a directory of pictures that have a picture's name and belong to no scene:
/// relative to it, by name, as shown_name() has them.
std::vector<std::string> pictures_of_no_scene(const std::string& directory,
                                              const std::vector<Submission>& submissions,
                                              const std::vector<JudgedScene>& scenes);

/// Judges all submissions on all scenes; results are by submission, then by scene. Whatever goes wrong with
/// one is its verdict, and the others keep theirs. Throws std::runtime_error only when nothing can be
/// confined.
std::vector<JudgedPicture> judge_all(const std::vector<Submission>& submissions,
                                     const std::vector<JudgedScene>& scenes, const JudgeOptions& options);

}  // namespace plumb::submissions
