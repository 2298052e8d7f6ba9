// Reads the words of a Netpbm or PFM header, and values that are written as text.
#pragma once

#include <charconv>
#include <stdexcept>
#include <string>
#include <string_view>

#include "tracer/image/channel_names.hpp"

namespace plumb {

/// Splits bytes at white space and skips # comments. Errors are std::runtime_error that begin with `name`.
class NetpbmTokens {
 public:
  NetpbmTokens(std::string_view bytes, const std::string& name) : rest_(bytes), name_(name) {}

  std::string_view word();
  template <class Number>
  Number number() {
    const std::string_view text = word();
    const std::string_view digits = text.starts_with('+') && !text.starts_with("+-") ? text.substr(1) : text;
    Number value{};
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size())
      fail("found '" + printable(text.substr(0, 20)) + "', expected a number");
    return value;
  }
  /// Returns the next 0 or 1 of a bitmap. No white space need stand between two of them.
  bool bit();
  /// Returns what follows the single white space after the header: at least `size` bytes.
  std::string_view data(std::size_t size);
  /// Returns what is left, without white space around it.
  std::string_view rest() const;
  [[noreturn]] void fail(const std::string& why) const { throw std::runtime_error(name_ + ": " + why); }

 private:
  void skip_space();

  std::string_view rest_;
  const std::string& name_;
};

}  // namespace plumb
