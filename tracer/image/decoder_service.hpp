// Keeps plumb-decode running: this process starts it once, with the first file that needs it.
#pragma once

#include <sys/types.h>

#include <memory>
#include <mutex>

#include "tracer/image/decode_request.hpp"
#include "tracer/system/descriptor.hpp"

namespace plumb {

class DecoderService {
 public:
  /// Returns the only one of this process, which ends with the process.
  static DecoderService& shared();
  ~DecoderService();

  /// Hands a file to the decoder, from any thread. Starts a new decoder when the last one was killed. Throws
  /// std::system_error when none can be run.
  void hand_over(const DecodeRequest& request, const DecodeFiles& files);

 private:
  using Socket = std::shared_ptr<const Descriptor>;
  /// Returns the socket of a running decoder, but not `lost`.
  Socket running(const Socket& lost);
  /// Waits for the end of a decoder whose socket is closed, or that was killed.
  void wait();

  std::mutex mutex_;
  Socket socket_;
  pid_t process_ = -1;
};

}  // namespace plumb
