// An OpenEXR file in memory, as OpenEXRCore sees it.
#pragma once

#include <openexr.h>

#include <string_view>

namespace plumb::codecs {

class ExrFile {
 public:
  /// The bytes must outlive it. get() is null when it is no whole header of an EXR.
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
