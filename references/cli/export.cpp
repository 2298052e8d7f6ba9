#include <algorithm>
#include <filesystem>
#include <memory>

#include "exporters/povray.hpp"
#include "references/cli/commands.hpp"
#include "references/cli/options.hpp"
#include "references/renderers/povray.hpp"
#include "tracer/format/reader.hpp"
#include "tracer/system/files.hpp"
#include "tracer/text/shell_word.hpp"

namespace plumb::cli {
namespace {

enum class Target { povray };
constexpr Word<Target> targets[] = {{"povray", Target::povray}};

struct Options {
  std::string scene;
  Target to = Target::povray;
  std::string file = "-";
  gates::PictureOptions picture;
};

/// A file for POV-Ray's command line, which wants a name with blanks in quotes of its own. A control
/// character would end the comment.
std::string word_for(const std::string& option, const std::string& file) {
  const bool is_plain =
      std::none_of(file.begin(), file.end(), [](unsigned char c) { return c < ' ' || c == '"'; });
  const std::string name = is_plain ? file : option == "+I" ? "scene.pov" : "scene.png";
  const bool has_blank = name.find(' ') != std::string::npos;
  return " " + shell_word(has_blank ? option + '"' + name + '"' : option + name);
}

/// How POV-Ray is run on the file, as verify runs it. The text that references are kept for begins behind it.
std::string head(const Options& options, const renderers::PovrayJob& job) {
  namespace fs = std::filesystem;
  const bool is_named = options.file != "-";
  const fs::path file = is_named ? fs::path(options.file) : fs::path(options.scene).stem() += ".pov";
  std::string line = "// povray";
  for (const std::string& argument : renderers::povray_arguments(job)) {
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
  const Scene scene = load_scene(options.scene, options.picture.dialect, warn);
  const Shot shot = shot_of(scene, options.picture);
  const auto exported = exporters::export_povray(shot);
  if (exported.needs_flat_objects)
    warn("the eye is inside glass, or surfaces coincide: run POV-Ray with -MB");
  const renderers::PovrayJob job{exported.text, shot.width, shot.height, exported.needs_flat_objects};
  write_file(options.file, head(options, job) + exported.text);
  return exit_agrees;
}

}  // namespace

Command export_command() {
  auto options = std::make_shared<Options>();
  return {.name = "export",
          .purpose = "Write the equivalent scene of a reference renderer.",
          .footer =
              "Example: plumb export tests/scenes/phong.sdf -o phong.pov\n"
              "The first line is a comment with the command that renders the file; the SHA-256 of the stored "
              "reference\n"
              "images is that of all lines behind it: plumb export SCENE | tail -n +2 | sha256sum",
          .options =
              joined({{{"SCENE", &options->scene, "scene file", {.is_required = true}},
                       {"--to", one_of(options->to, targets), "reference renderer", {.shows_default = true}},
                       {"-o,--output",
                        &options->file,
                        "file; - is standard output",
                        {.value = "FILE", .shows_default = true}}},
                      scene_options(options->picture)}),
          .run = [options](auto&) { return run_export(*options); }};
}

}  // namespace plumb::cli
