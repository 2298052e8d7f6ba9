#include "tracer/image/io.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <stdexcept>

#include "tracer/image/codecs/codecs.hpp"
#include "tracer/image/codecs/png_writer.hpp"
#include "tracer/image/files.hpp"
#include "tracer/image/mapped_file.hpp"
#include "tracer/image/module.hpp"
#include "tracer/image/oiio_module.hpp"

namespace plumb {
namespace {

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

bool is_float_format(const std::string& extension) { return extension == ".exr" || extension == ".pfm"; }

bool is_written(const std::string& extension) {
  return is_float_format(extension) || extension == ".png" || extension == ".ppm";
}

template <class Function>
Function oiio_symbol(const char* name) {
  return reinterpret_cast<Function>(module_symbol(oiio::module_name, name));
}

void write_8_bit_png(const std::string& path, const Image& image, Encoding encoding) {
  const auto write =
      reinterpret_cast<codecs::WritePng>(module_symbol(codecs::module_name, codecs::write_png_symbol));
  write_file(path, write(image.width, image.height, encode_8_bits(image, encoding)));
}

/// Linear: floats, or 16 bits.
void write_through_oiio(const std::string& path, const Image& image) {
  const ImageFile pixels{image.width, image.height, 3, Sample::float32, image.rgb};
  const oiio::Depth depth = is_float_format(extension_of(path)) ? oiio::Depth::float32 : oiio::Depth::bits16;
  std::string bytes;
  const std::string complaint = oiio_symbol<oiio::Write>(oiio::write_symbol)(path, pixels, depth, bytes);
  if (!complaint.empty()) throw std::runtime_error(path + ": cannot be written: " + complaint);
  write_file(path, bytes);
}

void expect_file(const std::string& path) {
  std::error_code error;
  const auto kind = std::filesystem::status(path, error).type();
  if (kind == std::filesystem::file_type::not_found)
    throw std::runtime_error(path + ": there is no such file");
  if (kind == std::filesystem::file_type::directory)
    throw std::runtime_error(path + ": is a directory, expected an image");
}

/// Of a regular file: what a pipe will hold is not known yet.
void expect_bytes(const std::string& path, std::string kind) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error) || std::filesystem::file_size(path, error) != 0) return;
  std::transform(kind.begin(), kind.end(), kind.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  throw std::runtime_error(path + ": cannot be read: the file is empty (0 bytes), expected an image" +
                           (kind.empty() ? "" : " (" + kind.substr(1) + ")") +
                           "; did the program that wrote it come to its end?");
}

ImageFile read_through_oiio(const std::string& path) {
  ImageFile file;
  const std::string complaint = oiio_symbol<oiio::Read>(oiio::read_symbol)(path, file);
  if (!complaint.empty()) {
    throw std::runtime_error(
        path + ": cannot be read as an image: found neither a whole image of the kind its name " +
        "says nor of another known one (OpenImageIO: " + complaint + ")");
  }
  return file;
}

bool is_of_codecs(const std::string& extension) {
  return extension == ".exr" || extension == ".png" || extension == ".tif" || extension == ".tiff";
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

void write_image(const std::string& path, const Image& image, Encoding encoding) {
  if (const auto complaint = complaint_about(path, encoding))
    throw std::runtime_error(path + ": " + *complaint);
  const std::string extension = extension_of(path);
  if (extension == ".pfm" || (path == "-" && encoding == Encoding::linear)) {
    write_file(path, to_pfm(image));
  } else if (extension == ".ppm" || path == "-") {
    write_file(path, to_ppm(image.width, image.height, encode_8_bits(image, encoding)));
  } else if (encoding != Encoding::linear) {
    write_8_bit_png(path, image, encoding);
  } else {
    write_through_oiio(path, image);
  }
}

PixelRows open_image(const std::string& path) {
  const std::string extension = extension_of(path);
  expect_bytes(path, extension);
  if (extension == ".pfm") {
    const auto file = std::make_shared<const MappedFile>(path);
    return pfm_rows(file->bytes(), path, file);
  }
  if (extension == ".ppm") return rows_of(from_ppm(read_file(path), path));
  expect_file(path);
  if (is_of_codecs(extension)) {
    const auto open = reinterpret_cast<codecs::Open>(module_symbol(codecs::module_name, codecs::open_symbol));
    PixelRows rows;
    if (open({path, std::make_shared<const MappedFile>(path)}, rows)) return rows;
  }
  return rows_of(read_through_oiio(path));
}

ImageFile read_image(const std::string& path) { return image_of(open_image(path)); }

}  // namespace plumb
