// Deflates what comes in pieces into a zlib stream (RFC 1950). The faster libdeflate needs all bytes at once.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <span>
#include <string>

namespace plumb::codecs {

/// Works at the fastest level.
class Deflater {
 public:
  Deflater();  ///< Throws std::bad_alloc.
  ~Deflater() { deflateEnd(&stream_); }
  Deflater(const Deflater&) = delete;
  Deflater& operator=(const Deflater&) = delete;

  /// Adds at most 4 GiB and appends what is deflated so far to `out`.
  void add(std::span<const std::uint8_t> bytes, std::string& out);
  /// Appends the rest and the checksum to `out`.
  void finish(std::string& out);

 private:
  void run(int flush, std::string& out);

  z_stream stream_{};
};

}  // namespace plumb::codecs
