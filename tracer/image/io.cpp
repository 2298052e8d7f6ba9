#include "tracer/image/io.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <stdexcept>

#include "tracer/image/codecs/codecs.hpp"
#include "tracer/image/files.hpp"
#include "tracer/image/image_writer.hpp"
#include "tracer/image/mapped_file.hpp"
#include "tracer/image/module.hpp"
#include "tracer/image/oiio_module.hpp"

namespace plumb {
namespace {

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
  const auto read = reinterpret_cast<oiio::Read>(module_symbol(oiio::module_name, oiio::read_symbol));
  const std::string complaint = read(path, file);
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

void write_image(const std::string& path, const Image& image, Encoding encoding) {
  ImageWriter writer(path, image.width, image.height, encoding);
  writer.write(image);
  writer.finish();
}

PixelRows open_image(const std::string& path, const ReadRequest&) {
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
