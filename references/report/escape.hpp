// Text that comes from scenes, made harmless in a page.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace plumb::references {

/// Stands in HTML, between tags or in a quoted attribute, as itself.
std::string html_escaped(std::string_view text);

/// JSON that may stand in a <script>: without <, >, &, U+2028 and U+2029. Invalid UTF-8 becomes U+FFFD.
std::string script_json(const nlohmann::ordered_json& json);

}  // namespace plumb::references
