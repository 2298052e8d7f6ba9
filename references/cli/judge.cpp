#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>

#include "references/cli/commands.hpp"
#include "references/cli/options.hpp"
#include "references/cli/progress.hpp"
#include "references/cli/report.hpp"
#include "references/judging/command_line.hpp"
#include "references/judging/judging.hpp"
#include "references/judging/overview.hpp"
#include "references/process.hpp"
#include "tracer/image/files.hpp"

namespace plumb::cli {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t mebibyte = std::size_t{1} << 20;

struct Options {
  std::string renderer, submissions, images, scenes;
  std::vector<std::string> readable;
  std::string report, json, csv, junit;
  std::size_t memory_mib = 2048, disk_mib = 64, processes = 64;
  double timeout = 10, cpu = 20;
  int jobs = 2;
  int hint = 3;
  std::optional<double> tolerance;
  SceneOptions common;
};

/// Programs run elsewhere, so what names a file from here does it from everywhere.
std::string absolute_if_file(const std::string& word) {
  if (word.starts_with("/") || word.find('{') != std::string::npos) return word;
  const bool is_path = word.find('/') != std::string::npos ? fs::exists(word) : fs::is_regular_file(word);
  return is_path ? fs::absolute(word).lexically_normal().string() : word;
}

std::vector<std::string> command_of(const std::string& renderer) {
  std::vector<std::string> command = references::split_command(renderer);
  for (std::string& word : command) word = absolute_if_file(word);
  std::string& program = command.front();
  if (program.find('{') != std::string::npos) return command;
  const std::string found =
      program.find('/') == std::string::npos ? references::find_program(program) : program;
  if (found.empty() || !fs::exists(found))
    throw std::invalid_argument("--renderer: found no program `" + program + "`");
  program = found;
  return command;
}

references::SandboxLimits limits_of(const Options& options) {
  references::SandboxLimits limits;
  limits.wall_seconds = options.timeout;
  limits.cpu_seconds = options.cpu;
  limits.memory_bytes = options.memory_mib * mebibyte;
  limits.disk_bytes = options.disk_mib * mebibyte;
  limits.processes = options.processes;
  return limits;
}

void set_command(const Options& options, references::JudgeOptions& judge) {
  judge.command = command_of(options.renderer);
  if (!references::mentions(judge.command, "scene"))
    throw std::invalid_argument("--renderer: found no {scene} in `" + options.renderer +
                                "`, expected e.g. 'my-tracer {scene} {image}'");
  if (references::mentions(judge.command, "submission") == options.submissions.empty())
    throw std::invalid_argument(
        "--submissions and {submission} in --renderer: expected both or neither; "
        "e.g. --renderer '{submission}/tracer {scene} {image}' --submissions class");
  if (!options.submissions.empty())
    judge.submissions_directory = fs::weakly_canonical(options.submissions).string();
}

references::JudgeOptions judge_options(const Options& options) {
  references::JudgeOptions judge;
  if (!options.renderer.empty()) set_command(options, judge);
  for (const std::string& path : options.readable) {
    if (!fs::exists(path)) throw std::invalid_argument("--readable: found no " + path);
    judge.readable.push_back(fs::canonical(path).string());
  }
  judge.limits = limits_of(options);
  judge.jobs = options.jobs;
  judge.keeps_pictures = !options.report.empty();
  judge.dialect = dialect_of(options.common);
  judge.render = render_options_of(options.common);
  judge.tolerance = options.tolerance;
  return judge;
}

std::vector<references::Submission> submissions_of(const Options& options) {
  if (!options.images.empty()) return references::pictures_in(options.images);
  if (!options.submissions.empty()) return references::submissions_in(options.submissions);
  return {{options.renderer, ""}};
}

/// Bytes that a terminal would obey become ?.
std::string printable(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < ' ' || c == 127; }, '?');
  return text;
}

void print(const references::JudgedPicture& picture, int hint) {
  std::string why = picture.message;
  if (picture.verdict == references::Judged::faults)
    for (const references::FoundFault& found : picture.diagnosis->faults)
      why += (why.empty() ? "" : "; ") + references::named(*found.fault, hint);
  std::printf("%-18s %s  %s  %s\n", to_string(picture.verdict), printable(picture.submission).c_str(),
              printable(picture.scene).c_str(), printable(why).c_str());
}

void check_outputs(const Options& options) {
  if (options.renderer.empty() == options.images.empty())
    throw std::invalid_argument("judge: --renderer or --images is required, and not both; see --help");
  const auto to_output = [](const std::string& file) { return file == "-" ? 1 : 0; };
  if (to_output(options.json) + to_output(options.csv) + to_output(options.junit) > 1)
    throw std::invalid_argument("--json, --csv, --junit: found - more than once, expected a FILE");
}

void write_results(const Options& options, const std::vector<references::JudgedPicture>& all) {
  if (!options.report.empty()) references::write_overview(options.report, all, options.hint);
  if (!options.csv.empty()) write_file(options.csv, references::overview_csv(all, options.hint));
  if (!options.junit.empty()) write_file(options.junit, references::overview_junit(all, options.hint));
  if (!options.json.empty()) write_json(options.json, references::overview_json(all, options.hint));
}

int run_judge(const Options& options) {
  check_outputs(options);
  references::JudgeOptions judge = judge_options(options);
  const auto submissions = submissions_of(options);
  const auto scenes = references::scenes_to_judge(options.scenes, judge.dialect);
  const std::string weaker = judge.command.empty() ? std::string() : references::limits_not_enforced();
  if (!weaker.empty()) std::fprintf(stderr, "judge: %s\n", weaker.c_str());
  Progress progress("judging");
  judge.progress = [&](double fraction) { progress.show(fraction); };
  const auto all = references::judge_all(submissions, scenes, judge);
  progress.clear();
  const auto right = std::count_if(all.begin(), all.end(),
                                   [](const auto& p) { return p.verdict == references::Judged::right; });
  if (options.json != "-" && options.csv != "-" && options.junit != "-") {
    for (const references::JudgedPicture& picture : all) print(picture, options.hint);
    std::printf("%zu submissions, %zu scenes: %td of %zu pictures are right\n", submissions.size(),
                scenes.size(), right, all.size());
    say_report(options.report);
  }
  write_results(options, all);
  return static_cast<std::size_t>(right) == all.size() ? exit_agrees : exit_differs;
}

void add_what(CLI::App& app, Options& options) {
  app.add_option("--renderer", options.renderer,
                 "the tracer and its arguments; {scene}, {image} and {submission} stand for paths; no shell "
                 "reads it")
      ->type_name("CMD");
  app.add_option("--submissions", options.submissions, "a class: each entry of it is one {submission}")
      ->type_name("DIR");
  app.add_option("--images", options.images, "pictures only: DIR/SCENE.ppm, or DIR/SUBMISSION/SCENE.ppm")
      ->type_name("DIR");
  app.add_option("--scenes", options.scenes, "the scenes, *.sdf; default: plumb's own")->type_name("DIR");
  app.add_option("--readable", options.readable,
                 "what the tracer may read beside the system's directories and its own")
      ->type_name("PATH");
}

void add_limits(CLI::App& app, Options& options) {
  app.add_option("--timeout", options.timeout, "seconds that a run may last")
      ->check(CLI::Range(0.1, 86400.0))
      ->capture_default_str();
  app.add_option("--cpu", options.cpu, "seconds of CPU time of all its processes")
      ->check(CLI::Range(0.1, 86400.0))
      ->capture_default_str();
  app.add_option("--memory", options.memory_mib, "MiB of all its processes")
      ->check(CLI::Range(16, 1 << 20))
      ->capture_default_str();
  app.add_option("--disk", options.disk_mib, "MiB of the files that it writes")
      ->check(CLI::Range(1, 1 << 20))
      ->capture_default_str();
  app.add_option("--processes", options.processes, "processes at once")
      ->check(CLI::Range(3, 10000))
      ->capture_default_str();
}

void add_outputs(CLI::App& app, Options& options) {
  app.add_option("--hint", options.hint, "how much is told: 1 the slide, 2 the mistake, 3 the formula, too")
      ->type_name("LEVEL")
      ->check(CLI::Range(1, 3))
      ->capture_default_str();
  app.add_option("--jobs", options.jobs, "pictures at once")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  app.add_option("--json", options.json, "write the results as JSON; - is standard output")
      ->type_name("FILE");
  app.add_option("--csv", options.csv, "write a line per picture; - is standard output")->type_name("FILE");
  app.add_option("--junit", options.junit, "write the results as JUnit XML; - is standard output")
      ->type_name("FILE");
  add_report(app, options.report);
}

}  // namespace

Command add_judge(CLI::App& plumb) {
  CLI::App* app = plumb.add_subcommand(
      "judge", "Run other people's ray tracers, confined, and name the mistakes in their pictures.");
  auto options = std::make_shared<Options>();
  add_what(*app, *options);
  add_limits(*app, *options);
  add_outputs(*app, *options);
  app->add_option("--depth", options->common.depth, "recursion depth of the right picture")
      ->check(CLI::Range(1, max_depth))
      ->capture_default_str();
  app->add_option("--tolerance", options->tolerance, "what pictures may be off by, as in plumb diagnose")
      ->type_name("T")
      ->check(CLI::Range(0.0, 1.0));
  add_dialect(*app, options->common, false);
  app->footer(
      "Example: plumb judge --renderer 'my-tracer {scene} {image}' --report report\n"
      "         plumb judge --renderer '{submission}/tracer {scene}' --submissions class --csv class.csv\n"
      "         plumb judge --images pictures --scenes tests/scenes\n"
      "The picture is {image}, or the file that the scene's render line names. Programs run in bubblewrap:\n"
      "no network, nothing to write but a /tmp of their own, homes hidden. What a program does is a result.\n"
      "Exit codes: 0 all pictures are right, 1 some are not, 2 trouble.");
  return {app, [options] { return run_judge(*options); }};
}

}  // namespace plumb::cli
