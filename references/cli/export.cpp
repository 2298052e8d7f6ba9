#include <memory>

#include "exporters/povray.hpp"
#include "references/cli/commands.hpp"
#include "references/cli/options.hpp"
#include "tracer/image/files.hpp"
#include "tracer/scene/reader.hpp"

namespace plumb::cli {
namespace {

struct Options {
  std::string scene;
  std::string to = "povray";
  std::string file = "-";
  SceneOptions common;
};

int run_export(const Options& options) {
  const Scene scene = load_scene(options.scene, dialect_of(options.common), warn);
  const View view = view_of(scene, options.common);
  const auto exported = exporters::export_povray(scene, view.camera, view.size.width, view.size.height,
                                                 render_options_of(options.common));
  if (exported.needs_flat_objects)
    warn("the eye is inside glass, or surfaces coincide: run POV-Ray with -MB");
  write_file(options.file, exported.text);
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
  app->footer("Example: plumb export tests/scenes/phong.sdf -o phong.pov");
  return {app, [options] { return run_export(*options); }};
}

}  // namespace plumb::cli
