#include "references/renderers/baselines.hpp"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "references/system/digest.hpp"
#include "references/system/directory_lock.hpp"
#include "references/system/held_signals.hpp"
#include "references/system/json.hpp"
#include "tracer/image/io.hpp"
#include "tracer/system/files.hpp"

namespace plumb::renderers {
namespace {

namespace fs = std::filesystem;
using OrderedJson = nlohmann::ordered_json;

constexpr const char* records_name = "/baselines.json";
constexpr const char* remedy = "; bring both back as they were approved, e.g. git checkout ";

OrderedJson json_of(const Baseline& b) {
  OrderedJson json{{"scene", b.name + ".sdf"},
                   {"image", b.name + ".exr"},
                   {"who", b.who},
                   {"when", b.when},
                   {"why", b.why},
                   {"version", b.version},
                   {"width", b.width},
                   {"height", b.height},
                   {"scene_sha256", b.scene_sha256},
                   {"pixels_sha256", b.pixels_sha256},
                   {"command", b.command}};
  if (!b.renderer.empty()) json["renderer"] = b.renderer;
  return json;
}

/// True if the name is relative and stays within its directory.
bool is_within(const fs::path& name) {
  return !name.empty() && name.is_relative() && name == name.lexically_normal() && *name.begin() != "..";
}

/// Throws OrderedJson::exception or std::runtime_error.
Baseline baseline_from_json(const OrderedJson& json) {
  constexpr std::string_view extension = ".sdf";
  const std::string scene = json.at("scene");
  Baseline b{scene.substr(0, scene.size() - std::min<std::size_t>(scene.size(), extension.size())),
             json.at("width"),
             json.at("height"),
             json.at("who"),
             json.at("when"),
             json.at("why"),
             json.at("version"),
             json.at("scene_sha256"),
             json.at("pixels_sha256"),
             json.at("command"),
             json.value("renderer", "")};
  // No record leads out of the directory.
  if (!is_within(b.name) || scene != b.name + ".sdf" || json.at("image") != b.name + ".exr") {
    throw std::runtime_error("found scene " + system::json_text(json.at("scene")) + " and image " +
                             system::json_text(json.at("image")) + ", expected NAME.sdf and NAME.exr");
  }
  return b;
}

/// Puts an entry into its place by name, where it replaces one of that name.
void put(std::vector<Baseline>& entries, Baseline entry) {
  const auto at = std::lower_bound(entries.begin(), entries.end(), entry.name,
                                   [](const Baseline& b, const std::string& name) { return b.name < name; });
  if (at != entries.end() && at->name == entry.name) {
    *at = std::move(entry);
  } else {
    entries.insert(at, std::move(entry));
  }
}

std::string text_of(const std::vector<Baseline>& entries, const std::string& directory) {
  OrderedJson all = OrderedJson::array();
  for (const Baseline& b : entries) all.push_back(json_of(b));
  try {
    return system::json_text(all, 2) + "\n";
  } catch (const OrderedJson::type_error&) {
    throw std::runtime_error(directory + records_name +
                             ": not written: found a name or reason that is not UTF-8, which JSON needs");
  }
}

}  // namespace

Baselines::Baselines(std::string directory) : directory_(std::move(directory)) {
  const std::string path = directory_ + records_name;
  if (!fs::exists(path)) return;
  try {
    const OrderedJson all = system::parse_ordered_json(read_file(path));
    if (!all.is_array()) throw std::runtime_error("expected a list of records");
    for (const OrderedJson& entry : all) {
      Baseline baseline = baseline_from_json(entry);
      if (find(baseline.name) != nullptr) throw std::runtime_error("'" + baseline.name + "' is there twice");
      put(entries_, std::move(baseline));
    }
  } catch (const std::exception& error) {
    throw std::runtime_error(path + ": is damaged: " + error.what() + remedy + directory_);
  }
}

const Baseline* Baselines::find(const std::string& name) const {
  const auto it =
      std::find_if(entries_.begin(), entries_.end(), [&](const Baseline& b) { return b.name == name; });
  return it == entries_.end() ? nullptr : &*it;
}

std::string Baselines::image_path(const std::string& name) const { return directory_ + "/" + name + ".exr"; }

bool Baselines::are_in(const std::string& directory) { return fs::exists(directory + records_name); }

std::vector<std::string> Baselines::names() const {
  std::set<std::string> names;
  for (const Baseline& b : entries_) names.insert(b.name);
  if (!fs::exists(directory_)) return {names.begin(), names.end()};
  for (fs::recursive_directory_iterator at(directory_), end; at != end; ++at) {
    const fs::path& path = at->path();
    if (at->is_directory()) {
      if (path.filename().native().front() == '.' || are_in(path.string())) at.disable_recursion_pending();
    } else if (path.extension() == ".exr") {
      names.insert(fs::path(path).replace_extension().lexically_relative(directory_).string());
    }
  }
  return {names.begin(), names.end()};
}

Image Baselines::load(const Baseline& entry) const {
  const std::string path = image_path(entry.name);
  ImageFile file;
  try {
    file = read_image(path);
  } catch (const std::exception& error) {
    throw std::runtime_error(std::string(error.what()) + remedy + directory_);
  }
  if (file.width != entry.width || file.height != entry.height || file.channels != 3 ||
      system::sha256(file.values) != entry.pixels_sha256) {
    throw std::runtime_error(path + ": is not the image that baselines.json tells of" + remedy + directory_);
  }
  Image image(file.width, file.height);
  image.rgb = std::move(file.values);
  return image;
}

BaselineUpdate::BaselineUpdate(std::string directory, const std::string& aside)
    : directory_(std::move(directory)), aside_(aside) {}

void BaselineUpdate::add(Baseline record, const Image& image) {
  record.width = image.width;
  record.height = image.height;
  record.pixels_sha256 = system::sha256(image.rgb);
  const fs::path file = fs::path(aside_.path()) / (record.name + ".exr");
  fs::create_directories(file.parent_path());
  write_image(file.string(), image, Encoding::linear);
  added_.push_back(std::move(record));
}

void BaselineUpdate::remove_image(const std::string& name) const {
  fs::path file = fs::path(directory_) / (name + ".exr");
  fs::remove(file);
  std::error_code is_in_use;  // by other images
  for (file = file.parent_path(); file != fs::path(directory_) && !is_in_use; file = file.parent_path())
    fs::remove(file, is_in_use);
}

void BaselineUpdate::commit() {
  if (added_.empty() && gone_.empty()) return;
  fs::create_directories(directory_);
  const system::DirectoryLock lock(directory_);
  std::vector<Baseline> entries = Baselines(directory_).all();
  for (const Baseline& record : added_) put(entries, record);
  std::erase_if(entries, [&](const Baseline& b) {
    return std::find(gone_.begin(), gone_.end(), b.name) != gone_.end();
  });
  write_file(aside_.path() + records_name, text_of(entries, directory_));
  // All that can fail for lack of space has happened. The rest is renames, and no signal comes between them.
  const system::HeldSignals held;
  for (const Baseline& record : added_) {
    const std::string file = "/" + record.name + ".exr";
    fs::create_directories(fs::path(directory_ + file).parent_path());
    fs::rename(aside_.path() + file, directory_ + file);
  }
  fs::rename(aside_.path() + records_name, directory_ + records_name);
  for (const std::string& name : gone_) remove_image(name);
}

}  // namespace plumb::renderers
