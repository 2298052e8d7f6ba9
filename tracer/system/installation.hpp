// Finds plumb's own files: in an installation, beside a program that was moved, or in a build and its source.
#pragma once

#include <string>
#include <vector>

namespace plumb {

/// Directories of data that the program reads.
enum class Data {
  scenes,  ///< scenes of the lecture, *.sdf, and TEACHING.md
  images,  ///< the stored reference images and their provenance
  chart    ///< the scripts that draw charts
};

/// Returns the directory of the running program, with links resolved.
std::string program_directory();

/// Returns the directory of the source that this program was built from; it may be gone. Nothing else knows
/// it.
std::string source_directory();

/// Returns the directory of these data: in $PLUMB_DATA when that is set, else in ../share/plumb beside the
/// program, else in the build's source. Throws std::runtime_error that names where it looked when there is
/// none.
std::string data_directory(Data data);

/// Returns all directories that may hold data or modules of this program, whether or not they exist.
std::vector<std::string> own_places();

/// Returns the path of a module or a helper program: beside the program, else in ../lib/plumb, else
/// (unchecked) in the directory of the modules on the run path. Returns the name itself when there is no such
/// directory.
std::string module_path(const std::string& name);

}  // namespace plumb
