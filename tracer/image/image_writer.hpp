// A picture into its file, whole or in bands.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "tracer/image/encode.hpp"
#include "tracer/image/image.hpp"
#include "tracer/image/row_writer.hpp"
#include "tracer/system/output_file.hpp"

namespace plumb {

/// Writes PFM and PPM itself. PNG is 16 bits when linear, 8 otherwise; that of 16 bits and EXR (float, zip)
/// are written through OpenImageIO, which is loaded only then. `-` writes to standard output: PFM when
/// linear, else PPM. The file is the same byte for byte for all heights of bands, but for PNG of 8 bits: as
/// that is deflated by another library when it comes in several, its pixels are the same. All functions throw
/// std::runtime_error; nothing half-written is ever seen.
class ImageWriter {
 public:
  ImageWriter(const std::string& path, int width, int height, Encoding encoding);
  /// The rows below those before, all of the picture's width.
  void write(const Image& band);
  /// After the last row: puts the file in its place.
  void finish();

 private:
  OutputFile file_;
  Encoding encoding_;
  std::unique_ptr<RowWriter<float>> floats_;  ///< this one or the other
  std::unique_ptr<RowWriter<std::uint8_t>> bytes_;
};

}  // namespace plumb
