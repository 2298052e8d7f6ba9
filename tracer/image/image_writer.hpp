// Writes a picture into its file, at once or in bands.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "tracer/image/encode.hpp"
#include "tracer/image/image.hpp"
#include "tracer/image/image_file.hpp"
#include "tracer/image/row_writer.hpp"
#include "tracer/system/output_file.hpp"

namespace plumb {

/// PFM, PPM and PNG of 8 bits are written by our own code. A linear PNG has 16 bits; it and EXR (float, zip)
/// are written through OpenImageIO, which is loaded only then. `-` is standard output: PFM when linear, else
/// PPM. The file is the same byte for byte for all heights of bands, except PNG of 8 bits: another library
/// deflates it when it comes in several bands, and its pixels are the same. All functions throw
/// std::runtime_error. Nobody sees a half-written file.
class ImageWriter {
 public:
  ImageWriter(const std::string& path, int width, int height, Encoding encoding);
  /// Writes the rows below those before. The band is as wide as the picture.
  void write(const Image& band);
  /// After the last row: finishes the file and puts it in its place.
  void finish();

 private:
  OutputFile file_;
  Encoding encoding_;
  std::unique_ptr<RowWriter<float>> floats_;  ///< one of the two is null
  std::unique_ptr<RowWriter<std::uint8_t>> bytes_;
};

/// Writes an EXR of floats with as many channels as the picture has, under their names. Throws
/// std::runtime_error and then leaves nothing half-written.
void write_channels(const std::string& path, const ImageFile& picture);

}  // namespace plumb
