// Where plumb's own files lie: in an installation, beside a program that was moved, or in a build and its
// source.
#pragma once

#include <string>
#include <vector>

namespace plumb {

/// Directories of data that the program reads.
enum class Data {
  scenes,  ///< of the lecture: *.sdf, and TEACHING.md
  images,  ///< the stored reference images and their provenance
  chart    ///< the scripts that draw charts
};

/// The directory of the running program, without links.
std::string program_directory();

/// The source that this program was built from; it may be gone. The one place that knows it.
std::string source_directory();

/// The directory of these data: in $PLUMB_DATA when it is set, else in ../share/plumb beside the program,
/// else in the build's source. Throws std::runtime_error that names where it was looked for when there is
/// none.
std::string data_directory(Data data);

/// All directories that may hold data or modules of this program, whether they exist or not.
std::vector<std::string> own_places();

/// A module or a helper program: beside the program, else in ../lib/plumb, else along the program's run path.
/// The name itself when it is in none of them.
std::string module_path(const std::string& name);

}  // namespace plumb
