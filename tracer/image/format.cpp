#include "tracer/image/format.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace plumb {

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

bool is_float_format(const std::string& extension) { return extension == ".exr" || extension == ".pfm"; }

namespace {

bool is_written(const std::string& extension) {
  return is_float_format(extension) || extension == ".png" || extension == ".ppm";
}

}  // namespace

Encoding default_encoding(const std::string& path) {
  const std::string extension = extension_of(path);
  if (path == "-" || is_float_format(extension)) return Encoding::linear;
  return extension == ".ppm" ? Encoding::course : Encoding::srgb;
}

std::optional<std::string> complaint_about(const std::string& path, Encoding encoding) {
  if (path == "-") return std::nullopt;
  const std::string extension = extension_of(path);
  if (!is_written(extension)) return "expected a name that ends in .exr, .pfm, .png or .ppm";
  if (is_float_format(extension) && encoding != Encoding::linear) {
    return "a float image holds linear colours, expected --encode linear (or .png, .ppm)";
  }
  return std::nullopt;
}

}  // namespace plumb
