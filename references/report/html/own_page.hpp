// Pages that we write take the place of our own alone.
#pragma once

#include <string>

namespace plumb::references {

/// In the head of every page of ours, by which it is known.
inline constexpr const char* generator_tag = "<meta name=\"generator\" content=\"plumb\">";

/// Throws std::runtime_error when a file is there that is no page of ours.
void refuse_to_replace_others(const std::string& page);

}  // namespace plumb::references
