// PFM and PPM, read and written here so that no image library need be loaded for them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tracer/image/image.hpp"

namespace plumb {

/// What a file keeps a component in.
enum class Sample { bits8, bits16, half, float32 };

/// A picture as a file holds it: some formats have other channel counts than three.
struct ImageFile {
  int width = 0;
  int height = 0;
  int channels = 0;
  Sample sample = Sample::float32;
  std::vector<float> values;  ///< interleaved, row 0 on top; integers scaled to 0..1
};

/// Little-endian colour PFM (rows bottom to top, as the format has it).
std::string to_pfm(const Image& image);
/// The course framework's ASCII P3.
std::string to_ppm(int width, int height, const std::vector<unsigned char>& rgb);

/// Throw std::runtime_error saying what is wrong; `name` stands in the message.
ImageFile from_pfm(std::string_view bytes, const std::string& name);
/// P3 and P6, 8 or 16 bits, with comments.
ImageFile from_ppm(std::string_view bytes, const std::string& name);

}  // namespace plumb
