// Quotes words of command lines that are shown to be copied.
#pragma once

#include <string>

namespace plumb {

/// Returns the text as one word of a command line of sh, in quotes if it needs them.
std::string shell_word(const std::string& text);

}  // namespace plumb
