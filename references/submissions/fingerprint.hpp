// Tells whether files are still what they were, without reading them.
#pragma once

#include <string>
#include <vector>

namespace plumb::submissions {

/// Returns a text of name, kind, size, inode and times of the file, and of all below it when it is a
/// directory, except what is left out. Of directories it holds kind and inode alone, because what is in them
/// is told. Links are not followed, and directories that we may not read are not entered. Equal texts mean
/// that nothing was changed in between. Throws std::runtime_error when there is no such file.
std::string fingerprint_of(const std::string& path, const std::vector<std::string>& left_out = {});

}  // namespace plumb::submissions
