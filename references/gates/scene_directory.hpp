// Finds the scenes of a directory and of those below it.
#pragma once

#include <string>
#include <vector>

namespace plumb::gates {

/// Returns where the baselines of a directory of scenes are: DIRECTORY/baselines, or in it a directory of the
/// variant's name.
std::string baselines_of(const std::string& directory, const std::string& variant = {});

/// Returns DIRECTORY/NAME.sdf.
std::string scene_path(const std::string& directory, const std::string& name);

/// Returns the NAME of each NAME.sdf, with the directories before it, e.g. "glass/lens"; sorted. Leaves out
/// hidden files and directories, and DIRECTORY/baselines. Follows a link to a directory unless its target has
/// been seen. Throws std::runtime_error when there is no such directory.
std::vector<std::string> scene_names(const std::string& directory);

/// Images of a variant and of a directory of scenes must not lie in one place. Throws std::invalid_argument
/// for a variant with an unusable name, and std::runtime_error when one of the scenes' directories has the
/// name of a variant.
void expect_clear_variant(const std::string& directory, const std::string& variant,
                          const std::vector<std::string>& names);

}  // namespace plumb::gates
