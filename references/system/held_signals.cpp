#include "references/system/held_signals.hpp"

#include <atomic>

namespace plumb::system {
namespace {

std::array<std::atomic<bool>, ending_signals.size()> has_come;

void remember(int number) {
  for (std::size_t i = 0; i < has_come.size(); ++i)
    if (ending_signals.at(i) == number) has_come.at(i) = true;
}

}  // namespace

HeldSignals::HeldSignals() {
  for (std::atomic<bool>& one : has_come) one = false;
  handlers_.emplace(&remember);
}

HeldSignals::~HeldSignals() {
  handlers_.reset();
  for (std::size_t i = 0; i < has_come.size(); ++i)
    if (has_come.at(i)) ::raise(ending_signals.at(i));
}

}  // namespace plumb::system
