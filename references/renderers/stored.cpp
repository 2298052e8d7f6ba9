#include "references/renderers/stored.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "references/system/digest.hpp"
#include "references/system/directory_lock.hpp"
#include "references/system/held_signals.hpp"
#include "references/system/json.hpp"
#include "tracer/image/io.hpp"
#include "tracer/system/files.hpp"
#include "tracer/system/installation.hpp"

namespace plumb::renderers {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr const char* provenance_name = "/provenance.json";

StoredReference stored_reference_from_json(const OrderedJson& json) {
  return {json.at("scene"),    json.at("image"),         json.at("width"),
          json.at("height"),   json.at("export_sha256"), json.at("pixels_sha256"),
          json.at("renderer"), json.at("version"),       json.at("command")};
}

OrderedJson json_of(const StoredReference& e) {
  return {{"scene", e.scene},
          {"image", e.image},
          {"width", e.width},
          {"height", e.height},
          {"export_sha256", e.export_sha256},
          {"pixels_sha256", e.pixels_sha256},
          {"renderer", e.renderer},
          {"version", e.version},
          {"command", e.command}};
}

}  // namespace

std::string StoredReferences::default_directory() {
  if (const char* own = std::getenv("PLUMB_REFERENCES"); own != nullptr && *own != '\0') return own;
  return data_directory(Data::images);
}

StoredReferences::StoredReferences(std::string directory) : directory_(std::move(directory)) {
  std::ifstream file(directory_ + provenance_name);
  if (!file) return;
  try {
    for (const OrderedJson& entry : system::parse_ordered_json(read_file(directory_ + provenance_name)))
      entries_.push_back(stored_reference_from_json(entry));
  } catch (const OrderedJson::exception& error) {
    throw std::runtime_error(directory_ + provenance_name + ": is damaged: " + error.what());
  }
}

std::optional<StoredReference> StoredReferences::find(const std::string& export_text, int width,
                                                      int height) const {
  const std::string hash = system::sha256(export_text);
  const auto it = std::find_if(entries_.begin(), entries_.end(), [&](const StoredReference& e) {
    return e.export_sha256 == hash && e.width == width && e.height == height;
  });
  return it == entries_.end() ? std::nullopt : std::optional(*it);
}

Image StoredReferences::load(const StoredReference& entry) const {
  const std::string path = directory_ + "/" + entry.image;
  ImageFile file = read_image(path);
  if (file.width != entry.width || file.height != entry.height || file.channels != 3 ||
      system::sha256(file.values) != entry.pixels_sha256) {
    throw std::runtime_error(path + ": is not the image that provenance.json tells of");
  }
  Image image(file.width, file.height);
  image.rgb = std::move(file.values);
  return image;
}

void StoredReferences::store(StoredReference entry, const Image& image) {
  entry.pixels_sha256 = system::sha256(image.rgb);
  std::filesystem::create_directories(directory_);
  const system::DirectoryLock lock(directory_);
  entries_ = StoredReferences(directory_).entries_;  // others may have stored since
  const system::HeldSignals held;                    // no signal comes between the picture and its record
  write_image(directory_ + "/" + entry.image, image, Encoding::linear);
  const auto same = std::find_if(entries_.begin(), entries_.end(),
                                 [&](const StoredReference& e) { return e.scene == entry.scene; });
  if (same == entries_.end()) {
    entries_.push_back(std::move(entry));
  } else {
    *same = std::move(entry);
  }
  std::sort(entries_.begin(), entries_.end(), [](const auto& a, const auto& b) { return a.scene < b.scene; });
  OrderedJson all = OrderedJson::array();
  for (const StoredReference& e : entries_) all.push_back(json_of(e));
  write_file(directory_ + provenance_name, system::json_text(all, 2) + "\n");
}

StoredRenderer::StoredRenderer(std::unique_ptr<const ProgramRenderer> renderer)
    : Renderer(renderer->facts()),
      renderer_(std::move(renderer)),
      stored_(StoredReferences::default_directory()) {}

std::string StoredRenderer::version() const {
  const auto& all = stored_.all();
  const auto first =
      std::find_if(all.begin(), all.end(), [&](const auto& entry) { return entry.renderer == facts().name; });
  return first == all.end() ? "" : first->version;
}

Rendered StoredRenderer::render(const Shot& shot) const {
  const auto entry = stored_.find(renderer_->exported(shot).text, shot.width, shot.height);
  if (!entry) {
    throw std::runtime_error("no stored reference image for this export at " + std::to_string(shot.width) +
                             " x " + std::to_string(shot.height) + "; run with " + facts().title);
  }
  Rendered picture{stored_.load(*entry)};
  picture.cached = picture.stored = true;
  return picture;
}

}  // namespace plumb::renderers
