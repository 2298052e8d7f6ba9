#include "references/submissions/confined.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "references/submissions/command_line.hpp"
#include "references/submissions/grade.hpp"
#include "references/submissions/run_tracer.hpp"
#include "references/system/process.hpp"
#include "tracer/image/format.hpp"
#include "tracer/image/io.hpp"
#include "tracer/system/files.hpp"

namespace plumb::submissions {
namespace {

namespace fs = std::filesystem;

/// The most pixels of a picture, because a header of 20 bytes can promise any number.
constexpr std::int64_t most_pixels = std::int64_t{1} << 26;

JudgedScene scene_of(const Shot& shot) {
  return {fs::path(shot.file).stem().string(), read_file(shot.file), shot.scene};
}

/// Returns the name in the render line or, if that is unusable, e.g. leads into a directory, the scene's.
std::string image_name(const JudgedScene& scene) {
  const fs::path named = scene.scene.renders.front().file;
  const bool is_plain = !named.empty() && named == named.filename() && named != scene.name + ".sdf" &&
                        named.native().front() != '-' && !extension_of(named.string()).empty();
  return is_plain ? named.string() : scene.name + ".ppm";
}

/// Replaces names of the picture's copy, which are of no use to a reader.
std::string without_path(std::string message, const std::string& file, const std::string& name) {
  const std::size_t at = message.find(file);
  return at == std::string::npos ? message : message.replace(at, file.size(), name);
}

std::string first_lines(const std::string& printed) {
  constexpr std::size_t most = 1000;
  std::string text = printed.substr(0, most);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  for (char& c : text)
    if ((static_cast<unsigned char>(c) < ' ' && c != '\n') || c == 127) c = '?';
  return text;
}

std::string what_was_left(const PixelRows& rows) {
  std::string text;
  const auto add = [&](const std::string& what) { text += (text.empty() ? "" : ", ") + what; };
  if (rows.channels == 4) add("its alpha, which is 1 everywhere");
  for (const std::string& what : rows.contents.not_read) add(what);
  return text.empty() ? text : "not compared of the renderer's picture: " + text;
}

/// Throws unless an image of three floats can stand for it. Alpha says nothing where it is 1 everywhere.
void expect_colours(const PixelRows& rows, const std::string& file) {
  const std::vector<std::string>& names = rows.contents.channels;
  const bool has_alpha = rows.channels == 4 && (names.size() != 4 || names[3] == "A");
  if (rows.channels != 3 && !has_alpha) {
    std::string found;
    for (const std::string& name : names) found += " " + name;
    throw std::runtime_error(file + ": found " + std::to_string(rows.channels) + " channels" +
                             (found.empty() ? "" : ":" + found) +
                             ", expected R G B, or with an alpha that is 1 everywhere");
  }
  if (rows.is_double)
    throw std::runtime_error(file + ": found values of more than 24 bits, expected 8 or 16 bits or float32");
}

/// Values as they stand in the file.
renderers::Rendered read_picture(const std::string& file) {
  ReadRequest request;
  request.most_pixels = most_pixels;
  const PixelRows rows = open_image(file, request);
  expect_colours(rows, file);
  renderers::Rendered picture{Image(rows.width, rows.height)};
  picture.not_read = what_was_left(rows);
  std::vector<float> row(rows.row_values());
  const auto channels = static_cast<std::size_t>(rows.channels);
  for (int y = 0; y < rows.height; ++y) {
    rows.copy_row(y, row.data());
    for (int x = 0; x < rows.width; ++x) {
      const float* const from = &row[static_cast<std::size_t>(x) * channels];
      std::copy_n(from, 3, picture.image.pixel(x, y));
      if (channels == 4 && from[3] != 1)
        throw std::runtime_error(file + ": found a pixel (" + std::to_string(x) + ", " + std::to_string(y) +
                                 ") that is not opaque, expected alpha 1 everywhere, or R G B alone");
    }
  }
  return picture;
}

[[noreturn]] void fail(const JudgedPicture& result) {
  const std::string printed = first_lines(result.printed);
  throw std::runtime_error(std::string("the renderer made no picture: ") + to_string(result.verdict) + ", " +
                           result.message + (printed.empty() ? "" : "\nit printed: " + printed));
}

}  // namespace

ConfinedRenderer::ConfinedRenderer(const std::string& asked, ConfinedCommand command)
    : renderers::Renderer({asked, asked}), command_(std::move(command)) {
  require_sandbox();
}

renderers::Rendered ConfinedRenderer::render(const Shot& shot) const {
  const JudgedScene scene = scene_of(shot);
  const std::string name = image_name(scene);
  JudgeOptions options;
  options.command = substituted(command_.words, {{"image", std::string(sandbox_directory) + "/" + name}});
  options.readable = command_.readable;
  options.limits = command_.limits;
  const system::TemporaryDirectory own;
  JudgedPicture result;
  const std::string file = picture_of_run({"the renderer", ""}, scene, options, own.path(), result);
  if (file.empty()) fail(result);
  try {
    return read_picture(file);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error("the renderer's picture: " + without_path(error.what(), file, name));
  }
}

}  // namespace plumb::submissions
