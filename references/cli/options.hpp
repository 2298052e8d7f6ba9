// Options that several commands share.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "references/faults/fault.hpp"
#include "references/gates/verify.hpp"
#include "tracer/format/dialect.hpp"
#include "tracer/scene/render_options.hpp"
#include "tracer/scene/scene.hpp"

namespace plumb::cli {

/// Text of the options; turned into values by the functions below, which throw std::invalid_argument.
struct SceneOptions {
  std::string size;
  std::string camera;
  std::string dialect;
  std::string glass_shadow = "full";
  std::string real = "double";
  std::string engine = "engine";
  int depth = 8;
};

/// `describe` lists all dialects.
/// The faults of these ids, joined by commas, in the order of the catalogue. Throws std::invalid_argument
/// naming the one that is unknown.
std::vector<const references::Fault*> faults_named(const std::string& ids);

void add_dialect(CLI::App& app, SceneOptions& options, bool describe);
/// --size --camera --depth --dialect --glass-shadow
/// `has_size`: whether --size is among them.
void add_scene_options(CLI::App& app, SceneOptions& options, bool has_size = true);
void add_real(CLI::App& app, SceneOptions& options);

Dialect dialect_of(const SceneOptions& options);
RenderOptions render_options_of(const SceneOptions& options);
RealType real_of(const SceneOptions& options);
references::Renderer renderer_of(const SceneOptions& options);
std::optional<references::Size> size_of(const SceneOptions& options);

references::PictureOptions picture_options(const SceneOptions& options, double tolerance,
                                           bool keeps_pictures);

/// What to render of a scene: its own render line, unless the options say otherwise.
struct View {
  const Camera& camera;
  references::Size size;
};
View view_of(const Scene& scene, const SceneOptions& options);

/// The options that change the picture and differ from the default, each with a blank before it, quoted for a
/// shell.
std::string picture_arguments(const SceneOptions& options);

/// --report DIR
CLI::Option* add_report(CLI::App& app, std::string& directory);
/// Prints where the report was written; nothing when none was asked for.
void say_report(const std::string& directory);

/// --tolerance, finite and >= 0.
void add_tolerance(CLI::App& app, double& tolerance);

/// --error, finite and > 0.
CLI::Option* add_error(CLI::App& app, double& error, const std::string& description);

/// Writes out what was printed. Throws std::runtime_error when standard output is full or gone.
void flush_output();

/// Prints a line on standard error.
void warn(const std::string& line);

}  // namespace plumb::cli
