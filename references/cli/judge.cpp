#include <algorithm>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>

#include "references/cli/commands.hpp"
#include "references/cli/confined.hpp"
#include "references/cli/judge_outputs.hpp"
#include "references/cli/options.hpp"
#include "references/cli/progress.hpp"
#include "references/submissions/command_line.hpp"
#include "references/submissions/grade.hpp"
#include "references/submissions/interrupts.hpp"
#include "references/submissions/shown_text.hpp"
#include "references/submissions/shuffle.hpp"

namespace plumb::cli {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string submissions, images, scenes;
  std::optional<std::uint64_t> shuffle;
  ConfinedOptions confined;
  JudgeOutputs outputs;
  submissions::JudgeOptions judge;
};

std::vector<std::string> command_of(const ConfinedOptions& options) {
  std::vector<std::string> command = renderer_words(options);
  std::string& program = command.front();
  if (program.find('{') == std::string::npos) program = found_program(program, program);
  return command;
}

void set_command(const Options& options, submissions::JudgeOptions& judge) {
  judge.command = command_of(options.confined);
  if (!submissions::mentions(judge.command, "scene"))
    throw std::invalid_argument("--renderer: found no {scene} in `" + options.confined.renderer +
                                "`, expected e.g. 'my-tracer {scene} {image}'");
  if (submissions::mentions(judge.command, "submission") == options.submissions.empty())
    throw std::invalid_argument(
        "--submissions and {submission} in --renderer: expected both or neither; "
        "e.g. --renderer '{submission}/tracer {scene} {image}' --submissions class");
  if (!options.submissions.empty())
    judge.submissions_directory = fs::weakly_canonical(options.submissions).string();
}

/// What no option says by itself.
void complete(Options& options) {
  submissions::JudgeOptions& judge = options.judge;
  if (!options.confined.renderer.empty()) set_command(options, judge);
  judge.readable = readable_paths(options.confined);
  judge.limits = limits_of(options.confined);
  judge.results = places_of_results(options.outputs);
  judge.keeps_pictures = !options.outputs.report.empty();
}

/// A script that runs the submissions may lie among them.
std::vector<submissions::Submission> without_command(std::vector<submissions::Submission> all,
                                                     const submissions::JudgeOptions& judge) {
  std::erase_if(all, [&](const submissions::Submission& submission) {
    std::error_code none;
    return std::any_of(judge.command.begin(), judge.command.end(),
                       [&](const std::string& word) { return fs::equivalent(word, submission.path, none); });
  });
  const bool are_directories = std::any_of(judge.command.begin(), judge.command.end(), [](const auto& word) {
    return word.find("{submission}/") != std::string::npos;
  });
  std::erase_if(all, [&](const submissions::Submission& submission) {
    std::error_code none;
    const bool is_file = are_directories && fs::is_regular_file(fs::symlink_status(submission.path, none));
    if (is_file)
      warn("--submissions: not judged, for it is a file, and --renderer looks into directories: " +
           submissions::printable(submission.name));
    return is_file;
  });
  if (all.empty())
    throw std::invalid_argument(
        "--submissions: found nothing but what --renderer names, expected submissions");
  return all;
}

std::vector<submissions::Submission> submissions_of(const Options& options) {
  if (!options.images.empty()) return submissions::pictures_in(options.images);
  if (!options.submissions.empty())
    return without_command(submissions::submissions_in(options.submissions), options.judge);
  return {{options.confined.renderer, ""}};
}

void check_options(const Options& options) {
  if (options.confined.renderer.empty() == options.images.empty())
    throw std::invalid_argument("judge: --renderer or --images is required, and not both; see --help");
  if (options.shuffle && options.confined.renderer.empty())
    throw std::invalid_argument(
        "--shuffle: found --images, expected --renderer: pictures that are made already show the scenes as "
        "they are");
  check(options.outputs);
}

/// Varies the scenes when that is asked for, and says which could not be.
report::RunFacts shuffle(const Options& options, const Dialect& dialect,
                         std::vector<submissions::JudgedScene>& scenes) {
  report::RunFacts facts;
  facts.seed = options.shuffle;
  if (!facts.seed) return facts;
  Progress progress("varying the scenes");
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    progress.show(static_cast<double>(i) / static_cast<double>(scenes.size()));
    if (auto varied = submissions::shuffled(scenes[i], *facts.seed, dialect))
      scenes[i] = std::move(*varied);
    else
      facts.unvaried.push_back(submissions::shown_name(scenes[i].name));
  }
  progress.clear();
  for (const std::string& scene : facts.unvaried)
    warn("--shuffle: " + scene + " is judged as it is: no variation of it shows the same faults");
  return facts;
}

/// The pictures that nobody judges, which is said.
std::vector<std::string> of_no_scene(const Options& options,
                                     const std::vector<submissions::Submission>& submissions,
                                     const std::vector<submissions::JudgedScene>& scenes) {
  constexpr std::size_t most_named = 5;
  const std::vector<std::string> all = submissions::pictures_of_no_scene(options.images, submissions, scenes);
  std::string named;
  for (std::size_t i = 0; i < std::min(most_named, all.size()); ++i)
    named += (i == 0 ? "" : ", ") + submissions::printable(all[i]);
  if (all.size() > most_named) named += " and " + std::to_string(all.size() - most_named) + " more";
  if (!all.empty())
    warn(
        "--images: not judged, for no scene has that name, or they lie beside directories, each of "
        "which is a submission: " +
        named);
  return all;
}

int exit_code_of(const std::vector<submissions::JudgedPicture>& all) {
  const auto any = [&](submissions::Judged verdict) {
    return std::any_of(all.begin(), all.end(), [&](const auto& p) { return p.verdict == verdict; });
  };
  if (any(submissions::Judged::trouble) || any(submissions::Judged::not_judged)) return exit_trouble;
  const auto is_right = [](const auto& p) { return p.verdict == submissions::Judged::right; };
  return std::all_of(all.begin(), all.end(), is_right) ? exit_agrees : exit_differs;
}

int run_judge(Options& options) {
  check_options(options);
  complete(options);
  submissions::JudgeOptions& judge = options.judge;
  const auto submissions = submissions_of(options);
  auto scenes = submissions::scenes_to_judge(options.scenes, judge.dialect);
  report::RunFacts facts = shuffle(options, judge.dialect, scenes);
  if (!judge.command.empty()) facts.not_enforced = submissions::limits_not_enforced();
  if (!facts.not_enforced.empty()) warn("judge: " + facts.not_enforced);
  if (!options.images.empty()) facts.of_no_scene = of_no_scene(options, submissions, scenes);
  const auto journal = open_journal(options.outputs);
  facts.journal = judge.journal = journal.get();
  const submissions::Interrupts interrupts;
  Progress progress("judging");
  bool is_well = true;
  judge.progress = [&](double fraction) { progress.show(fraction); };
  judge.stops = &submissions::Interrupts::came;
  judge.complain = [&](const std::string& what) {
    is_well = false;
    progress.clear();
    warn(what);
  };
  const auto all = submissions::judge_all(submissions, scenes, judge);
  progress.clear();
  print(options.outputs, all, facts);
  is_well &= write_all(options.outputs, all, facts, scenes);
  const int code = is_well ? exit_code_of(all) : exit_trouble;
  if (code != exit_trouble && journal) journal->remove();
  return code;
}

/// Nothing for what is negative or too large, which the parser would wrap.
std::optional<std::uint64_t> seed_of(const std::string& text) {
  std::uint64_t seed = 0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, seed);
  if (read.ec == std::errc() && read.ptr == end) return seed;
  return std::nullopt;
}

Table what_options(Options& options) {
  const auto complaint = [](const std::string& text) {
    return seed_of(text) ? "" : "found " + text + ", expected a whole number from 0 to 18446744073709551615";
  };
  return {{"--renderer",
           &options.confined.renderer,
           "the tracer and its arguments; {scene}, {image} and {submission} stand for paths; no shell "
           "reads it",
           {.value = "CMD"}},
          {"--submissions",
           &options.submissions,
           "a class: each entry of it is one {submission}",
           {.value = "DIR"}},
          {"--images",
           &options.images,
           "pictures only: DIR/SCENE.ppm, or DIR/SUBMISSION/SCENE.ppm",
           {.value = "DIR"}},
          {"--scenes", &options.scenes, "the scenes, *.sdf; default: plumb's own", {.value = "DIR"}},
          {"--shuffle",
           [&options](const std::string& text) { options.shuffle = seed_of(text); },
           "vary positions, sizes, colours and names in the scenes, the same for the same SEED, so that "
           "they show the same faults and nobody has seen their pictures",
           {.value = "SEED", .complaint = complaint}},
          {"--readable",
           &options.confined.readable,
           "what the tracer may read beside the system's directories and its own; plumb itself stays hidden "
           "there",
           {.value = "PATH"}}};
}

Table judge_options(submissions::JudgeOptions& judge) {
  return {{"--jobs", &judge.jobs, "pictures at once", {.shows_default = true, .range = within(1, 256)}},
          depth_option(judge.render.depth, "recursion depth of the right picture"),
          {"--tolerance",
           &judge.tolerance,
           "what pictures may be off by, as in plumb diagnose",
           {.value = "T", .range = within(0.0, 1.0)}},
          dialect_option(judge.dialect, nullptr)};
}

}  // namespace

Command judge_command() {
  auto options = std::make_shared<Options>();
  return {
      .name = "judge",
      .purpose = "Run other people's ray tracers, confined, and name the mistakes in their pictures.",
      .footer =
          "Example: plumb judge --renderer 'my-tracer {scene} {image}' --report report\n"
          "         plumb judge --renderer '{submission}/tracer {scene}' --submissions class --csv "
          "class.csv\n"
          "         plumb judge --images pictures --scenes tests/scenes\n"
          "The picture is {image}, or the file that the scene's render line names. Programs run in "
          "bubblewrap:\n"
          "no network, nothing to write but a /tmp of their own, homes hidden. What a program does is a "
          "result.\n"
          "Ctrl-C writes what is done; the same command goes on with the rest.\n"
          "Verdicts: right; right-apart from a few pixels; faults that are known; unexplained; wrong-size;\n"
          "no-image; unreadable; crashed; timed-out, too-much-cpu, too-much-memory, too-many-processes,\n"
          "too-much-output: stopped at a limit; trouble: ours, it says nothing about the submission; "
          "not-judged.\n"
          "Exit codes: 0 all pictures are right, 1 some are not, 2 trouble, or not all were judged.",
      .options =
          joined({what_options(*options), limit_options(options->confined, "seconds that a run may last"),
                  judge_output_options(options->outputs), judge_options(options->judge)}),
      .run = [options](auto&) { return run_judge(*options); }};
}

}  // namespace plumb::cli
