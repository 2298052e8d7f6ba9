// What is wanted of a file, and how much of it memory may take.
#pragma once

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace plumb {

/// What to read of a file that holds more than one picture, or more channels than are wanted.
struct ReadRequest {
  std::string part;                                  ///< its name, or its number from 1; empty: the first
  std::vector<std::string> channels;                 ///< by name, in this order; empty: all
  std::int64_t most_pixels = std::int64_t{1} << 28;  ///< a header with more is refused before decoding
};

/// Thrown when a header promises more pixels or bytes than are allowed. Nothing was decoded.
class PictureTooLarge : public std::runtime_error {
 public:
  PictureTooLarge(const std::string& message, std::int64_t wide, std::int64_t high)
      : std::runtime_error(message), width(wide), height(high) {}
  std::int64_t width;
  std::int64_t height;
};

/// The limits that every decoder checks as soon as it knows the header.
struct ReadLimits {
  std::int64_t pixels = 0;
  std::int64_t bytes = 0;  ///< of decoded pixels; pixels that are looked at in the file do not count

  /// Throws PictureTooLarge, or std::runtime_error for a size that makes no sense. `bytes_per_pixel` is 0 for
  /// pixels that stay in the file.
  void check(const std::string& path, std::int64_t width, std::int64_t height,
             std::int64_t bytes_per_pixel) const {
    constexpr std::int64_t longest = std::int64_t{1} << 30;
    const std::string size = std::to_string(width) + " x " + std::to_string(height) + " pixels";
    if (width < 1 || height < 1 || width > longest || height > longest)
      throw std::runtime_error(path + ": cannot be read: its size is out of range, found " + size);
    if (width > pixels / height)
      throw PictureTooLarge(path + ": cannot be read: its size is out of range, found " + size +
                                ", expected at most " + std::to_string(pixels) + " pixels",
                            width, height);
    if (bytes_per_pixel > bytes / (width * height)) {
      throw PictureTooLarge(path + ": cannot be read: found " + size + " of " +
                                std::to_string(bytes_per_pixel) + " bytes, expected at most " +
                                std::to_string(bytes >> 20) +
                                " MiB for a compressed file of this length; larger pictures are looked at "
                                "in uncompressed PFM, float EXR or float TIFF",
                            width, height);
    }
  }
};

/// Returns the limits for a file of this length. A compressed file can promise a thousand times its length.
/// 512 MiB hold 8K RGBA in float32; files of larger real renders are longer than a 64th of their pixels.
inline ReadLimits limits_for(const ReadRequest& request, std::size_t file_bytes) {
  constexpr std::int64_t always = std::int64_t{512} << 20, times = 64;
  return {request.most_pixels, std::max(always, times * static_cast<std::int64_t>(file_bytes))};
}

}  // namespace plumb
