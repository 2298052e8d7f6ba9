// SHA-256 in hexadecimal, as sha256sum prints it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace plumb::system {

std::string sha256(std::string_view bytes);

/// Hashes the bytes of the values, as they lie in memory.
std::string sha256(const std::vector<float>& values);

}  // namespace plumb::system
