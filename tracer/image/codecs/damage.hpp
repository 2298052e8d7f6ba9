// Files that are not whole.
#pragma once

#include <stdexcept>
#include <string>

namespace plumb::codecs {

/// Throws std::runtime_error: the path, what was found, what to do.
[[noreturn]] inline void refuse_damaged(const std::string& path, const std::string& found) {
  throw std::runtime_error(path + ": cannot be read, it is damaged or was cut short: " + found +
                           "; write it again, or copy it again from where it is whole");
}

}  // namespace plumb::codecs
