// Whether files are still what they were, told without reading them.
#pragma once

#include <string>

namespace plumb::references {

/// Name, kind, size, inode and times of the file, and of all below it when it is a directory; links are not
/// followed, and directories that we may not read are not entered. Equal texts mean that nothing was changed
/// in between. Throws std::runtime_error when there is no such file.
std::string fingerprint_of(const std::string& path);

}  // namespace plumb::references
