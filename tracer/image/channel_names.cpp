#include "tracer/image/channel_names.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <numeric>
#include <tuple>

namespace plumb {
namespace {

/// True if the last letter is the colour, as in LeR and albedo_r. RY is a colour of its own.
bool ends_in_colour(std::string_view name) {
  if (name.size() < 2 || std::string_view("RGBA").find(name.back()) == std::string_view::npos) return false;
  const auto before = static_cast<unsigned char>(name[name.size() - 2]);
  return std::islower(before) != 0 || std::isdigit(before) != 0 || before == '_';
}

std::string_view role_part(std::string_view name) {
  const std::size_t dot = name.rfind('.');
  if (dot != std::string_view::npos && dot + 1 < name.size()) return name.substr(dot + 1);
  return ends_in_colour(name) ? name.substr(name.size() - 1) : name;
}

int rank(const std::string& role, bool has_x) {
  constexpr std::string_view known = "RGBYA";
  if (role.size() != 1 || (role == "Y" && has_x)) return static_cast<int>(known.size());
  const std::size_t at = known.find(role[0]);
  return static_cast<int>(at == std::string_view::npos ? known.size() : at);
}

}  // namespace

std::vector<std::string> usual_channels(int count) {
  switch (count) {
    case 1:
      return {"Y"};
    case 2:
      return {"Y", "A"};
    case 3:
      return {"R", "G", "B"};
    case 4:
      return {"R", "G", "B", "A"};
    default:
      return {};
  }
}

std::string channel_role(std::string_view name) {
  std::string part(role_part(name));
  std::string lower = part;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr std::array words{std::pair{"red", "R"}, std::pair{"green", "G"}, std::pair{"blue", "B"},
                             std::pair{"alpha", "A"}};
  for (const auto& [word, role] : words) {
    if (lower == word || (lower.size() == 1 && lower[0] == word[0])) return role;
  }
  return lower == "y" ? "Y" : part;
}

std::string_view channel_layer(std::string_view name) {
  return name.substr(0, name.size() - role_part(name).size());
}

std::vector<std::size_t> channel_order(const std::vector<std::string>& names) {
  std::vector<std::size_t> order(names.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto first_of_layer = [&](std::size_t i) {
    const std::string_view layer = channel_layer(names[i]);
    if (layer.empty()) return std::ptrdiff_t{-1};
    return std::find_if(names.begin(), names.end(),
                        [&](const std::string& n) { return channel_layer(n) == layer; }) -
           names.begin();
  };
  const auto has_x = [&](std::string_view layer) {
    return std::any_of(names.begin(), names.end(), [&](const std::string& n) {
      return channel_layer(n) == layer && channel_role(n) == "X";
    });
  };
  std::vector<std::tuple<std::ptrdiff_t, int>> keys;
  for (std::size_t i = 0; i < names.size(); ++i)
    keys.emplace_back(first_of_layer(i), rank(channel_role(names[i]), has_x(channel_layer(names[i]))));
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return keys[a] < keys[b]; });
  return order;
}

std::string printable(std::string_view text) {
  std::string shown(text);
  for (char& c : shown) c = c >= ' ' && c <= '~' ? c : '?';
  return shown;
}

}  // namespace plumb
