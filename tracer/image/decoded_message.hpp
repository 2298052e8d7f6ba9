// What the confined process says of the file that it decoded. The program checks this message.
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
  std::string why;  ///< empty when decoded
  std::int64_t width = 0;
  std::int64_t height = 0;  ///< both for a picture that is too large
  Shape shape;              ///< for one that is decoded
};

std::string text_of(const DecodedMessage& message);

/// Reads a message. Its writer is not trusted: returns nothing for what text_of() cannot have written.
std::optional<DecodedMessage> decoded_message(std::string_view text);

/// In bytes; a message is shorter.
inline constexpr std::size_t longest_message = std::size_t{1} << 20;

/// Returns what is written into the pipe until its end, or until longest_message is reached. Throws
/// std::system_error, ETIMEDOUT when the end does not come in time.
std::string read_to_end(int from, std::chrono::milliseconds patience);

}  // namespace plumb
