// Keeps the processes that the decoder makes, one for each file, until each has ended and that is reported.
#pragma once

#include <sys/types.h>

#include <functional>
#include <memory>
#include <vector>

#include "tracer/image/decode_request.hpp"
#include "tracer/system/descriptor.hpp"

namespace plumb::decoder {

/// Writes to each process' `status` pipe how it ended. Kills a process whose pipe nobody reads any more.
class Keeper {
 public:
  Keeper() = default;
  ~Keeper();  ///< Kills what is left.
  Keeper(const Keeper&) = delete;
  Keeper& operator=(const Keeper&) = delete;

  /// Runs the work in a process of its own. The files go to that process and are closed here.
  void run(const DecodeFiles& files, const std::function<void()>& work);
  /// Returns when there is something to read from the socket, or its other end is closed.
  void keep_until_readable(int socket);

 private:
  struct Kept {
    pid_t process;
    std::unique_ptr<Descriptor> handle;
    std::unique_ptr<Descriptor> status;
    bool is_killed = false;
  };
  static bool has_ended(const Kept& kept);

  std::vector<Kept> all_;
};

}  // namespace plumb::decoder
