#include "references/cli/handed_in_picture.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <stdexcept>

#include "references/cli/options.hpp"
#include "references/diagnosis/handed_in.hpp"
#include "references/submissions/shown_text.hpp"
#include "tracer/image/io.hpp"

namespace plumb::cli {
namespace {

std::string size_text(int width, int height) { return std::to_string(width) + "x" + std::to_string(height); }

void check_size(const std::string& image, const std::string& scene_file, const gates::PictureOptions& options,
                const PixelRows& seen, const Shot& asked) {
  if (seen.width == asked.width && seen.height == asked.height) return;
  const std::string found = size_text(seen.width, seen.height), wanted = size_text(asked.width, asked.height);
  const bool is_scenes = !options.size;
  if (is_scenes && std::int64_t{seen.width} * asked.height == std::int64_t{seen.height} * asked.width)
    return warn(image + ": " + found + " pixels show the view of the " + wanted + " that " + scene_file +
                " asks for");
  throw std::invalid_argument(image + ": found " + found + " pixels, expected " + wanted +
                              (is_scenes ? " as " + scene_file + " asks for" : ", the --size") +
                              "; render it in " + wanted + ", or pass --size " + found +
                              " if the tracer was asked for that");
}

/// Returns the rows of these channels alone, if the file has them all.
std::optional<PixelRows> rows_of_channels(const PixelRows& rows, const std::vector<std::string>& channels) {
  std::vector<std::size_t> places;
  for (const std::string& channel : channels) {
    const auto found = std::ranges::find(rows.contents.channels, channel);
    if (found == rows.contents.channels.end()) return {};
    places.push_back(static_cast<std::size_t>(found - rows.contents.channels.begin()));
  }
  if (places.empty()) return {};
  return with_channels(rows, places);
}

}  // namespace

HandedInPicture handed_in_picture(const std::string& image, const std::string& scene_file,
                                  const gates::PictureOptions& options, Shot& shot,
                                  const std::vector<std::string>& channels) {
  const PixelRows rows = open_image(image);
  if (const auto named = rows_of_channels(rows, channels)) {
    check_size(image, scene_file, options, *named, shot);
    shot.width = named->width;
    shot.height = named->height;
    return {image_of(*named), {}};
  }
  if (const auto complaint = diagnosis::complaint_about_contents(rows))
    throw std::invalid_argument(image + ": " + submissions::printable(*complaint));
  check_size(image, scene_file, options, rows, shot);
  HandedInPicture picture{image_of(rows), submissions::printable(diagnosis::not_looked_at(rows))};
  if (!picture.not_looked_at.empty()) warn(image + ": not looked at: " + picture.not_looked_at);
  shot.width = picture.seen.width;
  shot.height = picture.seen.height;
  return picture;
}

}  // namespace plumb::cli
