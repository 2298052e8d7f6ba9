// SHA-256, as sha256sum prints it.
#pragma once

#include <string>
#include <string_view>

namespace plumb::references {

std::string sha256(std::string_view bytes);

}  // namespace plumb::references
