// A file that is written piece by piece and seen only when it is complete.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "tracer/system/byte_sink.hpp"
#include "tracer/system/cleanup.hpp"
#include "tracer/system/descriptor.hpp"

namespace plumb {

/// Writes into a file aside, in the same directory, until commit() renames it. Standard output (`-`), a
/// device and a pipe can neither be renamed to nor sought in, so memory keeps their bytes until commit(). All
/// functions throw std::runtime_error naming the path and the cause.
class OutputFile final : public ByteSink {
 public:
  explicit OutputFile(const std::string& path);
  /// Without commit(), removes the file aside and leaves the old one as it was.
  ~OutputFile() override;

  void write(std::string_view bytes) override;
  void seek(std::uint64_t position) override;
  /// Replaces the file once the data are on disk, or writes what memory keeps.
  void commit();

 private:
  bool is_aside() const { return !aside_.empty(); }
  void keep(std::string_view bytes);
  void put_in_place();

  std::string path_, aside_;
  std::optional<RemovedOnSignal> on_signal_;
  std::optional<Descriptor> file_;  ///< none for standard output
  std::string kept_;
  std::uint64_t position_ = 0;
};

}  // namespace plumb
