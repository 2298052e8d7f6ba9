// Finds out which picture of one directory belongs to which of another.
#pragma once

#include <string>
#include <vector>

namespace plumb::gates {

/// True if an argument stands for several pictures: a directory, or a pattern with *, ? or [ that is no file.
bool names_several(const std::string& argument);

struct ImagePair {
  std::string name;       ///< path below the directory; with its extension only to tell files apart
  std::string reference;  ///< path; empty when it is missing
  std::string test;
  std::string trouble;  ///< why there is nothing to compare; empty for a pair
};

struct ImagePairs {
  std::string reference_directory;  ///< the pattern's part before its first wildcard, or the directory
  std::string test_directory;
  std::vector<ImagePair> pairs;     ///< sorted by name
  std::vector<std::string> others;  ///< files that are no images by name, and linked directories
};

/// Pairs pictures of equal path below both directories, in subdirectories, too. Paths may differ in the
/// extension where each side has one such file. Hidden files, bounds.json and `left_out` (paths) do not
/// count. Throws std::runtime_error when a side has no picture or cannot be read.
ImagePairs pair_images(const std::string& reference, const std::string& test,
                       const std::vector<std::string>& left_out);

/// Returns the part of the path before the first component with a wildcard; a directory itself.
std::string directory_of(const std::string& argument);

/// True if a file's name ends as that of a picture does, in capital letters, too.
bool is_image_name(const std::string& path);

}  // namespace plumb::gates
