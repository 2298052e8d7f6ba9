// The error for files that are damaged or cut short.
#pragma once

#include <stdexcept>
#include <string>

namespace plumb::codecs {

/// Throws std::runtime_error that names the path, what was found and what to do.
[[noreturn]] inline void refuse_damaged(const std::string& path, const std::string& found) {
  throw std::runtime_error(path + ": cannot be read, it is damaged or was cut short: " + found +
                           "; write it again, or copy it again from where it is whole");
}

}  // namespace plumb::codecs
