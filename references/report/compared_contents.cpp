#include "references/report/compared_contents.hpp"

#include "tracer/image/channel_names.hpp"

namespace plumb::report {
namespace {

bool fills_its_display(const PixelRows& rows) {
  const auto& [w, d] = std::pair(rows.contents.window, rows.contents.display);
  return !w || !d || (w->x == d->x && w->y == d->y && w->width == d->width && w->height == d->height);
}

std::string line_of(const NamedRows& file) {
  std::string text = "compared     " + file.path + ": channels";
  for (const std::string& name : channels_of(file.rows)) text += " " + name;
  if (!file.rows.contents.part.empty()) text += " of part '" + file.rows.contents.part + "'";
  if (fills_its_display(file.rows)) return text + "\n";
  const Window w = window_of(file.rows);
  return text + " in the window (" + std::to_string(w.x) + "," + std::to_string(w.y) + "), " +
         std::to_string(w.width) + " x " + std::to_string(w.height) + " pixels\n";
}

bool is_usual(const PixelRows& rows) {
  return channels_of(rows) == usual_channels(rows.channels) && rows.contents.part.empty() &&
         fills_its_display(rows);
}

}  // namespace

std::vector<std::string> channels_of(const PixelRows& rows) {
  if (!rows.contents.channels.empty()) return rows.contents.channels;
  std::vector<std::string> names = usual_channels(rows.channels);
  for (int c = static_cast<int>(names.size()); c < rows.channels; ++c) names.push_back(std::to_string(c + 1));
  return names;
}

Window window_of(const PixelRows& rows) {
  return rows.contents.window.value_or(Window{0, 0, rows.width, rows.height});
}

std::vector<std::string> left_out(const NamedRows& reference, const NamedRows& test) {
  std::vector<std::string> all;
  for (const NamedRows* const file : {&reference, &test}) {
    for (const std::string& what : file->rows.contents.not_read) all.push_back(file->path + ": " + what);
  }
  return all;
}

std::string contents_text(const NamedRows& reference, const NamedRows& test) {
  std::string text;
  if (!is_usual(reference.rows) || !is_usual(test.rows)) text += line_of(reference) + line_of(test);
  for (const std::string& what : left_out(reference, test)) text += "NOT COMPARED " + what + "\n";
  return text;
}

}  // namespace plumb::report
