// Options that several commands share.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "references/cli/command_line.hpp"
#include "references/gates/picture_options.hpp"
#include "tracer/scene/scene.hpp"

namespace plumb::faults {
struct Fault;
}  // namespace plumb::faults

namespace plumb::cli {

/// A file that results go to, or - for standard output; `purpose` says what is written.
Option output_option(const std::string& name, std::string& file, const std::string& purpose);

/// --report DIR
Option report_option(std::string& directory);

/// --dialect; `name`, which may be null, becomes its text. `list` is what help adds of the dialects.
Option dialect_option(Dialect& dialect, std::string* name,
                      const std::string& list = ", see plumb lint --help");

/// --depth, 1 to the largest that POV-Ray knows; the other rules are given.
Option depth_option(int& depth, const std::string& purpose, Rules rules = {});

/// --size --camera --depth --glass-shadow --dialect
Table scene_options(gates::PictureOptions& picture);

/// --real --engine
Table tracer_options(gates::PictureOptions& picture);

/// --tolerance, finite and >= 0.
Option tolerance_option(double& tolerance);

/// --error, finite and > 0; the other rules are given.
Option error_option(double& error, const std::string& purpose, Rules rules);

/// --hint, 1 to 3.
Option hint_option(int& hint);

/// What was found instead of a finite number >= 0.
std::string complaint_about_size(const std::string& text);

/// The faults of these ids, joined by commas, in the order of the catalogue. Throws std::invalid_argument
/// naming the one that is unknown.
std::vector<const faults::Fault*> faults_named(const std::string& ids);

/// The options that change the picture and differ from the default, each with a blank before it, quoted for a
/// shell.
std::string picture_arguments(const gates::PictureOptions& options);

/// Those of plumb explain, which always traces in double by the textbook tracer.
std::string explain_arguments(gates::PictureOptions options);

/// Prints where the report was written; nothing when none was asked for.
void say_report(const std::string& directory);

/// Writes out what was printed. Throws std::runtime_error when standard output is full or gone.
void flush_output();

/// Prints a line on standard error.
void warn(const std::string& line);

}  // namespace plumb::cli
