#include "references/renderers/cache.hpp"

#include <sys/stat.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "references/system/digest.hpp"
#include "references/system/json.hpp"
#include "tracer/system/files.hpp"

namespace plumb::renderers {
namespace {

namespace fs = std::filesystem;

constexpr const char* entry_magic = "plumb cache 2\n";

std::string default_directory() {
  if (const char* own = std::getenv("PLUMB_CACHE"); own != nullptr && *own != '\0') return own;
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache != '\0') {
    return std::string(cache) + "/plumb";
  }
  const char* const home = std::getenv("HOME");
  return std::string(home == nullptr || *home == '\0' ? "/tmp" : home) + "/.cache/plumb";
}

std::optional<std::string> read_if_there(const std::string& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return std::nullopt;
  try {
    return read_file(path);
  } catch (const std::runtime_error&) {
    return std::nullopt;  // as good as absent
  }
}

std::string key_of(const ExportedShot& shot, const std::string& version) {
  std::string all = shot.renderer + " " + version;
  for (const std::string& argument : shot.arguments) all += " " + argument;
  if (shot.holds != Holds::float32) all += std::string(" read from its ") + to_string(shot.holds);
  return system::sha256(all + "\n" + shot.text);
}

/// Notices damage; XXH3 because SHA-256 of the pixels costs as much as rendering them.
std::string checksum(std::string_view bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  std::array<char, 33> text{};
  std::snprintf(text.data(), text.size(), "%016llx%016llx", static_cast<unsigned long long>(hash.high64),
                static_cast<unsigned long long>(hash.low64));
  return text.data();
}

/// magic, checksum of the rest, a line of JSON, the floats
std::string pack(const Rendered& picture) {
  const nlohmann::json about{{"width", picture.image.width},
                             {"height", picture.image.height},
                             {"cpu_seconds", picture.cpu_seconds},
                             {"precision", to_string(picture.holds)},
                             {"warnings", picture.warnings}};
  std::string rest = system::json_text_of_any_bytes(about) + "\n";
  const std::size_t at = rest.size();
  rest.resize(at + picture.image.rgb.size() * sizeof(float));
  std::memcpy(rest.data() + at, picture.image.rgb.data(), picture.image.rgb.size() * sizeof(float));
  return entry_magic + checksum(rest) + "\n" + rest;
}

std::optional<Rendered> unpack(std::string_view bytes) {
  constexpr std::size_t hash_length = 32;
  const std::string_view magic = entry_magic;
  if (!bytes.starts_with(magic) || bytes.size() < magic.size() + hash_length + 1) return std::nullopt;
  const std::string_view hash = bytes.substr(magic.size(), hash_length);
  const std::string_view rest = bytes.substr(magic.size() + hash_length + 1);
  if (checksum(rest) != hash || bytes[magic.size() + hash_length] != '\n') return std::nullopt;
  const std::size_t line = rest.find('\n');
  const nlohmann::json about = system::parse_json(rest.substr(0, line));
  Rendered picture;
  picture.image = Image(about.at("width"), about.at("height"));
  picture.cpu_seconds = about.at("cpu_seconds");
  picture.holds = holds_named(about.at("precision"));
  picture.warnings = about.at("warnings");
  const std::string_view floats = rest.substr(line + 1);
  if (floats.size() != picture.image.rgb.size() * sizeof(float)) return std::nullopt;
  std::memcpy(picture.image.rgb.data(), floats.data(), floats.size());
  return picture;
}

/// Changes whenever the program file does.
std::string fingerprint(const std::string& program) {
  struct stat info {};
  stat(program.c_str(), &info);
  return program + " " + std::to_string(info.st_size) + " " + std::to_string(info.st_mtim.tv_sec) + "." +
         std::to_string(info.st_mtim.tv_nsec);
}

}  // namespace

Cache::Cache() : directory_(default_directory()) {}

std::string Cache::version_of(const ProgramRenderer& renderer) const {
  const std::string print = fingerprint(renderer.program());
  const std::string path = directory_ + "/version-" + system::sha256(print);
  if (const auto known = read_if_there(path)) {
    const std::string version = known->substr(0, known->find('\n'));
    if (*known == version + "\n" + checksum(print + version)) return version;
  }
  const std::string version = renderer.version();
  write_entry(path, version + "\n" + checksum(print + version));
  return version;
}

std::string Cache::complaint(const std::string& title) const {
  const std::lock_guard lock(mutex_);
  if (trouble_.empty()) return {};
  return "warning: " + trouble_ + "; " + title +
         "'s pictures are not kept, so the next run renders them again: make room or mend the permissions "
         "there, or name another directory with PLUMB_CACHE";
}

void Cache::write_entry(const std::string& path, const std::string& bytes) const {
  std::string cause;
  try {
    fs::create_directories(directory_);
    write_file(path, bytes);
    return;
  } catch (const fs::filesystem_error& error) {
    cause = directory_ + ": cannot be written: " + error.code().message();
  } catch (const std::exception& error) {
    cause = error.what();
  }
  const std::lock_guard lock(mutex_);
  if (trouble_.empty()) trouble_ = cause;
}

std::string Cache::entry_path(const ExportedShot& shot, const std::string& version) const {
  return directory_ + "/" + key_of(shot, version) + ".picture";
}

std::optional<Rendered> Cache::find(const ExportedShot& shot, const std::string& version) const {
  const std::string path = entry_path(shot, version);
  const auto bytes = read_if_there(path);
  if (!bytes) return std::nullopt;
  auto picture = unpack(*bytes);
  if (!picture || picture->image.width != shot.width || picture->image.height != shot.height)
    return std::nullopt;
  std::error_code ignored;
  fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);  // used now, so pruned later
  return picture;
}

void Cache::store(const ExportedShot& shot, const std::string& version, const Rendered& picture) const {
  write_entry(entry_path(shot, version), pack(picture));
  prune();
}

void Cache::prune() const {
  struct Entry {
    fs::path path;
    fs::file_time_type used;
    std::uintmax_t size;
  };
  std::vector<Entry> entries;
  std::uintmax_t total = 0;
  std::error_code error;
  for (fs::directory_iterator file(directory_, error); !error && file != fs::directory_iterator();
       file.increment(error)) {
    if (file->path().extension() != ".picture") continue;
    std::error_code gone;  // another process may prune, too
    const Entry entry{file->path(), file->last_write_time(gone), file->file_size(gone)};
    if (gone) continue;
    entries.push_back(entry);
    total += entry.size;
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.used < b.used; });
  for (const Entry& entry : entries) {
    if (total <= largest_cache) return;
    if (fs::remove(entry.path, error)) total -= entry.size;
  }
}

}  // namespace plumb::renderers
