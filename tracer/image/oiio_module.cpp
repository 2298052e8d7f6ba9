#include "tracer/image/oiio_module.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstddef>
#include <exception>
#include <stdexcept>

namespace plumb::oiio {
namespace {

namespace lib = OIIO;

lib::ImageSpec spec_for(int width, int height, Depth depth) {
  lib::ImageSpec spec(width, height, 3, lib::TypeDesc::FLOAT);
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

/// What OpenImageIO writes goes on to the file. It does not notice a full disk, and its codecs in C let no
/// exception through: a failure is kept for rethrow().
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
        row_(3 * static_cast<std::size_t>(spec.width)) {
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

/// Everything in the calling thread: with idle threads of OpenImageIO and OpenEXR at the end of the process
/// the leak checker crashed now and then (compare OpenImageIO, issue 3851).
void use_no_threads() {
  static const bool is_set = lib::attribute("threads", 1) && lib::attribute("exr_threads", -1);
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
                                                          int width, int height, plumb::oiio::Depth depth) {
  plumb::oiio::use_no_threads();
  return std::make_unique<plumb::oiio::Writer>(file, path, plumb::oiio::spec_for(width, height, depth));
}

std::string plumb_oiio_read(const std::string& path, plumb::ImageFile& pixels) {
  plumb::oiio::use_no_threads();
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
