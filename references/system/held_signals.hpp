// Signals that have to wait until what is being exchanged is whole.
#pragma once

#include <optional>

#include "references/system/signal_handlers.hpp"

namespace plumb::references {

/// While it lives, SIGINT, SIGTERM and SIGHUP are remembered, whichever thread they reach; at the end of its
/// scope they act as they would have before. One at a time, and for moments alone.
class HeldSignals {
 public:
  HeldSignals();
  ~HeldSignals();
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

 private:
  std::optional<SignalHandlers> handlers_;
};

}  // namespace plumb::references
