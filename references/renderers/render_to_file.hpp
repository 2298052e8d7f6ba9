// A picture rendered into its file; a huge one is never in memory as a whole.
#pragma once

#include <cstdint>
#include <string>

#include "references/renderers/ours.hpp"
#include "tracer/image/encode.hpp"

namespace plumb::references {

/// When and how a picture is streamed: written while it is rendered, band by band.
struct Streaming {
  std::int64_t from_pixels;
  std::int64_t band_pixels;  ///< as many rows as have so many, or a row of tiles
};

/// Because at 4096 x 4096 streaming takes as long as holding the picture, in 100 MiB for 300 to 750; below, a
/// PNG of 8 bits keeps the bytes that libdeflate gives it, a quarter fewer. A band is 24 MiB of floats: three
/// are held, and its tiles are enough for any number of threads.
inline constexpr Streaming usual_streaming{std::int64_t{1} << 24, std::int64_t{1} << 21};

struct RenderedFile {
  bool is_of_one_colour = false;  ///< nothing is seen
  engine::Seconds write;          ///< what was left to do when the last row was rendered
};

/// Renders as render() and writes as ImageWriter does it: nothing half-written is left, whatever ends it.
/// Throws what they throw.
RenderedFile render_to_file(OwnTracer tracer, const Scene& scene, const Camera& camera, const RenderJob& job,
                            const std::string& path, Encoding encoding, engine::Statistics* statistics,
                            const Streaming& streaming = usual_streaming);

}  // namespace plumb::references
