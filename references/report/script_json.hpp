// JSON that comes from scenes, made harmless in a page.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace plumb::report {

/// JSON that may stand in a <script>: without <, >, &, U+2028 and U+2029. Invalid UTF-8 becomes U+FFFD.
std::string script_json(const nlohmann::ordered_json& json);

}  // namespace plumb::report
