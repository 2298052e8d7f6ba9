// Keeps finished rows of a sweep, so that one that was broken off goes on where it was.
#pragma once

#include <string>

#include "references/studies/stability/atlas.hpp"

namespace plumb::studies::stability {

/// Each row is a file in a directory; all that determines the row is in the file's name.
class Kept {
 public:
  /// An empty directory keeps nothing.
  Kept(std::string directory, bool quick) : directory_(std::move(directory)), quick_(quick) {}

  /// Fills in what was measured. Returns false when it is not there or not readable.
  bool find(const std::string& condition, const std::string& renderer, Row& row) const;
  void keep(const std::string& condition, const std::string& renderer, const Row& row) const;

 private:
  std::string path(const std::string& condition, const std::string& renderer, const Row& row) const;

  std::string directory_;
  bool quick_;
};

}  // namespace plumb::studies::stability
