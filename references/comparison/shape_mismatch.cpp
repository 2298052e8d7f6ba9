#include "references/comparison/shape_mismatch.hpp"

#include <algorithm>

#include "tracer/image/channel_names.hpp"

namespace plumb::comparison {

std::vector<std::string> names_of(const PixelRows& rows) {
  return rows.contents.channels.empty() ? usual_channels(rows.channels) : rows.contents.channels;
}

bool is_one_everywhere(const PixelRows& rows, int channel) {
  std::vector<float> row(rows.row_values());
  for (int y = 0; y < rows.height; ++y) {
    rows.copy_row(y, row.data());
    for (std::size_t i = static_cast<std::size_t>(channel); i < row.size();
         i += static_cast<std::size_t>(rows.channels)) {
      if (row[i] != 1) return false;
    }
  }
  return true;
}

namespace {

std::vector<std::string> roles_of(const PixelRows& rows) {
  std::vector<std::string> roles;
  for (const std::string& name : names_of(rows)) roles.push_back(channel_role(name));
  return roles;
}

bool has_alpha_last(const PixelRows& rows) {
  const std::vector<std::string> roles = roles_of(rows);
  return !roles.empty() && roles.back() == "A";
}

void leave_out_alpha(PixelRows& rows, const PixelRows& other) {
  if (rows.channels != other.channels + 1 || !has_alpha_last(rows) || has_alpha_last(other)) return;
  if (!is_one_everywhere(rows, rows.channels - 1)) return;
  std::vector<std::size_t> places;
  for (std::size_t c = 0; c + 1 < static_cast<std::size_t>(rows.channels); ++c) places.push_back(c);
  const std::string name = names_of(rows).back();
  rows = with_channels(rows, places);
  rows.contents.not_read.push_back("channel " + name + ", which is 1 everywhere; the other file has none");
}

std::string text_of(const Window& w) {
  return "(" + std::to_string(w.x) + "," + std::to_string(w.y) + ")-(" + std::to_string(w.x + w.width - 1) +
         "," + std::to_string(w.y + w.height - 1) + ")";
}

/// Describes the windows of a file whose pixels do not fill its display window, or lie beyond it.
std::string window_text(const std::string& whose, const PixelRows& rows) {
  const FileContents& c = rows.contents;
  if (!c.window || !c.display || text_of(*c.window) == text_of(*c.display)) return "";
  return "; with its data window " + whose + " covers " + text_of(*c.window) + ", its display window is " +
         text_of(*c.display);
}

std::string windows_text(const PixelRows& reference, const PixelRows& test) {
  return window_text("the test picture", test) + window_text("the reference", reference);
}

std::optional<std::string> size_mismatch(const PixelRows& reference, const PixelRows& test) {
  if (reference.width != test.width || reference.height != test.height) {
    if (reference.width == test.height && reference.height == test.width)
      return "width and height are swapped: the picture is transposed or turned by 90 degrees";
    return "render both in one size" + windows_text(reference, test);
  }
  const FileContents &r = reference.contents, &t = test.contents;
  if (!r.window || !r.display || !t.window || !t.display) return std::nullopt;
  const bool is_one_place = r.window->x - r.display->x == t.window->x - t.display->x &&
                            r.window->y - r.display->y == t.window->y - t.display->y;
  if (is_one_place) return std::nullopt;
  return "the data windows lie in different places" + windows_text(reference, test);
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : " ") + name;
  return text;
}

std::string described(const std::string& role, const std::string& name) {
  if (role == "A") return "an alpha channel" + (name == role ? "" : " (" + name + ")");
  if (role == "Z" || role == "depth") return "a depth channel (" + name + ")";
  return "a further channel (" + name + ")";
}

bool have_one_in_common(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  return std::any_of(a.begin(), a.end(),
                     [&](const std::string& name) { return std::find(b.begin(), b.end(), name) != b.end(); });
}

std::string in_both(const std::vector<std::string>& roles, const std::vector<std::string>& others) {
  std::string text;
  for (const std::string& role : others) {
    if (std::find(roles.begin(), roles.end(), role) != roles.end()) text += (text.empty() ? "" : ",") + role;
  }
  return text;
}

/// Names, for the message, the first channel of `more` that `less` lacks.
std::string surplus(const std::string& whose, const PixelRows& more, const PixelRows& less) {
  const std::vector<std::string> roles = roles_of(more), names = names_of(more), others = roles_of(less);
  if (!have_one_in_common(roles, others)) return "no channel of " + whose + " is in the other";
  for (std::size_t c = 0; c < roles.size(); ++c) {
    if (std::find(others.begin(), others.end(), roles[c]) != others.end()) continue;
    return whose + " has " + described(roles[c], names[c]) +
           ": write it without, or name the channels to compare (--channels " + in_both(roles, others) + ")";
  }
  return "write the same channels in both, or name those to compare (--channels)";
}

std::optional<std::string> channel_mismatch(const PixelRows& reference, const PixelRows& test) {
  const auto is = [&](int r, int t) { return reference.channels == r && test.channels == t; };
  if (is(3, 1)) return "the test picture is grey";
  if (is(1, 3)) return "the reference is grey";
  if (test.channels > reference.channels) return surplus("the test picture", test, reference);
  if (test.channels < reference.channels) return surplus("the reference", reference, test);
  // The name of a single channel does not matter, and a file that names none contradicts nothing.
  if (test.channels == 1 || reference.contents.channels.empty() || test.contents.channels.empty())
    return std::nullopt;
  if (roles_of(reference) == roles_of(test)) return std::nullopt;
  return "the channels of the test picture are " + listed(names_of(test)) + ", those of the reference " +
         listed(names_of(reference)) + ": " +
         (have_one_in_common(names_of(reference), names_of(test))
              ? "name those to compare that both have (--channels)"
              : "no name is in both; write the same channels in both, or in files that name none (.pfm)");
}

}  // namespace

void leave_out_opaque_alpha(PixelRows& reference, PixelRows& test) {
  if (reference.width != test.width || reference.height != test.height) return;
  leave_out_alpha(reference, test);
  leave_out_alpha(test, reference);
}

std::optional<std::string> shape_mismatch(const PixelRows& reference, const PixelRows& test) {
  if (auto mismatch = size_mismatch(reference, test)) return mismatch;
  return channel_mismatch(reference, test);
}

}  // namespace plumb::comparison
