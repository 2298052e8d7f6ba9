// Tells who runs this program.
#pragma once

#include <string>

namespace plumb::gates {

/// Returns git's user for work in this directory, as "Name <address>" or what there is of it: from
/// GIT_AUTHOR_NAME and GIT_AUTHOR_EMAIL, else from git's configuration. Without one, returns the name of the
/// login.
std::string author_in(const std::string& directory);

}  // namespace plumb::gates
