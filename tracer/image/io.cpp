#include "tracer/image/io.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <optional>
#include <stdexcept>

#include "tracer/image/channel_names.hpp"
#include "tracer/image/codecs/codecs.hpp"
#include "tracer/image/confined_decoder.hpp"
#include "tracer/image/image_writer.hpp"
#include "tracer/image/kind.hpp"
#include "tracer/system/mapped_file.hpp"
#include "tracer/system/module.hpp"

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

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

/// Throws when a regular file is empty. What a pipe will hold is not known yet.
void expect_bytes(const std::string& path, const std::string& kind) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error) || std::filesystem::file_size(path, error) != 0) return;
  throw std::runtime_error(path + ": cannot be read: the file is empty (0 bytes), expected an image" +
                           (kind.empty() ? "" : " (" + upper(kind.substr(1)) + ")") +
                           "; did the program that wrote it come to its end?");
}

/// Throws and says what the file is. When its name promises a kind, it says that it is none of that.
[[noreturn]] void refuse_unknown(const std::string& path, const std::string& extension,
                                 std::string_view bytes) {
  constexpr std::array known{".ppm", ".pgm",  ".pbm", ".pnm", ".pfm", ".png",  ".exr",
                             ".tif", ".tiff", ".bmp", ".tga", ".jpg", ".jpeg", ".hdr"};
  const bool is_known = std::find(known.begin(), known.end(), extension) != known.end();
  const std::string promised = is_known ? "is no " + upper(extension.substr(1)) + " file: " : "";
  throw std::runtime_error(path + ": cannot be read: " + promised + "found " + seeming(bytes) +
                           ", expected PPM, PGM, PBM, PFM, PNG, EXR, TIFF, BMP, TGA, JPEG or HDR" +
                           remedy(bytes));
}

/// Throws when a part is asked for that the format cannot hold.
void expect_one_part(const std::string& path, Kind kind, const ReadRequest& request) {
  const bool may_have_parts = kind == Kind::exr || kind == Kind::tiff;
  if (may_have_parts || request.part.empty() || request.part == "1") return;
  throw std::runtime_error(path + ": found no part '" + printable(request.part) +
                           "', expected 1: a file of this kind holds one picture");
}

PixelRows all_channels(const std::string& path, const ReadRequest& request) {
  const std::string extension = extension_of(path);
  expect_bytes(path, extension);
  expect_file(path);
  const auto file = std::make_shared<const MappedFile>(path);
  const std::optional<Kind> kind = kind_of(file->bytes(), extension);
  if (!kind) refuse_unknown(path, extension, file->bytes());
  expect_one_part(path, *kind, request);
  const ReadLimits limits = limits_for(request, file->bytes().size());
  if (*kind == Kind::pfm) return pfm_rows(file->bytes(), path, file, limits);
  if (*kind == Kind::netpbm) return rows_of(from_netpbm(file->bytes(), path, limits));
  if (*kind == Kind::png || *kind == Kind::exr || *kind == Kind::tiff) {
    const auto open = reinterpret_cast<codecs::Open>(module_symbol(codecs::module_name, codecs::open_symbol));
    PixelRows rows;
    if (open({path, file, *kind, request.part, limits}, rows)) return rows;
  }
  return decode_confined(path, *file, *kind, request, limits);
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// Returns the channels that are wanted. Channels of formats without names have the usual ones.
PixelRows chosen_channels(const std::string& path, PixelRows rows, const std::vector<std::string>& wanted) {
  if (wanted.empty()) return rows;
  if (rows.contents.channels.empty()) rows.contents.channels = usual_channels(rows.channels);
  const std::vector<std::string> names = rows.contents.channels;
  std::vector<std::size_t> places;
  for (const std::string& name : wanted) {
    const auto at = std::find(names.begin(), names.end(), name);
    if (at == names.end())
      throw std::runtime_error(path + ": found no channel '" + printable(name) + "', expected some of " +
                               listed(names));
    places.push_back(static_cast<std::size_t>(at - names.begin()));
  }
  PixelRows result = with_channels(rows, places);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (std::find(places.begin(), places.end(), i) == places.end())
      result.contents.not_read.push_back("channel " + names[i]);
  }
  return result;
}

}  // namespace

void write_image(const std::string& path, const Image& image, Encoding encoding) {
  ImageWriter writer(path, image.width, image.height, encoding);
  writer.write(image);
  writer.finish();
}

PixelRows open_image(const std::string& path, const ReadRequest& request) {
  return chosen_channels(path, all_channels(path, request), request.channels);
}

ImageFile read_image(const std::string& path) {
  const PixelRows rows = open_image(path);
  try {
    return image_of(rows);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
}

}  // namespace plumb
