// A TIFF in memory, opened by libtiff.
#pragma once

#include <tiffio.h>

#include <cstdint>
#include <memory>
#include <string_view>

#include "tracer/image/codecs/codecs.hpp"

namespace plumb::codecs {

class TiffFile {
 public:
  /// The bytes must outlive this object. get() is null when libtiff does not understand the header.
  explicit TiffFile(std::string_view bytes);

  TIFF* get() const { return file_.get(); }
  template <class Value>
  Value field(std::uint32_t tag) const {
    Value value = 0;
    TIFFGetFieldDefaulted(get(), tag, &value);
    return value;
  }

 private:
  struct Close {
    void operator()(TIFF* file) const { TIFFClose(file); }
  };
  struct Bytes {
    std::string_view all;
    std::uint64_t at = 0;
  };
  static tmsize_t read(thandle_t user, void* to, tmsize_t size);
  static toff_t seek(thandle_t user, toff_t offset, int from);

  std::unique_ptr<Bytes> bytes_;
  std::unique_ptr<TIFF, Close> file_;
};

/// Chooses the page that is asked for. Writes into `contents` which one it is and what else there is. Throws
/// std::runtime_error naming the file when there is no such page.
void choose_page(const Source& source, const TiffFile& file, FileContents& contents);

}  // namespace plumb::codecs
