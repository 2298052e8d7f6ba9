#include "tracer/image/oiio_module.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstddef>
#include <exception>
#include <stdexcept>

#include "tracer/image/channel_names.hpp"

namespace plumb::oiio {
namespace {

namespace lib = OIIO;

lib::ImageSpec spec_for(const Layout& layout) {
  lib::ImageSpec spec(layout.width, layout.height, static_cast<int>(layout.channels.size()),
                      lib::TypeDesc::FLOAT);
  spec.channelnames = layout.channels;
  if (layout.depth == Depth::bits16) spec.format = lib::TypeDesc::UINT16;
  spec.attribute("oiio:ColorSpace", "Linear");
  spec.attribute("compression", "zip");
  // A date of a type that EXR does not know is left out; without any, the time of day would be written.
  spec.attribute("DateTime", 0);
  return spec;
}

/// Passes on to the file what OpenImageIO writes. OpenImageIO does not notice a full disk, and its codecs in
/// C let no exception through, so a failure is kept for rethrow().
class Proxy final : public lib::Filesystem::IOProxy {
 public:
  explicit Proxy(ByteSink& file) : IOProxy("", Write), file_(file) {}
  const char* proxytype() const override { return "plumb"; }
  size_t write(const void* bytes, size_t size) override {
    const bool is_written = tried([&] { file_.write({static_cast<const char*>(bytes), size}); });
    if (is_written) m_pos += static_cast<int64_t>(size);
    return is_written ? size : 0;
  }
  bool seek(int64_t position) override {
    m_pos = position;
    return tried([&] { file_.seek(static_cast<std::uint64_t>(position)); });
  }
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  template <class Action>
  bool tried(const Action& action) {
    try {
      if (!failure_) action();
    } catch (...) {
      failure_ = std::current_exception();
    }
    return !failure_;
  }

  ByteSink& file_;
  std::exception_ptr failure_;
};

class Writer final : public RowWriter<float> {
 public:
  Writer(ByteSink& file, const std::string& path, const lib::ImageSpec& spec)
      : path_(path),
        proxy_(file),
        out_(lib::ImageOutput::create(path)),
        row_(static_cast<std::size_t>(spec.nchannels) * static_cast<std::size_t>(spec.width)) {
    if (!out_) fail(lib::geterror());
    if (!out_->set_ioproxy(&proxy_)) fail("this format cannot be written through a proxy");
    expect(out_->open(path, spec));
  }
  void write(std::span<const float> rows) override {
    const int first = next_;
    next_ += static_cast<int>(rows.size() / row_);
    expect(out_->write_scanlines(first, next_, 0, lib::TypeDesc::FLOAT, rows.data()));
  }
  void finish() override { expect(out_->close()); }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw std::runtime_error(path_ + ": cannot be written: " + why);
  }
  void expect(bool is_done) const {
    proxy_.rethrow();
    if (!is_done) fail(out_->geterror());
  }

  std::string path_;
  Proxy proxy_;
  std::unique_ptr<lib::ImageOutput> out_;
  std::size_t row_;  ///< values
  int next_ = 0;
};

const char* name_of(Kind kind) {
  switch (kind) {
    case Kind::bmp:
      return "bmp";
    case Kind::tga:
      return "targa";
    case Kind::jpeg:
      return "jpeg";
    default:
      return "hdr";
  }
}

/// True if the reader of OpenImageIO brings the rows into order itself, as those of TGA and BMP do.
bool is_turned_by(Kind kind) { return kind == Kind::tga || kind == Kind::bmp; }

Shape shape_of(const lib::ImageSpec& spec, Kind kind) {
  const bool is_byte = spec.format == lib::TypeDesc::UINT8;
  Shape shape{spec.width,
              spec.height,
              spec.nchannels,
              is_byte ? Component::byte : Component::float32,
              is_byte ? Sample::bits8 : Sample::float32,
              {}};
  shape.contents.channels = spec.channelnames;
  const int orientation = spec.get_int_attribute("Orientation", 1);
  if (orientation != 1 && !is_turned_by(kind)) {
    shape.contents.not_read.push_back(
        "its orientation (" + std::to_string(orientation) +
        ", by the numbers of Exif), which viewers turn the picture by; rows were taken as they "
        "are stored");
  }
  return shape;
}

/// Reads by the reader of that kind alone; no other is tried.
std::string read(std::string_view bytes, Kind kind, Canvas& canvas) {
  const auto in = lib::ImageInput::create(name_of(kind));
  if (!in) return lib::geterror();
  lib::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
  if (!in->set_ioproxy(&memory)) return "OpenImageIO cannot read this kind from memory";
  lib::ImageSpec spec, as_it_is;
  as_it_is.attribute("oiio:UnassociatedAlpha", 1);  // colours as they stand in the file
  if (!in->open(name_of(kind), spec, as_it_is)) return in->geterror();
  const Shape shape = shape_of(spec, kind);
  std::byte* const pixels = canvas.rows_for(shape);
  const auto type = shape.component == Component::byte ? lib::TypeDesc::UINT8 : lib::TypeDesc::FLOAT;
  if (!in->read_image(0, 0, 0, spec.nchannels, type, pixels)) return in->geterror();
  return in->has_error() ? in->geterror() : "";
}

/// Reads channel by channel, because OpenImageIO has an order of its own.
std::string read_openexr(std::string_view bytes, int part, const Window& data,
                         const std::vector<std::string>& names, float* values) {
  const auto in = lib::ImageInput::create("openexr");
  if (!in) return lib::geterror();
  lib::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
  lib::ImageSpec spec;
  if (!in->set_ioproxy(&memory) || !in->open("openexr", spec) || !in->seek_subimage(part, 0, spec))
    return in->geterror();
  if (spec.x != data.x || spec.y != data.y || spec.width != data.width || spec.height != data.height)
    return "another data window";
  const auto stride = static_cast<lib::stride_t>(names.size() * sizeof(float));
  for (std::size_t i = 0; i < names.size(); ++i) {
    int channel = 0;
    while (channel < spec.nchannels &&
           printable(spec.channelnames[static_cast<std::size_t>(channel)]) != names[i])
      ++channel;
    if (channel == spec.nchannels) return "no channel " + names[i];
    if (!in->read_image(part, 0, channel, channel + 1, lib::TypeDesc::FLOAT, values + i, stride))
      return in->geterror();
  }
  return "";
}

/// Makes everything happen in the calling thread: with idle threads of OpenImageIO and OpenEXR at the end of
/// the process, the leak checker crashed now and then (compare OpenImageIO, issue 3851).
void use_no_threads() {
  static const bool is_set = lib::attribute("threads", 1) && lib::attribute("exr_threads", -1) &&
                             lib::attribute("debug", 0);  // else it speaks of the date on standard error
  static_cast<void>(is_set);
}

}  // namespace
}  // namespace plumb::oiio

extern "C" {

// The symbols are only ever called through the types in oiio_module.hpp, by the same compiler.
#pragma GCC diagnostic push
#ifdef __clang__
#pragma GCC diagnostic ignored "-Wreturn-type-c-linkage"
#endif

std::unique_ptr<plumb::RowWriter<float>> plumb_oiio_write(plumb::ByteSink& file, const std::string& path,
                                                          const plumb::oiio::Layout& layout) {
  plumb::oiio::use_no_threads();
  return std::make_unique<plumb::oiio::Writer>(file, path, plumb::oiio::spec_for(layout));
}

void plumb_oiio_prepare() {
  plumb::oiio::use_no_threads();
  for (const plumb::Kind kind : {plumb::Kind::bmp, plumb::Kind::tga, plumb::Kind::jpeg, plumb::Kind::hdr})
    static_cast<void>(plumb::oiio::lib::ImageInput::create(plumb::oiio::name_of(kind)));
  static_cast<void>(plumb::oiio::lib::ImageInput::create("openexr"));
}

std::string plumb_oiio_read_openexr(std::string_view bytes, int part, const plumb::Window& data,
                                    const std::vector<std::string>& names, float* values) {
  return plumb::oiio::read_openexr(bytes, part, data, names, values);
}

std::string plumb_oiio_read(std::string_view bytes, plumb::Kind kind, plumb::Canvas& canvas) {
  return plumb::oiio::read(bytes, kind, canvas);
}

#pragma GCC diagnostic pop
}
