#include "references/system/json.hpp"

#include <nlohmann/json.hpp>

namespace plumb::system {
namespace {

template <class Json>
std::string replacing(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

nlohmann::ordered_json parse_ordered_json(std::string_view text) {
  return nlohmann::ordered_json::parse(text);
}
nlohmann::json parse_json(std::string_view text) { return nlohmann::json::parse(text); }

std::string json_text(const nlohmann::ordered_json& json, int indent) { return json.dump(indent); }
std::string json_text(const nlohmann::json& json, int indent) { return json.dump(indent); }

std::string json_text_of_any_bytes(const nlohmann::ordered_json& json, int indent) {
  return replacing(json, indent);
}
std::string json_text_of_any_bytes(const nlohmann::json& json, int indent) { return replacing(json, indent); }

std::string valid_utf8(const std::string& text) {
  return nlohmann::json::parse(replacing(nlohmann::json(text), -1)).get<std::string>();
}

}  // namespace plumb::system
