// Shows what other people named or printed as text that every output can hold.
#pragma once

#include <string>

namespace plumb::submissions {

/// Returns a file's name as valid UTF-8; two names are never shown alike. In a name that is not UTF-8, or
/// that holds "\x" itself, each backslash and each byte beyond ASCII is written \xNN.
std::string shown_name(const std::string& bytes);

/// Returns the text with U+FFFD for what is not UTF-8.
std::string shown_text(const std::string& bytes);

/// Returns the text with ? for each byte that a terminal would obey.
std::string printable(std::string text);

}  // namespace plumb::submissions
