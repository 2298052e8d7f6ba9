#include "tracer/image/image_writer.hpp"

#include <stdexcept>

#include "tracer/image/codecs/codecs.hpp"
#include "tracer/image/codecs/png_writer.hpp"
#include "tracer/image/format.hpp"
#include "tracer/image/netpbm_writers.hpp"
#include "tracer/image/oiio_module.hpp"
#include "tracer/system/module.hpp"

namespace plumb {
namespace {

std::unique_ptr<RowWriter<std::uint8_t>> png_writer(ByteSink& file, int width, int height) {
  const auto make =
      reinterpret_cast<codecs::WritePng>(module_symbol(codecs::module_name, codecs::write_png_symbol));
  return make(file, width, height);
}

/// Makes a writer of linear colours: as floats, or as 16 bits.
std::unique_ptr<RowWriter<float>> oiio_writer(ByteSink& file, const std::string& path, int width,
                                              int height) {
  const auto make = reinterpret_cast<oiio::Write>(module_symbol(oiio::module_name, oiio::write_symbol));
  return make(file, path,
              {width,
               height,
               is_float_format(extension_of(path)) ? oiio::Depth::float32 : oiio::Depth::bits16,
               {"R", "G", "B"}});
}

const std::string& checked(const std::string& path, Encoding encoding) {
  if (const auto complaint = complaint_about(path, encoding))
    throw std::runtime_error(path + ": " + *complaint);
  return path;
}

}  // namespace

ImageWriter::ImageWriter(const std::string& path, int width, int height, Encoding encoding)
    : file_(checked(path, encoding)), encoding_(encoding) {
  const std::string extension = extension_of(path);
  if (extension == ".pfm" || (path == "-" && encoding == Encoding::linear)) {
    floats_ = pfm_writer(file_, width, height);
  } else if (extension == ".ppm" || path == "-") {
    bytes_ = ppm_writer(file_, width, height);
  } else if (encoding != Encoding::linear) {
    bytes_ = png_writer(file_, width, height);
  } else {
    floats_ = oiio_writer(file_, path, width, height);
  }
}

void ImageWriter::write(const Image& band) {
  if (floats_) return floats_->write(band.rgb);
  bytes_->write(encode_8_bits(band, encoding_));
}

void ImageWriter::finish() {
  if (floats_) floats_->finish();
  if (bytes_) bytes_->finish();
  file_.commit();
}

void write_channels(const std::string& path, const ImageFile& picture) {
  OutputFile file(path);
  const auto make = reinterpret_cast<oiio::Write>(module_symbol(oiio::module_name, oiio::write_symbol));
  const auto rows =
      make(file, path, {picture.width, picture.height, oiio::Depth::float32, picture.contents.channels});
  rows->write(picture.values);
  rows->finish();
  file.commit();
}

}  // namespace plumb
