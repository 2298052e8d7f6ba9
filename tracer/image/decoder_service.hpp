// plumb-decode as this process keeps it: started with the first file that needs it, and once for all.
#pragma once

#include <sys/types.h>

#include <memory>
#include <mutex>

#include "tracer/image/decode_request.hpp"
#include "tracer/system/descriptor.hpp"

namespace plumb {

class DecoderService {
 public:
  /// The one of this process. It ends with it.
  static DecoderService& shared();
  ~DecoderService();

  /// Of any thread. A new decoder is started when the last was killed. Throws std::system_error when none
  /// can be run.
  void hand_over(const DecodeRequest& request, const DecodeFiles& files);

 private:
  using Socket = std::shared_ptr<const Descriptor>;
  /// Another one than `lost`.
  Socket running(const Socket& lost);
  /// Of a process whose socket is closed, or that was killed.
  void wait();

  std::mutex mutex_;
  Socket socket_;
  pid_t process_ = -1;
};

}  // namespace plumb
