// Owns the descriptor of an open file.
#pragma once

#include <unistd.h>

namespace plumb {

/// Closes the descriptor at the end of its scope. A negative number means that nothing is open.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }

 private:
  int number_;
};

}  // namespace plumb
