// A picture that someone's tracer made, read for a scene.
#pragma once

#include <string>
#include <vector>

#include "references/gates/picture_options.hpp"
#include "tracer/image/image_file.hpp"
#include "tracer/scene/shot.hpp"

namespace plumb::cli {

struct HandedInPicture {
  ImageFile seen;
  std::string not_looked_at;  ///< what a verdict does not speak of; empty when it is all
};

/// Reads a picture of the scene that `scene_file` names, and gives the shot its size. A picture of another
/// size that shows the same view is taken, with a warning. Throws std::invalid_argument for any other, and
/// for a file that holds no picture of a scene. Where the file has all of `channels`, these are the picture.
HandedInPicture handed_in_picture(const std::string& image, const std::string& scene_file,
                                  const gates::PictureOptions& options, Shot& shot,
                                  const std::vector<std::string>& channels = {});

}  // namespace plumb::cli
