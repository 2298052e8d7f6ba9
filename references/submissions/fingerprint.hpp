// Whether files are still what they were, told without reading them.
#pragma once

#include <string>
#include <vector>

namespace plumb::references {

/// Name, kind, size, inode and times of the file, and of all below it when it is a directory, but for what is
/// left out: of directories the kind and the inode alone, for what is in them is told. Links are not
/// followed, and directories that we may not read are not entered. Equal texts mean that nothing was changed
/// in between. Throws std::runtime_error when there is no such file.
std::string fingerprint_of(const std::string& path, const std::vector<std::string>& left_out = {});

}  // namespace plumb::references
