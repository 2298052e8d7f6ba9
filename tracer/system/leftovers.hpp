// Names what is temporary, and removes what killed runs have left of it.
#pragma once

#include <string>

namespace plumb {

/// Returns how a temporary name begins: with the namespace, the number and the start of this process. Random
/// letters and digits follow; a dot may precede it.
std::string temporary_name();

/// Keeps other processes from removing the temporary file or directory while the descriptor is open.
void claim_temporary(int descriptor);

/// Removes from the directory what temporary_name() named, this user owns and whose process is gone. Looks at
/// each directory once in a process. What cannot be removed stays.
void remove_leftovers(const std::string& directory);

}  // namespace plumb
