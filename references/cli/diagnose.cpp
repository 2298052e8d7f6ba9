#include "references/diagnosis/diagnosis.hpp"

#include <cstdio>
#include <memory>

#include "references/cli/commands.hpp"
#include "references/cli/diagnose_report.hpp"
#include "references/cli/options.hpp"
#include "references/cli/report.hpp"
#include "references/diagnosis/json.hpp"
#include "references/teaching/tell_apart.hpp"
#include "tracer/image/io.hpp"
#include "tracer/scene/reader.hpp"

namespace plumb::cli {
namespace {

constexpr int exit_abstains = 3;

struct Options {
  std::string scene;
  std::string image;
  std::string json;
  std::string report;
  int hint = 3;
  SceneOptions common;
};

std::string text_of(std::string_view view) { return std::string(view); }

std::vector<TellApart> scenes_that_tell_apart(const references::Diagnosis& diagnosis) {
  std::vector<TellApart> all;
  std::vector<references::teaching::Lesson> lessons;
  for (const references::FoundFault& found : diagnosis.faults) {
    if (found.alike.empty()) continue;
    if (lessons.empty()) lessons = references::teaching::lessons_in(PLUMB_SOURCE_DIRECTORY "/tests/scenes");
    std::vector<const references::Fault*> faults{found.fault};
    faults.insert(faults.end(), found.alike.begin(), found.alike.end());
    all.push_back({faults, references::teaching::scene_that_tells_apart(lessons, faults)});
  }
  return all;
}

Json to_json(const std::vector<TellApart>& tell_apart) {
  Json all = Json::array();
  for (const TellApart& group : tell_apart) {
    Json faults = Json::array();
    for (const references::Fault* fault : group.faults) faults.push_back(fault->id);
    all.push_back(
        {{"faults", faults}, {"scene", group.scene ? Json("tests/scenes/" + *group.scene) : Json()}});
  }
  return all;
}

Json to_json(const Options& options, const references::Diagnosis& diagnosis,
             const std::vector<TellApart>& tell_apart) {
  Json json{
      {"tool", "plumb"}, {"version", PLUMB_VERSION}, {"scene", options.scene}, {"image", options.image}};
  json.update(references::to_json(diagnosis, 3));
  json["tell_apart"] = to_json(tell_apart);
  return json;
}

/// 1 names the slide alone, 2 also what is wrong there, 3 the formula, too.
void print(const references::FoundFault& found, int hint) {
  const references::Fault& fault = *found.fault;
  if (hint == 1) {
    std::printf("  look at the slide \"%s\" (%zu pixels)\n", text_of(fault.slide).c_str(), found.pixels);
    return;
  }
  std::printf("  %s (slide \"%s\"; confidence %.2f, %zu pixels)\n", text_of(fault.explanation).c_str(),
              text_of(fault.slide).c_str(), found.confidence, found.pixels);
  if (hint == 2) return;
  std::printf("      id     %s\n      found  %s\n      right  %s\n", text_of(fault.id).c_str(),
              text_of(fault.wrong).c_str(), text_of(fault.right).c_str());
  for (const references::Fault* other : found.alike)
    std::printf("      or     %s: it gives the same picture here\n", text_of(other->id).c_str());
}

void print(const Options& options, const references::Diagnosis& d) {
  const double share = 100.0 * static_cast<double>(d.pixels_over) / static_cast<double>(d.pixels);
  switch (d.verdict) {
    case references::PictureVerdict::right:
      std::printf("%s: right (%s)", options.image.c_str(), d.encoding.in_words().c_str());
      break;
    case references::PictureVerdict::faults:
      std::printf("%s: %zu fault%s explain%s it (%s)\n", options.image.c_str(), d.faults.size(),
                  d.faults.size() == 1 ? "" : "s", d.faults.size() == 1 ? "s" : "",
                  d.encoding.in_words().c_str());
      for (const references::FoundFault& found : d.faults) print(found, options.hint);
      std::printf("remaining");
      break;
    case references::PictureVerdict::unexplained:
      std::printf("%s: no set of known faults explains it; is it a picture of this scene?\n",
                  options.image.c_str());
      std::printf("remaining");
      break;
  }
  std::printf("%s: %zu pixels (%.2f %%) more than 2/255 away, RMS %.2g\n",
              d.verdict == references::PictureVerdict::right ? "" : " with the best of them", d.pixels_over,
              share, d.rms);
}

/// Names of faults are for the third hint alone.
void print(const std::vector<TellApart>& tell_apart, int hint) {
  if (hint < 3) return;
  for (const TellApart& group : tell_apart) {
    std::printf("to tell apart");
    for (const references::Fault* fault : group.faults) std::printf(" %s", text_of(fault->id).c_str());
    std::printf(": %s\n", group.scene ? ("diagnose a picture of tests/scenes/" + *group.scene).c_str()
                                      : "no scene of plumb's does it");
  }
}

int exit_code_of(references::PictureVerdict verdict) {
  if (verdict == references::PictureVerdict::right) return exit_agrees;
  return verdict == references::PictureVerdict::faults ? exit_differs : exit_abstains;
}

int run_diagnose(const Options& options) {
  const Scene scene = load_scene(options.scene, dialect_of(options.common), warn);
  const ImageFile seen = read_image(options.image);
  const View view = view_of(scene, options.common);
  RenderJob job;
  job.width = seen.width;
  job.height = seen.height;
  job.options = render_options_of(options.common);
  const references::Diagnosis diagnosis = references::diagnose(scene, view.camera, job, seen);
  const bool is_asked = options.hint == 3 || !options.json.empty();
  const auto tell_apart = is_asked ? scenes_that_tell_apart(diagnosis) : std::vector<TellApart>{};
  if (options.json != "-") {
    print(options, diagnosis);
    print(tell_apart, options.hint);
  }
  if (!options.json.empty()) write_json(options.json, to_json(options, diagnosis, tell_apart));
  if (options.report.empty()) return exit_code_of(diagnosis.verdict);
  write_diagnosis(options.report, {options.image, scene, view.camera, job, seen, diagnosis, tell_apart},
                  options.hint);
  if (options.json != "-") std::printf("report: %s/diagnose.html\n", options.report.c_str());
  return exit_code_of(diagnosis.verdict);
}

}  // namespace

Command add_diagnose(CLI::App& plumb) {
  CLI::App* app = plumb.add_subcommand(
      "diagnose", "Find the mistakes in a ray tracer from the picture that it made of a scene.");
  auto options = std::make_shared<Options>();
  app->add_option("SCENE", options->scene, "scene file")->required();
  app->add_option("IMAGE", options->image, "the picture that the tracer made of it; it sets the size")
      ->required();
  app->add_option("--hint", options->hint, "how much is told: 1 the slide, 2 the mistake, 3 the formula, too")
      ->type_name("LEVEL")
      ->check(CLI::Range(1, 3))
      ->capture_default_str();
  app->add_option("--json", options->json, "write the result as JSON; - is standard output")
      ->type_name("FILE");
  app->add_option("--report", options->report,
                  "write a page with the pictures and each mistake to DIR/diagnose.html")
      ->type_name("DIR");
  add_scene_options(*app, options->common, false);
  app->footer(
      "Example: plumb diagnose tests/scenes/phong.sdf phong.ppm\n"
      "Exit codes: 0 the picture is right, 1 faults explain it, 2 trouble, 3 nothing explains it.");
  return {app, [options] { return run_diagnose(*options); }};
}

}  // namespace plumb::cli
