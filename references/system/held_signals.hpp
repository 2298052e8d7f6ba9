// Makes signals wait until an exchange of files is complete.
#pragma once

#include <optional>

#include "references/system/signal_handlers.hpp"

namespace plumb::system {

/// While it lives, SIGINT, SIGTERM and SIGHUP are only remembered, whichever thread they reach. At the end of
/// its scope they act as they would have before. Only one may live at a time, and only for moments.
class HeldSignals {
 public:
  HeldSignals();
  ~HeldSignals();
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

 private:
  std::optional<SignalHandlers> handlers_;
};

}  // namespace plumb::system
