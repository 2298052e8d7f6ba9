// Writes a file under a name that its user did not give. It takes no other file's place.
#pragma once

#include <string>

#include "references/system/process.hpp"

namespace plumb::renderers {

/// Replaces what plumb put there itself, as long as nobody has changed it since; the cache's directory keeps
/// what tells that. All functions throw std::runtime_error, saying what to do.
class UnaskedFile {
 public:
  /// Throws, too, when a file that is not plumb's is there.
  explicit UnaskedFile(const std::string& path);

  /// Returns where the file is to be written, beside its place.
  std::string aside() const;
  /// Renames the file into its place. Does not even replace a file that has come there meanwhile.
  void put_in_place() const;

 private:
  std::string path_;
  system::TemporaryDirectory directory_;
};

}  // namespace plumb::renderers
