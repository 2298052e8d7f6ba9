// PFM and PPM, written by our own code, so that no image library need be loaded for them.
#pragma once

#include <cstdint>
#include <memory>

#include "tracer/image/row_writer.hpp"
#include "tracer/system/byte_sink.hpp"

namespace plumb {

/// Writes little-endian colour PFM. The format has the bottom row first, so it seeks. The file must outlive
/// it.
std::unique_ptr<RowWriter<float>> pfm_writer(ByteSink& file, int width, int height);

/// Writes the course framework's ASCII P3. The file must outlive it.
std::unique_ptr<RowWriter<std::uint8_t>> ppm_writer(ByteSink& file, int width, int height);

}  // namespace plumb
