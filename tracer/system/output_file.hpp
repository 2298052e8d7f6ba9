// A file that is written piece by piece and seen only when it is whole.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "tracer/system/byte_sink.hpp"
#include "tracer/system/cleanup.hpp"
#include "tracer/system/descriptor.hpp"

namespace plumb {

/// Written aside, in the same directory, until commit() renames it. `-`, standard output, a device and a
/// pipe cannot be renamed to nor sought in: what they get is kept in memory until then. All functions throw
/// std::runtime_error naming the path and the cause.
class OutputFile final : public ByteSink {
 public:
  explicit OutputFile(const std::string& path);
  /// Without commit(), leaves the old file as it was.
  ~OutputFile() override;

  void write(std::string_view bytes) override;
  void seek(std::uint64_t position) override;
  /// Replaces the file, after the data are on disk.
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
