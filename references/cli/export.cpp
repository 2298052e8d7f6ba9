#include <algorithm>
#include <filesystem>
#include <memory>

#include "exporters/povray.hpp"
#include "references/cli/commands.hpp"
#include "references/cli/options.hpp"
#include "references/gates/approve.hpp"
#include "references/renderers/povray.hpp"
#include "tracer/format/reader.hpp"
#include "tracer/system/files.hpp"

namespace plumb::cli {
namespace {

struct Options {
  std::string scene;
  std::string to = "povray";
  std::string file = "-";
  SceneOptions common;
};

/// A file for POV-Ray's command line, which wants a name with blanks in quotes of its own. A control
/// character would end the comment.
std::string word_for(const std::string& option, const std::string& file) {
  const bool is_plain =
      std::none_of(file.begin(), file.end(), [](unsigned char c) { return c < ' ' || c == '"'; });
  const std::string name = is_plain ? file : option == "+I" ? "scene.pov" : "scene.png";
  const bool has_blank = name.find(' ') != std::string::npos;
  return " " + references::shell_word(has_blank ? option + '"' + name + '"' : option + name);
}

/// How POV-Ray is run on the file, as verify runs it. The text that references are kept for begins behind it.
std::string head(const Options& options, const references::PovrayJob& job) {
  namespace fs = std::filesystem;
  const bool is_named = options.file != "-";
  const fs::path file = is_named ? fs::path(options.file) : fs::path(options.scene).stem() += ".pov";
  std::string line = "// povray";
  for (const std::string& argument : references::povray_arguments(job)) {
    if (argument == "+Iin.pov")
      line += word_for("+I", file.filename().string());
    else if (argument == "+Oout.png")
      line += word_for("+O", fs::path(file).replace_extension(".png").filename().string());
    else
      line += " " + argument;
  }
  return line + "\n";
}

int run_export(const Options& options) {
  const Scene scene = load_scene(options.scene, dialect_of(options.common), warn);
  const View view = view_of(scene, options.common);
  const auto exported = exporters::export_povray(scene, view.camera, view.size.width, view.size.height,
                                                 render_options_of(options.common));
  if (exported.needs_flat_objects)
    warn("the eye is inside glass, or surfaces coincide: run POV-Ray with -MB");
  const references::PovrayJob job{exported.text, view.size.width, view.size.height,
                                  exported.needs_flat_objects};
  write_file(options.file, head(options, job) + exported.text);
  return exit_agrees;
}

}  // namespace

Command add_export(CLI::App& plumb) {
  CLI::App* app = plumb.add_subcommand("export", "Write the equivalent scene of a reference renderer.");
  auto options = std::make_shared<Options>();
  app->add_option("SCENE", options->scene, "scene file")->required();
  app->add_option("--to", options->to, "reference renderer")
      ->check(CLI::IsMember({"povray"}))
      ->capture_default_str();
  app->add_option("-o,--output", options->file, "file; - is standard output")
      ->type_name("FILE")
      ->capture_default_str();
  add_scene_options(*app, options->common);
  app->footer(
      "Example: plumb export tests/scenes/phong.sdf -o phong.pov\n"
      "The first line is a comment with the command that renders the file; the SHA-256 of the stored "
      "reference\n"
      "images is that of all lines behind it: plumb export SCENE | tail -n +2 | sha256sum");
  return {app, [options] { return run_export(*options); }};
}

}  // namespace plumb::cli
