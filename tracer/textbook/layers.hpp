// What a pixel's first ray meets, and the terms of its colour: the layers of a picture, for those who look
// for a mistake in their own tracer.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tracer/image/image_file.hpp"
#include "tracer/image/pixel_place.hpp"
#include "tracer/scene/render_job.hpp"
#include "tracer/scene/scene.hpp"
#include "tracer/textbook/formula_table.hpp"

namespace plumb::textbook {

/// All are in world space, and 0 where the first ray meets nothing, except `direction`. The terms `ambient`
/// to `refraction` add up to the colour of what is met.
enum class Layer {
  normal,      ///< n of unit length, facing the viewer
  depth,       ///< t, the length of the ray from the eye
  point,       ///< where the ray meets the surface
  object,      ///< number of the sphere or box, from 1, as a depth-first walk over the file meets them
  shadow,      ///< for each light, 1 where it is in front of the surface and hidden, 0 where it is not
  direction,   ///< d of the ray through the pixel's centre, of unit length
  ambient,     ///< Ia ka
  diffuse,     ///< the sum of Ip delta kd (n.l)
  specular,    ///< the sum of Ip delta ks (r.v)^m
  mirror,      ///< kr R, or what is totally reflected
  refraction,  ///< kt T
};

/// Returns the names of a layer's channels in a file, e.g. normal.X, normal.Y, normal.Z; shadow has one for
/// each light, counted from 1.
std::vector<std::string> channels_of(Layer layer, const Scene& scene);

/// Renders the picture and layers of it in double, one sample through each pixel centre. The channels are R,
/// G and B of the picture, then those of the layers in their order. Throws std::runtime_error on a scene that
/// cannot be traced, and for more than 2^28 values.
ImageFile render_layers(const Scene& scene, const Camera& camera, const RenderJob& job,
                        const std::vector<Layer>& layers);

/// Returns the same values for these pixels alone, interleaved, of a tracer with the formulas of this table.
std::vector<float> layers_at(const Scene& scene, const Camera& camera, const RenderJob& job,
                             const std::vector<Layer>& layers, const FormulaTable<double>& formulas,
                             const std::vector<PixelPlace>& places);

}  // namespace plumb::textbook
