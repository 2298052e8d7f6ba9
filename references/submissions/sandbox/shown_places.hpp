// What a confined program sees of this machine: places that are named, instead of all but a list.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "references/submissions/sandbox/sandbox.hpp"

namespace plumb::submissions {

/// True if the path is the directory or lies in it. Both are absolute, without links.
bool lies_in(const std::filesystem::path& path, const std::filesystem::path& directory);

enum class PlaceKind {
  shown,   ///< as it is here, to be read only
  hidden,  ///< replaced by an empty directory or an empty file
  link,    ///< a symbolic link
  way,     ///< a directory that leads to others
  own      ///< the sandbox makes one of its own: /dev, /proc, /tmp
};

struct Place {
  std::string path;  ///< absolute, without links, without a slash at its end
  PlaceKind kind;
  std::string target;  ///< of a link
};

/// Returns the places. A directory comes before what lies in it, and the deeper of two places counts. What
/// changes nothing is left out, so that nothing is mounted over what is already right. Paths that do not
/// exist are left out, too. Throws std::runtime_error when a readable path is the sandbox's own directory.
std::vector<Place> places_of(const SandboxView& view);

}  // namespace plumb::submissions
