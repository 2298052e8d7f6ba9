// Words of command lines that are shown, to be copied.
#pragma once

#include <string>

namespace plumb {

/// A word of a command line of sh, in quotes where it needs them.
std::string shell_word(const std::string& text);

}  // namespace plumb
