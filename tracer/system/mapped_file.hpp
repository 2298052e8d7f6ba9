// A file as it lies in memory, read by the operating system where it is looked at.
#pragma once

#include <string>
#include <string_view>

namespace plumb {

class MappedFile {
 public:
  /// A pipe is read instead. Throws std::runtime_error naming the path and the cause, a directory included.
  explicit MappedFile(const std::string& path);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::string_view bytes() const { return bytes_; }

 private:
  std::string read_;
  std::string_view bytes_;
};

}  // namespace plumb
