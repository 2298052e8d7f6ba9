#include "tracer/system/installation.hpp"

#include <dlfcn.h>

#include <array>
#include <climits>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

namespace plumb {
namespace {

namespace fs = std::filesystem;

/// The directory below share/plumb, and that in the source.
struct Layout {
  const char* installed;
  const char* in_source;
};

Layout layout_of(Data data) {
  switch (data) {
    case Data::images:
      return {"images", "references/images"};
    case Data::chart:
      return {"chart", "references/studies/chart"};
    case Data::scenes:
      break;
  }
  return {"scenes", "tests/scenes"};
}

const char* asked_for() {
  const char* const own = std::getenv("PLUMB_DATA");
  return own == nullptr || *own == '\0' ? nullptr : own;
}

fs::path installation_prefix() { return fs::path(program_directory()).parent_path(); }

bool holds_data(const fs::path& path) {
  std::error_code none;
  return fs::is_directory(path, none);
}

/// Returns where the loader finds the modules for a program that was linked with plumb's libraries.
fs::path along_run_path() {
  void* const loaded = dlopen("plumb_codecs.so", RTLD_NOW | RTLD_LOCAL);
  std::array<char, PATH_MAX> directory{};
  if (loaded == nullptr || dlinfo(loaded, RTLD_DI_ORIGIN, directory.data()) != 0) return {};
  return directory.data();
}

}  // namespace

std::string program_directory() {
  std::error_code none;
  return fs::read_symlink("/proc/self/exe", none).parent_path().string();
}

std::string source_directory() { return PLUMB_SOURCE_DIRECTORY; }

std::string data_directory(Data data) {
  const Layout layout = layout_of(data);
  if (const char* const own = asked_for()) {
    const fs::path place = fs::path(own) / layout.installed;
    if (holds_data(place)) return place.string();
    throw std::runtime_error("PLUMB_DATA: found " + std::string(own) + ", which has no directory " +
                             layout.installed + ", expected share/plumb of an installation");
  }
  const fs::path installed = installation_prefix() / "share/plumb" / layout.installed;
  if (holds_data(installed)) return installed.string();
  const fs::path source = fs::path(source_directory()) / layout.in_source;
  if (holds_data(source)) return source.string();
  throw std::runtime_error("plumb's own data are missing: found neither " + installed.string() + " nor " +
                           source.string() + "; install plumb anew, or set PLUMB_DATA to share/plumb of an " +
                           "installation");
}

std::vector<std::string> own_places() {
  std::vector<std::string> places{source_directory(), (installation_prefix() / "share/plumb").string(),
                                  (installation_prefix() / "lib/plumb").string()};
  if (const char* const own = asked_for()) places.emplace_back(own);
  return places;
}

std::string module_path(const std::string& name) {
  std::error_code none;
  for (const fs::path& directory : {fs::path(program_directory()), installation_prefix() / "lib/plumb"})
    if (fs::exists(directory / name, none)) return (directory / name).string();
  return (along_run_path() / name).string();
}

}  // namespace plumb
