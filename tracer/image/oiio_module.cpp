#include "tracer/image/oiio_module.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstddef>

namespace plumb::oiio {
namespace {

namespace lib = OIIO;

lib::ImageSpec spec_for(const ImageFile& pixels, Depth depth) {
  lib::ImageSpec spec(pixels.width, pixels.height, pixels.channels, lib::TypeDesc::FLOAT);
  if (depth == Depth::bits16) spec.format = lib::TypeDesc::UINT16;
  spec.attribute("oiio:ColorSpace", "Linear");
  spec.attribute("compression", "zip");
  return spec;
}

Sample sample_of(const lib::TypeDesc& format) {
  if (format.basetype == lib::TypeDesc::UINT8 || format.basetype == lib::TypeDesc::INT8) return Sample::bits8;
  if (format.basetype == lib::TypeDesc::UINT16 || format.basetype == lib::TypeDesc::INT16)
    return Sample::bits16;
  return format.basetype == lib::TypeDesc::HALF ? Sample::half : Sample::float32;
}

}  // namespace
}  // namespace plumb::oiio

extern "C" {

// The symbols are only ever called through the types in oiio_module.hpp, by the same compiler.
#pragma GCC diagnostic push
#ifdef __clang__
#pragma GCC diagnostic ignored "-Wreturn-type-c-linkage"
#endif

std::string plumb_oiio_write(const std::string& name, const plumb::ImageFile& pixels,
                             plumb::oiio::Depth depth, std::string& bytes) {
  namespace lib = plumb::oiio::lib;
  const auto out = lib::ImageOutput::create(name);
  if (!out) return lib::geterror();
  std::vector<unsigned char> written;
  lib::Filesystem::IOVecOutput memory(written);
  if (!out->set_ioproxy(&memory)) return "this format cannot be written to memory";
  if (!out->open(name, plumb::oiio::spec_for(pixels, depth))) return out->geterror();
  if (!out->write_image(lib::TypeDesc::FLOAT, pixels.values.data())) return out->geterror();
  if (!out->close()) return out->geterror();
  bytes.assign(written.begin(), written.end());
  return {};
}

std::string plumb_oiio_read(const std::string& path, plumb::ImageFile& pixels) {
  const auto in = plumb::oiio::lib::ImageInput::open(path);
  if (!in) return plumb::oiio::lib::geterror();
  const auto& spec = in->spec();
  constexpr double most_values = 4.0 * (1 << 28);
  if (static_cast<double>(spec.width) * spec.height * spec.nchannels > most_values)
    return "its size is out of range";
  pixels.width = spec.width;
  pixels.height = spec.height;
  pixels.channels = spec.nchannels;
  pixels.sample = plumb::oiio::sample_of(spec.format);
  pixels.values.resize(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) *
                       static_cast<std::size_t>(spec.nchannels));
  if (!in->read_image(0, 0, 0, spec.nchannels, plumb::oiio::lib::TypeDesc::FLOAT, pixels.values.data())) {
    return in->geterror();
  }
  return {};
}

#pragma GCC diagnostic pop
}
