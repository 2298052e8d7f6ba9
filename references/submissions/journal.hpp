// Keeps results in a file as they come, one line of JSON each, so that an interrupted run goes on where it
// was.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "references/report/html/document.hpp"
#include "references/submissions/grade.hpp"
#include "tracer/system/descriptor.hpp"

namespace plumb::submissions {

/// All functions may be called from several threads at once.
class Journal {
 public:
  /// Opens the file, or makes it. Cuts off an incomplete last line, as a killed run leaves it. Throws
  /// std::runtime_error when the file is something else, cannot be written, or is another run's.
  explicit Journal(const std::string& path);

  /// Number of lines that were there when it was opened.
  std::size_t found() const { return found_; }
  const std::string& path() const { return path_; }

  /// Returns the result of that key, or nothing.
  std::optional<JudgedPicture> find(const std::string& key) const;

  /// Appends the result and its pictures, where there are any, and sets picture.kept. Throws
  /// std::runtime_error; then the file is as it was.
  void keep(const std::string& key, JudgedPicture& picture,
            const std::optional<report::html::ThreePictures>& pictures);

  /// The pictures of a result that find() or keep() has seen; nothing when none were kept.
  std::optional<report::html::ThreePictures> pictures_of(const JudgedPicture& picture) const;

  /// Removes the file, once all is done.
  void remove();

 private:
  void read_lines();
  void append(const std::string& line);
  std::string line_at(const KeptLine& line) const;

  std::string path_;
  Descriptor file_;
  std::uint64_t size_ = 0;
  std::size_t found_ = 0;
  std::map<std::string, KeptLine> lines_;
  mutable std::mutex mutex_;
};

}  // namespace plumb::submissions
