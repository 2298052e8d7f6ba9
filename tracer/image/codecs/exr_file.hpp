// An OpenEXR file in memory, opened by OpenEXRCore.
#pragma once

#include <openexr.h>

#include <string_view>

namespace plumb::codecs {

class ExrFile {
 public:
  /// The bytes must outlive this object. get() is null when they hold no complete header of an EXR.
  explicit ExrFile(std::string_view bytes);
  ~ExrFile();
  ExrFile(const ExrFile&) = delete;
  ExrFile& operator=(const ExrFile&) = delete;

  exr_context_t get() const { return context_; }

 private:
  std::string_view bytes_;
  exr_context_t context_ = nullptr;
};

}  // namespace plumb::codecs
