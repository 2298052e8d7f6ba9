// What other people named or printed, as text that every output can hold.
#pragma once

#include <string>

namespace plumb::references {

/// A file's name as valid UTF-8; two names are never shown alike. In a name that is no UTF-8, or that holds
/// "\x" itself, each backslash and each byte beyond ASCII is written \xNN.
std::string shown_name(const std::string& bytes);

/// What is no UTF-8 becomes U+FFFD.
std::string shown_text(const std::string& bytes);

/// Bytes that a terminal would obey become ?.
std::string printable(std::string text);

}  // namespace plumb::references
