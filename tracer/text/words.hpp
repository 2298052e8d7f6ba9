// Prepares words for messages: quotes them safely and finds the word that was probably meant.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plumb {

inline bool is_ascii(char c) { return static_cast<unsigned char>(c) < 0x80; }

/// The text for a message: quoted, at most 40 bytes, unprintable bytes as \xNN.
std::string in_quotes(std::string_view text);

/// Returns the candidate nearest to `name` by edit distance, or nothing when none is near enough to be a
/// slip.
std::optional<std::string> nearest_name(std::string_view name,
                                        const std::vector<std::string_view>& candidates);

}  // namespace plumb
