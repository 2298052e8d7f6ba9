// What the confined process says of the file that it decoded, in one message that the program checks.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

#include "tracer/image/canvas.hpp"

namespace plumb {

struct DecodedMessage {
  enum class Outcome { decoded, refused, too_large, other_decoder };
  Outcome outcome = Outcome::refused;
  std::string why;  ///< of all but `decoded`
  std::int64_t width = 0;
  std::int64_t height = 0;  ///< too large
  Shape shape;              ///< decoded
};

std::string text_of(const DecodedMessage& message);

/// Nothing for what text_of() does not write: whoever wrote it is not trusted.
std::optional<DecodedMessage> decoded_message(std::string_view text);

/// No message is so long, in bytes.
inline constexpr std::size_t longest_message = std::size_t{1} << 20;

/// What is written into the pipe until its end, or until it is that long. Throws
/// std::system_error (ETIMEDOUT) when its end does not come in time.
std::string read_to_end(int from, std::chrono::milliseconds patience);

}  // namespace plumb
