// JSON to text and back. The library's parser and writer cost seconds in each file that compiles them, so
// that this room's one file does.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace plumb::system {

/// Parse a complete text. Throw nlohmann::json::parse_error.
nlohmann::ordered_json parse_ordered_json(std::string_view text);
nlohmann::json parse_json(std::string_view text);

/// Write on one line (-1), or indented. Throw nlohmann::json::type_error where a string is not UTF-8.
std::string json_text(const nlohmann::ordered_json& json, int indent = -1);
std::string json_text(const nlohmann::json& json, int indent = -1);

/// Write the same, with U+FFFD for what is not UTF-8.
std::string json_text_of_any_bytes(const nlohmann::ordered_json& json, int indent = -1);
std::string json_text_of_any_bytes(const nlohmann::json& json, int indent = -1);

/// Returns the text with U+FFFD for what is not UTF-8.
std::string valid_utf8(const std::string& text);

}  // namespace plumb::system
