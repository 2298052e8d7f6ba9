// Renders a picture into its file. Memory never holds all of a huge one.
#pragma once

#include <cstdint>
#include <string>

#include "references/renderers/ours.hpp"
#include "tracer/image/encode.hpp"

namespace plumb::renderers {

/// When and how a picture is streamed: written band by band, while it is rendered.
struct Streaming {
  std::int64_t from_pixels;
  std::int64_t band_pixels;  ///< as many rows as have this number, or a row of tiles
};

/// Because at 4096 x 4096 streaming takes as long as holding the picture, in 100 MiB instead of 300 to 750.
/// Below that, a PNG of 8 bits keeps the bytes that libdeflate gives it, a quarter fewer. A band has 24 MiB
/// of floats; three are held, and the tiles of one are enough for any number of threads.
inline constexpr Streaming usual_streaming{std::int64_t{1} << 24, std::int64_t{1} << 21};

struct RenderedFile {
  bool is_of_one_colour = false;  ///< true if nothing is seen
  engine::Seconds write;          ///< time that was needed after the last row was rendered
};

/// Renders as render() does and writes as ImageWriter does. Nothing half-written is left, whatever ends it.
/// Throws what they throw.
RenderedFile render_to_file(OwnTracer tracer, const Scene& scene, const Camera& camera, const RenderJob& job,
                            const std::string& path, Encoding encoding, engine::Statistics* statistics,
                            const Streaming& streaming = usual_streaming);

}  // namespace plumb::renderers
