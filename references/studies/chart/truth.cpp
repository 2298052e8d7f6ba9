#include "references/studies/chart/truth.hpp"

#include <cstring>
#include <filesystem>
#include <optional>

#include "references/system/digest.hpp"
#include "tracer/engine/render.hpp"
#include "tracer/system/files.hpp"
#include "tracer/textbook/render.hpp"

namespace plumb::studies {
namespace {

/// SHA-256 of the floats, and the floats.
std::string pack(const Image& image) {
  std::string bytes = system::sha256(image.rgb);
  const std::size_t at = bytes.size();
  bytes.resize(at + image.rgb.size() * sizeof(float));
  std::memcpy(bytes.data() + at, image.rgb.data(), bytes.size() - at);
  return bytes;
}

std::optional<Image> unpack(const std::string& bytes, int width, int height) {
  constexpr std::size_t digest = 64;
  Image image(width, height);
  if (bytes.size() != digest + image.rgb.size() * sizeof(float)) return std::nullopt;
  std::memcpy(image.rgb.data(), bytes.data() + digest, bytes.size() - digest);
  if (system::sha256(image.rgb) != bytes.substr(0, digest)) return std::nullopt;
  return image;
}

}  // namespace

Image render_truth(const Shot& shot, Truth truth, const std::function<void(double)>& progress) {
  RenderJob job = job_of(shot);
  job.threads = 0;
  job.progress = progress;
  if (truth == Truth::pixel_centres) {
    job.real = RealType::quad;
    return textbook::render(shot.scene, shot.camera, job);
  }
  job.samples = samples_of_area;
  return engine::render(shot.scene, shot.camera, job);
}

Image stored_truth(const Shot& shot, Truth truth, const std::string& path, bool fresh,
                   const std::function<void(double)>& progress) {
  if (!fresh && std::filesystem::is_regular_file(path)) {
    if (auto image = unpack(read_file(path), shot.width, shot.height)) return *image;
  }
  Image image = render_truth(shot, truth, progress);
  write_file(path, pack(image));
  return image;
}

}  // namespace plumb::studies
