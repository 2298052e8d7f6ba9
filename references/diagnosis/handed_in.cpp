#include "references/diagnosis/handed_in.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "references/comparison/shape_mismatch.hpp"
#include "tracer/image/channel_names.hpp"

namespace plumb::diagnosis {
namespace {

std::string text_of(const Window& w) {
  return std::to_string(w.width) + " x " + std::to_string(w.height) + " pixels at (" + std::to_string(w.x) +
         ", " + std::to_string(w.y) + ")";
}

bool has_colours(const std::vector<std::string>& names) {
  if (names.empty()) return true;
  if (names.size() < 3) return channel_role(names.front()) == "Y";
  constexpr std::array<const char*, 3> roles{"R", "G", "B"};
  for (std::size_t c = 0; c < roles.size(); ++c) {
    if (channel_role(names[c]) != roles.at(c)) return false;
  }
  return true;
}

}  // namespace

std::optional<std::string> complaint_about_contents(const PixelRows& rows) {
  const FileContents& c = rows.contents;
  if (c.window && c.display && text_of(*c.window) != text_of(*c.display))
    return "found a data window of " + text_of(*c.window) + " in a display window of " + text_of(*c.display) +
           ", expected the whole picture: write one without a crop or a border";
  if (!has_colours(c.channels)) {
    std::string names;
    for (const std::string& name : c.channels) names += " " + name;
    return "found the channels" + names + ", expected R G B, or Y for grey";
  }
  if (std::any_of(c.are_whole.begin(), c.are_whole.end(), [](bool is_whole) { return is_whole; }))
    return "found whole numbers of 32 bits, of which nothing says what is white; expected 8 or 16 bits, or "
           "floats";
  return std::nullopt;
}

std::string not_looked_at(const PixelRows& rows) {
  std::string text;
  const auto add = [&](const std::string& what) { text += (text.empty() ? "" : ", ") + what; };
  const std::vector<std::string> names = comparison::names_of(rows);
  for (int c = rows.channels < 3 ? 1 : 3; c < rows.channels; ++c) {
    const auto place = static_cast<std::size_t>(c);
    const std::string name = place < names.size() ? names[place] : std::to_string(c + 1);
    if (channel_role(name) != "A" || !comparison::is_one_everywhere(rows, c)) add("channel " + name);
  }
  for (const std::string& what : rows.contents.not_read) add(what);
  return text;
}

}  // namespace plumb::diagnosis
