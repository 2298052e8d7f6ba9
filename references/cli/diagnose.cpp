#include "references/diagnosis/diagnosis.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <memory>
#include <optional>

#include "references/cli/commands.hpp"
#include "references/cli/diagnose_case.hpp"
#include "references/cli/diagnose_layers.hpp"
#include "references/cli/handed_in_picture.hpp"
#include "references/cli/options.hpp"
#include "references/cli/told_fault.hpp"
#include "references/diagnosis/unseen.hpp"
#include "references/report/diagnosis_json.hpp"
#include "references/report/diagnosis_page.hpp"
#include "references/report/results_json.hpp"
#include "references/teaching/tell_apart.hpp"
#include "tracer/format/reader.hpp"
#include "tracer/system/installation.hpp"

namespace plumb::cli {
namespace {

using Json = nlohmann::ordered_json;
using report::TellApart;

struct Options {
  std::string scene;
  std::string image;
  std::string json;
  std::string report;
  std::vector<std::string> layers;
  std::string directory, scenes;  ///< of a case
  int hint = 3;
  std::optional<double> tolerance;
  gates::PictureOptions picture;
};

std::vector<TellApart> scenes_that_tell_apart(const diagnosis::Diagnosis& diagnosis) {
  std::vector<TellApart> all;
  std::vector<teaching::Lesson> lessons;
  for (const diagnosis::FoundFault& found : diagnosis.faults) {
    if (found.alike.empty()) continue;
    if (lessons.empty()) lessons = teaching::lessons_in(data_directory(Data::scenes));
    std::vector<const faults::Fault*> faults{found.fault};
    faults.insert(faults.end(), found.alike.begin(), found.alike.end());
    all.push_back({faults, teaching::scene_that_tells_apart(lessons, faults)});
  }
  return all;
}

Json to_json(const std::vector<TellApart>& tell_apart) {
  Json all = Json::array();
  for (const TellApart& group : tell_apart) {
    Json faults = Json::array();
    for (const faults::Fault* fault : group.faults) faults.push_back(fault->id);
    all.push_back(
        {{"faults", faults}, {"scene", group.scene ? Json("tests/scenes/" + *group.scene) : Json()}});
  }
  return all;
}

Json to_json(const Options& options, const diagnosis::Diagnosis& diagnosis,
             const std::vector<TellApart>& tell_apart, const std::string& not_looked_at) {
  Json json{
      {"tool", "plumb"}, {"version", PLUMB_VERSION}, {"scene", options.scene}, {"image", options.image}};
  json.update(report::to_json(diagnosis, options.hint));
  if (!not_looked_at.empty()) json["not_looked_at"] = not_looked_at;
  if (options.hint == 3) json["tell_apart"] = to_json(tell_apart);
  return json;
}

/// 1 names the slide alone, 2 also what is wrong there, 3 the formula, too.
void print(const diagnosis::FoundFault& found, int hint) {
  const faults::Fault& fault = *found.fault;
  const std::size_t others = found.alike.size();
  const std::string or_others =
      others == 0 || hint == 3 ? ""
      : others == 1            ? ", or another mistake, which gives the same picture here"
                    : ", or one of " + std::to_string(others) + " others, which give the same picture here";
  if (hint == 1) {
    std::printf("  look at the slide \"%s\" (%zu pixels)%s\n", text_of(fault.slide).c_str(), found.pixels,
                or_others.c_str());
    return;
  }
  std::printf("  %s (slide \"%s\"; confidence %.2f, %zu pixels)%s\n", text_of(fault.explanation).c_str(),
              text_of(fault.slide).c_str(), found.confidence, found.pixels, or_others.c_str());
  if (hint == 2) return;
  print_formulas(fault);
  constexpr std::size_t most_alike = 3;
  for (std::size_t i = 0; i < std::min(most_alike, found.alike.size()); ++i)
    std::printf("      or     %s: it gives the same picture here\n", text_of(found.alike[i]->id).c_str());
  if (found.alike.size() > most_alike)
    std::printf("      or     any of %zu more that --json lists\n", found.alike.size() - most_alike);
}

void print_remaining(const diagnosis::Diagnosis& d) {
  const double share = 100.0 * static_cast<double>(d.unexplained_pixels) / static_cast<double>(d.pixels);
  const char* const with = d.verdict == diagnosis::PictureVerdict::faults ? " with them" : "";
  std::printf("remaining%s: %zu pixels (%.2f %%) are not right, %zu of them more than 2/255 away, RMS %.2g\n",
              with, d.unexplained_pixels, share, d.pixels_over, d.rms);
  if (d.non_finite > 0) std::printf("not finite: %zu pixels\n", d.non_finite);
}

void print_faults(const Options& options, const diagnosis::Diagnosis& d) {
  const char* const plural = d.faults.size() == 1 ? "" : "s";
  const char* const verb = d.faults.size() == 1 ? "explains" : "explain";
  std::printf("%s: %zu fault%s %s %s (%s)\n", options.image.c_str(), d.faults.size(), plural, verb,
              d.explains_all() ? "it" : "a part of it", d.encoding.in_words().c_str());
  if (!d.explains_all())
    std::printf("  %zu of %zu pixels have another cause\n", d.unexplained_pixels, d.pixels);
  for (const diagnosis::FoundFault& found : d.faults) print(found, options.hint);
}

/// What is certain though not all is explained, and what is no mistake.
void print_certain(const diagnosis::Diagnosis& d) {
  if (d.certain.camera == diagnosis::Certainty::right) std::printf("camera: right\n");
  if (d.certain.shadows == diagnosis::Certainty::right) std::printf("shadows: right\n");
  if (d.certain.shading == diagnosis::Certainty::right) std::printf("shading: right\n");
  for (const diagnosis::Habit& habit : d.habits)
    std::printf("habit: %s (%.3g %.3g %.3g)\n", habit.title.c_str(), habit.value.r, habit.value.g,
                habit.value.b);
}

/// Of another scene are pictures in which hardly anything is right.
void print_unexplained(const Options& options, const diagnosis::Diagnosis& d) {
  const bool is_other = 2 * d.pixels_over > d.pixels && d.certain.camera == diagnosis::Certainty::unknown;
  const std::string why = d.is_of_one_colour ? std::string("; ") + diagnosis::one_colour_tells_nothing
                          : is_other         ? "; is it a picture of this scene?"
                                             : "";
  std::printf("%s: no set of known faults explains it%s\n", options.image.c_str(), why.c_str());
}

void print(const Options& options, const diagnosis::Diagnosis& d) {
  switch (d.verdict) {
    case diagnosis::PictureVerdict::right:
      std::printf("%s: right (%s)", options.image.c_str(), d.encoding.in_words().c_str());
      std::printf(d.edges == 0   ? "\n"
                  : d.edges == 1 ? ", 1 pixel of it proven to lie on an edge\n"
                                 : ", %zu pixels of it proven to lie on an edge\n",
                  d.edges);
      return;
    case diagnosis::PictureVerdict::right_apart:
      std::printf("%s: %s (%s)\n", options.image.c_str(), summary_of(d).c_str(),
                  d.encoding.in_words().c_str());
      break;
    case diagnosis::PictureVerdict::faults:
      print_faults(options, d);
      break;
    case diagnosis::PictureVerdict::unexplained:
      print_unexplained(options, d);
      break;
  }
  print_certain(d);
  print_remaining(d);
}

/// Names of faults are for the third hint alone.
void print(const std::vector<TellApart>& tell_apart, int hint) {
  if (hint < 3) return;
  for (const TellApart& group : tell_apart) {
    std::printf("to tell apart");
    for (const faults::Fault* fault : group.faults) std::printf(" %s", text_of(fault->id).c_str());
    std::printf(": %s\n", group.scene ? ("diagnose a picture of tests/scenes/" + *group.scene).c_str()
                                      : "no scene of plumb's does it");
  }
}

void print(const diagnosis::UnseenFaults& unseen) {
  std::string scenes;
  for (const std::string& scene : unseen.shown_by) scenes += (scenes.empty() ? "" : ", ") + scene;
  std::printf("unseen: %zu of %zu known faults would change none of %zu pixels here%s\n",
              unseen.faults.size(), faults::fault_catalogue().size(), unseen.pixels,
              scenes.empty() ? "" : ("; of tests/scenes, these show more of them: " + scenes).c_str());
}

Json to_json(const diagnosis::UnseenFaults& unseen) {
  return {{"faults", report::ids_json(unseen.faults)},
          {"of", faults::fault_catalogue().size()},
          {"pixels", unseen.pixels},
          {"scenes", unseen.shown_by}};
}

int exit_code_of(const diagnosis::Diagnosis& diagnosis) {
  if (diagnosis.verdict == diagnosis::PictureVerdict::right) return exit_agrees;
  return diagnosis.tells_something() ? exit_differs : exit_abstains;
}

bool begins_like_a_picture(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string magic(4, '\0');
  file.read(magic.data(), static_cast<std::streamsize>(magic.size()));
  const auto begins = [&](std::string_view with) { return std::string_view(magic).starts_with(with); };
  const bool is_netpbm =
      magic[0] == 'P' && std::string_view("123456fF").find(magic[1]) != std::string_view::npos;
  return is_netpbm || begins("\x89PNG") || begins("\x76\x2f\x31\x01") || begins("II*") || begins("MM") ||
         begins("\xff\xd8") || begins("BM") || begins("#?");
}

/// Throws when a picture stands where the scene is expected, and the other file is none.
void check_order(const Options& options) {
  if (options.image.empty() || !begins_like_a_picture(options.scene) || begins_like_a_picture(options.image))
    return;
  throw std::invalid_argument("diagnose: found the picture " + options.scene +
                              " before the scene, expected plumb diagnose " + options.image + " " +
                              options.scene);
}

/// Without a picture.
int run_on_layers(const Options& options, const Scene& scene) {
  if (!options.report.empty())
    throw std::invalid_argument("--report: found no IMAGE, expected the picture that the page is to show");
  const auto layers = diagnosed_layers(options.layers, scene, options.scene, options.picture);
  if (options.json != "-")
    for (const DiagnosedLayer& layer : layers) print(layer, options.hint);
  if (!options.json.empty()) {
    report::write_json(options.json, {{"tool", "plumb"},
                                      {"version", PLUMB_VERSION},
                                      {"scene", options.scene},
                                      {"image", nullptr},
                                      {"layers", to_json(layers, options.hint)}});
  }
  return exit_code_of(layers);
}

int run_diagnose(const Options& options) {
  if (!options.directory.empty())
    return diagnose_case(
        {options.directory, options.scenes, options.json, options.hint, options.tolerance, options.picture});
  if (options.scene.empty())
    throw std::invalid_argument("diagnose: SCENE and IMAGE are required, or --case DIR; see --help");
  check_order(options);
  const Scene scene = load_scene(options.scene, options.picture.dialect, warn);
  if (options.image.empty() && options.layers.empty())
    throw std::invalid_argument(
        "diagnose: found no picture, expected IMAGE, or --layer NAME=FILE; e.g. plumb diagnose " +
        options.scene + " picture.ppm");
  if (options.image.empty()) return run_on_layers(options, scene);
  const auto layers = diagnosed_layers(options.layers, scene, options.scene, options.picture);
  Shot shot = shot_of(scene, options.picture);
  const auto [seen, not_looked_at] = handed_in_picture(options.image, options.scene, options.picture, shot);
  const diagnosis::Diagnosis diagnosis =
      diagnosis::diagnose(scene, shot.camera, job_of(shot), seen, options.tolerance);
  const auto tell_apart = options.hint == 3 ? scenes_that_tell_apart(diagnosis) : std::vector<TellApart>{};
  std::optional<diagnosis::UnseenFaults> unseen;
  if (diagnosis.verdict == diagnosis::PictureVerdict::right) unseen = diagnosis::unseen_faults(shot, seen);
  if (options.json != "-") {
    print(options, diagnosis);
    if (unseen) print(*unseen);
    print(tell_apart, options.hint);
    for (const DiagnosedLayer& layer : layers) print(layer, options.hint);
  }
  if (!options.json.empty()) {
    Json json = to_json(options, diagnosis, tell_apart, not_looked_at);
    if (unseen) json["unseen"] = to_json(*unseen);
    if (!layers.empty()) json["layers"] = to_json(layers, options.hint);
    report::write_json(options.json, json);
  }
  if (options.report.empty()) return exit_code_of(diagnosis);
  report::write_diagnosis(options.report, {options.image, shot, seen, diagnosis, tell_apart, not_looked_at},
                          options.hint);
  if (options.json != "-") std::printf("report: %s/diagnose.html\n", options.report.c_str());
  return exit_code_of(diagnosis);
}

}  // namespace

Command diagnose_command() {
  auto options = std::make_shared<Options>();
  return {
      .name = "diagnose",
      .purpose = "Find the mistakes in a ray tracer from the picture that it made of a scene.",
      .footer =
          "Example: plumb diagnose tests/scenes/phong.sdf phong.ppm\n"
          "Example: plumb diagnose tests/scenes/phong.sdf --layer normal=normals.ppm\n"
          "Example: plumb diagnose --case my-pictures --scenes tests/scenes\n"
          "Right is a picture of which every pixel is within what its file can hold, or proven to lie on an "
          "edge.\n"
          "Exit codes: 0 the picture is right; 1 faults explain it, or a part, or it is right apart from a "
          "few\n"
          "pixels, or a part is certain, e.g. the camera; 2 trouble; 3 nothing is certain.",
      .options = joined(
          {{{"SCENE", &options->scene, "scene file"},
            {"IMAGE", &options->image, "the picture that the tracer made of it"},
            handed_in_layers_option(options->layers),
            {"--case",
             &options->directory,
             "directory with the pictures that one tracer made of several scenes, each named as its scene: "
             "one set of faults explains all, and what one scene cannot tell another can",
             {.value = "DIR", .excludes = {"SCENE", "IMAGE", "--layer", "--report", "--size", "--camera"}}},
            {"--scenes",
             &options->scenes,
             "where the scenes of --case are. Default: beside the pictures, else plumb's own",
             {.value = "DIR", .needs = {"--case"}}},
            hint_option(options->hint),
            {"--tolerance",
             &options->tolerance,
             "what a colour of a picture of floats may be off by, relative above 1 (without it 1e-6, or "
             "what float32 is off by there, measured); by how much more, in shares of 1, the levels of "
             "integers may be off (without it by none)",
             {.value = "T", .range = within(0.0, 1.0)}},
            output_option("--json", options->json, "write the result as JSON"),
            {"--report",
             &options->report,
             "write a page with the pictures and each mistake to DIR/diagnose.html",
             {.value = "DIR"}}},
           scene_options(options->picture)}),
      .run = [options](auto&) { return run_diagnose(*options); }};
}

}  // namespace plumb::cli
