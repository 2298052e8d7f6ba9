// What is made for a time, and what runs that were killed left of it.
#pragma once

#include <string>

namespace plumb {

/// How the name of something temporary begins: it tells whose it is by the process, its start and its
/// namespace. Behind it come random letters and digits; before it may stand a dot.
std::string temporary_name();

/// Keeps others from removing it, for as long as the descriptor is open.
void claim_temporary(int descriptor);

/// Removes the files and directories of this user that temporary_name() named in the directory and whose
/// process is gone; looks at each directory once in a process. What cannot be removed stays.
void remove_leftovers(const std::string& directory);

}  // namespace plumb
