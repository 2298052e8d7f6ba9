// Deflates what comes in pieces, into a zlib stream (RFC 1950); libdeflate, which is quicker, wants it whole.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <span>
#include <string>

namespace plumb::codecs {

/// At the quickest level.
class Deflater {
 public:
  Deflater();  ///< Throws std::bad_alloc.
  ~Deflater() { deflateEnd(&stream_); }
  Deflater(const Deflater&) = delete;
  Deflater& operator=(const Deflater&) = delete;

  /// At most 4 GiB; what is deflated so far is appended to `out`.
  void add(std::span<const std::uint8_t> bytes, std::string& out);
  /// The rest and the checksum.
  void finish(std::string& out);

 private:
  void run(int flush, std::string& out);

  z_stream stream_{};
};

}  // namespace plumb::codecs
