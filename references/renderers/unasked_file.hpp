// A file under a name that its user did not give: it takes no other's place.
#pragma once

#include <string>

#include "references/system/process.hpp"

namespace plumb::references {

/// What plumb put there itself is replaced, as long as nobody has changed it since; the cache's directory
/// keeps what tells that. All functions throw std::runtime_error, saying what to do.
class UnaskedFile {
 public:
  /// Throws, too, when a file that is not plumb's stands there.
  explicit UnaskedFile(const std::string& path);

  /// Where the file is to be written, beside its place.
  std::string aside() const;
  /// Not even a file that has come there meanwhile is replaced.
  void put_in_place() const;

 private:
  std::string path_;
  TemporaryDirectory directory_;
};

}  // namespace plumb::references
