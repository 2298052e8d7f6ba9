// The bytes of a file, mapped into memory.
#pragma once

#include <string>
#include <string_view>

namespace plumb {

class MappedFile {
 public:
  /// Maps the file, and reads a pipe instead. Calls expect_cut_files(). Throws std::runtime_error naming the
  /// path and the cause, for a directory, too.
  explicit MappedFile(const std::string& path);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  /// They are valid while this object lives.
  std::string_view bytes() const { return bytes_; }

 private:
  std::string read_;
  std::string_view bytes_;
};

}  // namespace plumb
