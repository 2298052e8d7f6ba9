// Pictures of layers, to look at.
#pragma once

#include "tracer/image/encode.hpp"
#include "tracer/image/image.hpp"
#include "tracer/image/image_file.hpp"
#include "tracer/textbook/layers.hpp"

namespace plumb::report {

/// Returns what shows a layer: directions as v/2 + 1/2, depth from white (near) to black (far), a point
/// within the box of all points, a hue for each object, the share of the lights that are not hidden, and
/// colours as they are. Black is where the first ray meets nothing. `layers` holds those that were rendered,
/// in this order, after R, G and B.
Image picture_of(textbook::Layer layer, const ImageFile& rendered, const std::vector<textbook::Layer>& layers,
                 const Scene& scene);

/// Returns how it is written: colours by the sRGB curve, and what measures something by none.
Encoding encoding_of(textbook::Layer layer);

}  // namespace plumb::report
