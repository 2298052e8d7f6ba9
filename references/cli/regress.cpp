#include "references/gates/regress.hpp"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <memory>
#include <optional>
#include <sstream>

#include "references/cli/bounds_options.hpp"
#include "references/cli/commands.hpp"
#include "references/cli/confined.hpp"
#include "references/cli/options.hpp"
#include "references/cli/progress.hpp"
#include "references/gates/approve.hpp"
#include "references/gates/author.hpp"
#include "references/report/junit.hpp"
#include "references/report/results_json.hpp"
#include "references/report/results_table.hpp"
#include "references/report/scene_report.hpp"
#include "references/report/sentences.hpp"
#include "tracer/system/files.hpp"
#include "tracer/text/shell_word.hpp"

namespace plumb::cli {
namespace {

using Json = nlohmann::ordered_json;
using gates::RegressedScene;
using gates::Status;

struct Options {
  std::string program;  ///< as it was called
  std::string directory;
  std::vector<std::string> update;
  bool all_new = false;
  std::string because;
  std::string json;
  std::string junit;
  std::string report;
  ConfinedOptions confined;
  gates::RegressOptions regress;
};

/// The options that an update has to repeat, each with a blank before it.
std::string update_arguments(const Options& options) {
  std::string text = picture_arguments(options.regress);
  const auto add = [&](const char* name, const auto& value, const auto& usual) {
    std::ostringstream stream;
    stream << value;
    if (value != usual) text += std::string(" ") + name + " " + shell_word(stream.str());
  };
  const Options usual{};
  add("--variant", options.regress.variant, usual.regress.variant);
  add("--renderer", options.confined.renderer, usual.confined.renderer);
  for (const std::string& path : options.confined.readable) text += " --readable " + shell_word(path);
  add("--timeout", options.confined.timeout, usual.confined.timeout);
  add("--cpu", options.confined.cpu, usual.confined.cpu);
  add("--memory", options.confined.memory_mib, usual.confined.memory_mib);
  add("--disk", options.confined.disk_mib, usual.confined.disk_mib);
  add("--processes", options.confined.processes, usual.confined.processes);
  return text;
}

/// The command that approves the scene as it looks now; empty when there is nothing to approve.
std::string approve_command(const Options& options, const RegressedScene& scene) {
  if (!scene.can_be_approved) return {};
  return shell_word(options.program) + " regress " + shell_word(options.directory) +
         update_arguments(options) + " --update " + shell_word(scene.result.scene) +
         (scene.result.status == Status::error ? " --because 'the scene is gone'"
                                               : " --because 'the new image is right'");
}

std::string with_command(const Options& options, const RegressedScene& scene) {
  const std::string command = approve_command(options, scene);
  return report::message_of(scene) + (command.empty() ? "" : "\napprove with: " + command);
}

void print_row(const Options& options, const RegressedScene& scene, std::size_t width) {
  std::printf("%s\n", report::table_row(scene.result, report::message_of(scene), width).c_str());
  // Not indented: a name may have a line feed, and the command is to be copied as it is.
  const std::string command = approve_command(options, scene);
  if (!command.empty()) std::printf("      approve with: %s\n", command.c_str());
  flush_output();
}

std::ptrdiff_t count(const std::vector<RegressedScene>& scenes, Status status) {
  return std::count_if(scenes.begin(), scenes.end(),
                       [&](const RegressedScene& s) { return s.result.status == status; });
}

Json to_json(const Options& options, const std::vector<RegressedScene>& scenes) {
  Json list = Json::array();
  for (const RegressedScene& scene : scenes) {
    list.push_back(report::scene_json(scene.result, report::message_of(scene)));
    if (scene.bounds) list.back()["bounds"] = report::to_json(scene.bounds->bounds, scene.bounds->comparison);
    list.back()["approve"] = approve_command(options, scene);
  }
  return {{"tool", "plumb"},
          {"version", PLUMB_VERSION},
          {"baselines", gates::baselines_of(options.directory, options.regress.variant)},
          {"tolerance", options.regress.tolerance},
          {"scenes", list}};
}

report::JunitCase junit_case(const Options& options, const RegressedScene& scene) {
  using Outcome = report::JunitCase::Outcome;
  const Status status = scene.result.status;
  const Outcome outcome = status == Status::agree    ? Outcome::passed
                          : status == Status::differ ? Outcome::failed
                                                     : Outcome::error;
  const std::string message = report::message_without_bounds(scene);
  const std::string of_passed = outcome == Outcome::passed ? report::message_of(scene) : "";
  return {scene.name,    outcome,  message.substr(0, message.find('\n')), with_command(options, scene),
          scene.seconds, of_passed};
}

std::string to_junit(const Options& options, const std::vector<RegressedScene>& scenes) {
  std::vector<report::JunitCase> cases;
  for (const RegressedScene& scene : scenes) cases.push_back(junit_case(options, scene));
  return report::junit_xml(options.directory, cases);
}

/// Each that is asked for, though the other cannot be written. Throws what the first of them throws.
void write_both(const Options& options, const Json& json, const std::string& junit) {
  std::exception_ptr trouble;
  try {
    if (!options.junit.empty()) write_file(options.junit, junit);
  } catch (const std::exception&) {
    trouble = std::current_exception();
  }
  if (!options.json.empty()) report::write_json(options.json, json);
  if (trouble) std::rethrow_exception(trouble);
}

/// An error that ends all stands in the files, too: there is no result of an earlier run in their place.
void write_trouble(const Options& options, const std::string& message) {
  const report::JunitCase junit{"plumb regress", report::JunitCase::Outcome::error,
                                message.substr(0, message.find('\n')), message, 0};
  const Json json{
      {"tool", "plumb"}, {"version", PLUMB_VERSION}, {"error", message}, {"scenes", Json::array()}};
  try {
    write_both(options, json, report::junit_xml(options.directory, {junit}));
  } catch (const std::exception& error) {
    warn(error.what());
  }
}

/// What no option says by itself. Throws what the readers of options throw.
void complete(Options& options, const Request& request) {
  request.read();
  options.regress.keeps_pictures = !options.report.empty();
  options.regress.bounds.limit.tolerance = options.regress.tolerance;
  if (options.confined.renderer.empty()) return;
  options.regress.other = std::make_shared<submissions::ConfinedRenderer>(options.confined.renderer,
                                                                          confined_command(options.confined));
}

/// Renders and compares all; prints a row of the table for each scene when it is done.
std::vector<RegressedScene> run(const Options& options, bool table) {
  const auto names = gates::scene_names(options.directory);
  std::vector<std::string> paths;
  for (const auto& name : names) paths.push_back(gates::scene_path(options.directory, name));
  const std::size_t width = report::name_width(paths);
  Progress progress("rendering " + options.directory);
  std::size_t done = 0;
  gates::RegressOptions regress = options.regress;
  regress.progress = [&](double fraction) {
    progress.show((static_cast<double>(done) + fraction) / static_cast<double>(names.size()));
  };
  if (table) std::printf("%s\n", report::table_head(width).c_str());
  report::SceneReport report(options.report, "plumb regress " + options.directory, options.regress.tolerance);
  std::optional<std::string> explain;
  if (options.confined.renderer.empty()) explain = explain_arguments(options.regress);
  const auto scenes = gates::regress(options.directory, regress, [&](const RegressedScene& scene) {
    ++done;
    progress.clear();
    if (table) print_row(options, scene, width);
    report.add(scene, explain, approve_command(options, scene));
  });
  report.finish();
  return scenes;
}

int check(Options& options, const Request& request) {
  if (options.json == "-" && options.junit == "-")
    throw std::invalid_argument("--json and --junit: found - for both, expected a FILE for one of them");
  const bool table = options.json != "-" && options.junit != "-";
  std::vector<RegressedScene> scenes;
  try {
    complete(options, request);
    scenes = run(options, table);
  } catch (const std::exception& error) {
    write_trouble(options, error.what());
    throw;
  }
  write_both(options, to_json(options, scenes), to_junit(options, scenes));
  const auto differ = count(scenes, Status::differ);
  const auto trouble = count(scenes, Status::error);
  if (table) {
    std::printf("%zu scene%s against %s: %td agree, %td differ, %td in trouble\n", scenes.size(),
                scenes.size() == 1 ? "" : "s",
                gates::baselines_of(options.directory, options.regress.variant).c_str(),
                count(scenes, Status::agree), differ, trouble);
    say_report(options.report);
  }
  if (trouble > 0) return exit_trouble;
  return differ > 0 ? exit_differs : exit_agrees;
}

void print_approved(const gates::Approved& scene) {
  if (scene.is_gone) {
    std::printf("forgotten %s\n", scene.name.c_str());
    return;
  }
  const std::string size = std::to_string(scene.width) + "x" + std::to_string(scene.height);
  if (scene.unchanged.empty())
    std::printf("approved %s %s\n", scene.name.c_str(), size.c_str());
  else
    std::printf("unchanged %s %s, %s\n", scene.name.c_str(), size.c_str(), scene.unchanged.c_str());
  if (!scene.not_stored.empty()) warn(scene.name + ": warning: " + scene.not_stored);
  if (scene.is_of_one_colour)
    warn(scene.name + ": warning: nothing is seen: every pixel has the same colour");
}

int update(Options& options, const Request& request) {
  if (options.update.empty() && !options.all_new) {
    throw std::invalid_argument(
        "--update: name the scenes whose images you approve; for all of them: --update " +
        shell_word(options.directory) + "/*.sdf; for those that have no baseline yet: --all-new");
  }
  if (options.because.find_first_not_of(" \t\r\n") == std::string::npos) {
    throw std::invalid_argument(
        "--update: say why the new image is right, it is kept beside it: --because 'the light was moved'");
  }
  complete(options, request);
  Progress progress("rendering " + options.directory);
  options.regress.progress = [&](double fraction) { progress.show(fraction); };
  const auto approved =
      gates::approve(options.directory, options.regress,
                     {options.update, options.all_new, options.because, gates::author_in(options.directory),
                      warn, picture_arguments(options.regress)});
  progress.clear();
  for (const gates::Approved& scene : approved) print_approved(scene);
  if (approved.empty()) std::printf("nothing is new: every scene has a baseline\n");
  return exit_agrees;
}

/// What asks plumb to render otherwise means nothing to another renderer.
Table without_renderer(Table options) {
  for (Option& each : options)
    if (each.names != "--dialect") each.rules.excludes.push_back("--renderer");
  return options;
}

Table update_options(Options& options) {
  return {{"DIR",
           &options.directory,
           "directory with the scenes, *.sdf, and those below it; the images are in DIR/baselines",
           {.is_required = true}},
          {"--update",
           &options.update,
           "approve: render these scenes (NAME, NAME.sdf or a path) and keep their images; a baseline whose "
           "scene is gone is forgotten",
           {.value = "SCENE", .may_be_alone = true}},
          {"--all-new",
           &options.all_new,
           "with --update: approve all scenes that have no baseline yet",
           {.needs = {"--update"}}},
          {"--because",
           &options.because,
           "why the new images are right; kept with who and when",
           {.value = "TEXT", .needs = {"--update"}}}};
}

Table output_options(Options& options) {
  return excluding("--update", {output_option("--junit", options.junit, "write the results as JUnit XML"),
                                output_option("--json", options.json, "write the results as JSON"),
                                report_option(options.report)});
}

}  // namespace

Command regress_command() {
  auto options = std::make_shared<Options>();
  gates::RegressOptions& regress = options->regress;
  return {
      .name = "regress",
      .purpose = "Render the scenes of a directory and compare them with the images approved for them.",
      .footer =
          "Example: plumb regress tests/scenes --junit results.xml\n"
          "         plumb regress tests/scenes --update phong shadow --because 'the light was moved'\n"
          "         plumb regress tests/scenes --update --all-new --because 'looked at'\n"
          "         plumb regress scenes --renderer 'my-tracer {scene} {image}' --tolerance 0.004\n"
          "No POV-Ray is run. A scene without a baseline differs; a baseline without its scene is trouble.\n"
          "DIR/baselines/bounds.json allows more for single scenes, each with its reason, e.g.\n"
          "{\"glass\": {\"allow_over\": \"0.1%\", \"ignore\": [\"0,0,64,16\"], \"because\": \"the clock is "
          "there\"}}\n"
          "Exit codes: 0 all agree, 1 some differ, 2 trouble.",
      .options = joined(
          {update_options(*options),
           output_options(*options),
           without_renderer(
               {{"--threads", &regress.threads, "threads; default: all", {.range = within(1, 1024)}}}),
           {{"--variant",
             &regress.variant,
             "a baseline per platform: those in DIR/baselines/NAME, the plain one where it has none; with "
             "--update: approve for this variant alone",
             {.value = "NAME"}},
            tolerance_option(regress.tolerance)},
           bounds_options(regress.bounds),
           without_renderer(joined({tracer_options(regress), scene_options(regress)})),
           confined_options(options->confined)}),
      .run =
          [options](const Request& request) {
            options->program = request.program_name;
            std::erase(options->update, "");  // which a lone --update gives
            return request.has("--update") ? update(*options, request) : check(*options, request);
          },
      .reads_itself = true};
}

}  // namespace plumb::cli
