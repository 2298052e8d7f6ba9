#include "tracer/image/codecs/tiff_samples.hpp"

#include <algorithm>
#include <cstring>

#include "tracer/image/channel_names.hpp"
#include "tracer/image/codecs/damage.hpp"
#include "tracer/image/codecs/half.hpp"

namespace plumb::codecs {
namespace {

class TiffLayoutReader {
 public:
  TiffLayoutReader(const Source& source, const TiffFile& file) : source_(source), file_(file) {}

  TiffLayout layout() {
    layout_.bits = tag(TIFFTAG_BITSPERSAMPLE);
    layout_.format = tag(TIFFTAG_SAMPLEFORMAT);
    if (layout_.format == SAMPLEFORMAT_VOID) layout_.format = SAMPLEFORMAT_UINT;
    layout_.samples = tag(TIFFTAG_SAMPLESPERPIXEL);
    layout_.is_planar = tag(TIFFTAG_PLANARCONFIG) == PLANARCONFIG_SEPARATE;
    expect_known_samples();
    read_meaning();
    read_shape();
    if (tag(TIFFTAG_ORIENTATION) != ORIENTATION_TOPLEFT)
      layout_.shape.contents.not_read.push_back(
          "its orientation (tag 274 is " + std::to_string(tag(TIFFTAG_ORIENTATION)) +
          "), which viewers turn the picture by; rows were taken as they are stored");
    return std::move(layout_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw std::runtime_error(source_.path + ": cannot be read: TIFF of " + what +
                             " isn't supported; write RGB or grey of 8 or 16 bits, or of floats");
  }
  std::uint16_t tag(std::uint32_t number) const { return file_.field<std::uint16_t>(number); }

  void expect_known_samples() const {
    constexpr std::size_t most = 1024;
    const unsigned bits = layout_.bits;
    const bool is_float = layout_.format == SAMPLEFORMAT_IEEEFP,
               is_signed = layout_.format == SAMPLEFORMAT_INT;
    const bool is_small = bits == 1 || bits == 2 || bits == 4,
               is_whole = bits == 8 || bits == 16 || bits == 32;
    const bool is_known = is_float                              ? bits == 16 || bits == 32 || bits == 64
                          : is_signed                           ? is_whole
                          : layout_.format == SAMPLEFORMAT_UINT ? is_small || is_whole
                                                                : false;
    if (!is_known)
      refuse(std::to_string(bits) + " bits a sample (sample format " + std::to_string(layout_.format) + ")");
    if (layout_.samples < 1 || layout_.samples > most) refuse(std::to_string(layout_.samples) + " channels");
  }

  void read_meaning() {
    const std::uint16_t photometric = tag(TIFFTAG_PHOTOMETRIC);
    std::vector<std::string>& names = layout_.shape.contents.channels;
    if (photometric == PHOTOMETRIC_RGB) {
      names = {"R", "G", "B"};
    } else if (photometric == PHOTOMETRIC_MINISBLACK || photometric == PHOTOMETRIC_MINISWHITE) {
      names = {"Y"};
      if (photometric == PHOTOMETRIC_MINISWHITE) layout_.meaning = TiffMeaning::white_is_zero;
    } else if (photometric == PHOTOMETRIC_SEPARATED && layout_.samples >= 4) {
      names = {"C", "M", "Y", "K"};
    } else if (photometric == PHOTOMETRIC_PALETTE && layout_.samples == 1) {
      read_palette();
      names = {"R", "G", "B"};
      return;
    } else if (photometric == PHOTOMETRIC_YCBCR && tag(TIFFTAG_COMPRESSION) == COMPRESSION_JPEG) {
      TIFFSetField(file_.get(), TIFFTAG_JPEGCOLORMODE, JPEGCOLORMODE_RGB);
      names = {"R", "G", "B"};
    } else {
      refuse("colours of kind " + std::to_string(photometric) + " (photometric interpretation)");
    }
    if (names.size() > layout_.samples) refuse("too few channels");
    if (layout_.meaning == TiffMeaning::white_is_zero &&
        (layout_.format != SAMPLEFORMAT_UINT || layout_.bits > 16))
      refuse("white as 0 with such samples");
    name_extra_samples(names);
  }

  void name_extra_samples(std::vector<std::string>& names) const {
    std::uint16_t count = 0;
    std::uint16_t* kinds = nullptr;
    TIFFGetFieldDefaulted(file_.get(), TIFFTAG_EXTRASAMPLES, &count, &kinds);
    const std::size_t colours = names.size();
    for (std::size_t i = colours; i < layout_.samples; ++i) {
      const std::size_t extra = i - colours;
      const bool is_alpha = extra < count && kinds != nullptr && kinds[extra] != EXTRASAMPLE_UNSPECIFIED;
      names.push_back(is_alpha && extra == 0 ? "A" : "extra" + std::to_string(extra + 1));
    }
  }

  /// 16 bits each; those that 8 were widened to are 8.
  void read_palette() {
    std::uint16_t* map[3] = {};
    if (layout_.bits > 16 || layout_.format != SAMPLEFORMAT_UINT ||
        TIFFGetField(file_.get(), TIFFTAG_COLORMAP, &map[0], &map[1], &map[2]) != 1)
      refuse("a palette without colours");
    layout_.meaning = TiffMeaning::palette;
    const std::size_t size = std::size_t{1} << layout_.bits;
    bool are_bytes = true;
    for (std::size_t i = 0; i < 3 * size; ++i) {
      const unsigned value = map[i % 3][i / 3];
      are_bytes = are_bytes && ((value & 255U) == 0 || (value & 255U) == value >> 8);
    }
    for (std::size_t i = 0; i < 3 * size; ++i) {
      const unsigned value = map[i % 3][i / 3];
      layout_.palette.push_back(are_bytes ? (value >> 8) / 255.0 : value / 65535.0);
    }
    has_byte_palette_ = are_bytes;
  }

  void read_shape() {
    Shape& shape = layout_.shape;
    const bool is_whole = layout_.format == SAMPLEFORMAT_UINT && layout_.bits <= 16;
    const bool is_double =
        layout_.bits == 64 || (layout_.bits == 32 && layout_.format != SAMPLEFORMAT_IEEEFP);
    const bool is_byte = is_whole && layout_.bits <= 8 && (layout_.palette.empty() || has_byte_palette_);
    shape.component = is_byte ? Component::byte : is_double ? Component::float64 : Component::float32;
    shape.sample = is_byte                                                       ? Sample::bits8
                   : is_whole                                                    ? Sample::bits16
                   : layout_.bits == 16 && layout_.format == SAMPLEFORMAT_IEEEFP ? Sample::half
                                                                                 : Sample::float32;
    const auto width = file_.field<std::uint32_t>(TIFFTAG_IMAGEWIDTH);
    const auto height = file_.field<std::uint32_t>(TIFFTAG_IMAGELENGTH);
    shape.channels = static_cast<int>(shape.contents.channels.size());
    source_.limits.check(
        source_.path, width, height,
        static_cast<std::int64_t>(shape.contents.channels.size() * size_of(shape.component)));
    shape.width = static_cast<int>(width);
    shape.height = static_cast<int>(height);
  }

  const Source& source_;
  const TiffFile& file_;
  TiffLayout layout_;
  bool has_byte_palette_ = false;
};

template <class Value>
Value at(const std::byte* bytes, std::size_t i) {
  Value value{};
  std::memcpy(&value, bytes + i * sizeof value, sizeof value);
  return value;
}

double whole_number(const TiffLayout& layout, const std::byte* bytes, std::size_t i) {
  const bool is_signed = layout.format == SAMPLEFORMAT_INT;
  switch (layout.bits) {
    case 8:
      return is_signed ? at<std::int8_t>(bytes, i) : at<std::uint8_t>(bytes, i);
    case 16:
      return is_signed ? at<std::int16_t>(bytes, i) : at<std::uint16_t>(bytes, i);
    case 32:
      return is_signed ? static_cast<double>(at<std::int32_t>(bytes, i))
                       : static_cast<double>(at<std::uint32_t>(bytes, i));
    default: {
      const std::size_t bit = i * layout.bits;
      return at<std::uint8_t>(bytes, bit / 8) >> (8 - layout.bits - bit % 8) & ((1U << layout.bits) - 1);
    }
  }
}

}  // namespace

TiffLayout tiff_layout(const Source& source, const TiffFile& file) {
  return TiffLayoutReader(source, file).layout();
}

double tiff_sample(const TiffLayout& layout, const std::byte* bytes, std::size_t i) {
  if (layout.format == SAMPLEFORMAT_IEEEFP) {
    if (layout.bits == 64) return at<double>(bytes, i);
    return static_cast<double>(layout.bits == 32 ? at<float>(bytes, i)
                                                 : float_of_half(at<std::uint16_t>(bytes, i)));
  }
  const double value = whole_number(layout, bytes, i);
  if (layout.meaning == TiffMeaning::palette || layout.format == SAMPLEFORMAT_INT || layout.bits > 16)
    return value;
  const auto most = static_cast<double>((1U << layout.bits) - 1);
  return (layout.meaning == TiffMeaning::white_is_zero ? most - value : value) / most;
}

}  // namespace plumb::codecs
