// Lets pages that we write replace only pages of our own.
#pragma once

#include <string>

namespace plumb::report {

/// Stands in the head of every page of ours, by which it is known.
inline constexpr const char* generator_tag = "<meta name=\"generator\" content=\"plumb\">";

/// Throws std::runtime_error when a file that is no page of ours is there.
void refuse_to_replace_others(const std::string& page);

}  // namespace plumb::report
