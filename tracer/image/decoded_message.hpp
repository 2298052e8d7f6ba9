// What the confined process says of the file that it decoded, in one message that the program checks.
#pragma once

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

}  // namespace plumb
