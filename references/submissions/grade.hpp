// Other people's tracers judged by their pictures: each submission on each scene gets a verdict, whatever
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

namespace plumb::references {

class Journal;

enum class Judged {
  right,
  right_apart,  ///< from a few pixels
  faults,       ///< known ones explain the picture, or a part
  unexplained,  ///< wrong, in a way that is not known
  wrong_size,
  no_image,
  unreadable,  ///< also a picture that is cut off
  crashed,     ///< by a signal, or with an exit code and no picture
  timed_out,
  too_much_cpu,
  too_much_memory,
  too_many_processes,
  too_much_output,
  trouble,    ///< ours, with this picture alone: it says nothing about the submission
  not_judged  ///< the run was interrupted before
};

/// As the reports say it, e.g. "too-much-output".
const char* to_string(Judged verdict);

/// The verdict of that name. Throws std::invalid_argument when there is none.
Judged verdict_named(const std::string& name);

struct JudgedScene {
  std::string name;  ///< of the file, without .sdf
  std::string text;  ///< what a program is given
  Scene scene;
};

struct Submission {
  std::string name;
  std::string path;  ///< {submission}, absolute, or the directory of its pictures; may be empty
};

/// Where a journal keeps a result; of size 0 when it does not.
struct KeptLine {
  std::uint64_t at = 0;
  std::size_t size = 0;
};

struct JudgedPicture {
  std::string submission;
  std::string scene;
  Judged verdict = Judged::not_judged;
  std::string message;                 ///< one line; empty when the picture is right and looked at as a whole
  std::string printed;                 ///< by the program
  double wall_seconds = 0;             ///< of the program
  std::optional<Diagnosis> diagnosis;  ///< when there was a picture of the right size
  KeptLine kept;                       ///< the pictures are there, too
};

struct JudgeOptions {
  std::vector<std::string> command;   ///< with {scene} {image} {submission}; empty: pictures only
  std::string submissions_directory;  ///< hidden from each submission but for its own; may be empty
  std::vector<std::string> readable;  ///< paths that a program may read in the hidden places
  std::vector<std::string> results;   ///< what the run writes, which tells of right pictures: hidden, too
  SandboxLimits limits;
  int jobs = 2;
  bool keeps_pictures = false;  ///< in the journal, so that memory does not hold them
  Dialect dialect;
  RenderOptions render;
  std::optional<double> tolerance;                     ///< as in diagnose()
  Journal* journal = nullptr;                          ///< may be null
  std::function<void(double)> progress;                ///< from one thread at a time
  std::function<void(const std::string&)> complain;    ///< of trouble with the journal; likewise
  std::function<bool()> stops = [] { return false; };  ///< asked often; true: no more are begun
};

/// The scenes of a directory, *.sdf, by name; those of plumb itself when it is empty. Throws
/// std::runtime_error.
std::vector<JudgedScene> scenes_to_judge(const std::string& directory, const Dialect& dialect);

/// Each entry of a directory, by name. Throws std::runtime_error when there is none.
std::vector<Submission> submissions_in(const std::string& directory);

/// The submissions of a directory of pictures: its directories, links to such included; itself, when it has
/// none, or pictures and nothing but links.
std::vector<Submission> pictures_in(const std::string& directory);

/// The files with a picture's name, below a directory of pictures, that are of no scene: relative to it, by
/// name, as shown_name() has them.
std::vector<std::string> pictures_of_no_scene(const std::string& directory,
                                              const std::vector<Submission>& submissions,
                                              const std::vector<JudgedScene>& scenes);

/// All submissions on all scenes, by submission, then by scene. Whatever goes wrong with one is its verdict,
/// and the others keep theirs. Throws std::runtime_error only when nothing can be confined.
std::vector<JudgedPicture> judge_all(const std::vector<Submission>& submissions,
                                     const std::vector<JudgedScene>& scenes, const JudgeOptions& options);

}  // namespace plumb::references
