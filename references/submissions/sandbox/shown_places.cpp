#include "references/submissions/sandbox/shown_places.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <deque>
#include <filesystem>
#include <map>
#include <stdexcept>

#include "references/renderers/cache.hpp"
#include "tracer/system/installation.hpp"

namespace plumb::submissions {
namespace {

namespace fs = std::filesystem;

/// The most links on a path, because the kernel follows no more.
constexpr int most_links = 40;

constexpr const char* system_places[] = {"/usr",   "/bin",   "/sbin",   "/lib",
                                         "/lib32", "/lib64", "/libx32", "/sys/devices/system/cpu"};

/// What compilers, interpreters and fonts read; no host names, no keys, no configuration of services.
constexpr const char* settings[] = {
    "alternatives", "fonts",    "group",        "host.conf",  "ld.so.cache",   "ld.so.conf", "ld.so.conf.d",
    "localtime",    "magic",    "magic.mime",   "mime.types", "nsswitch.conf", "passwd",     "python3",
    "protocols",    "services", "ssl/certs",    "timezone",   "OpenCL",        "vulkan",     "glvnd",
    "drirc",        "terminfo", "locale.alias", "perl",       "gcrypt",        "mono",       "ImageMagick-6"};

fs::path without_end_slash(const fs::path& path) {
  const fs::path normal = path.lexically_normal();
  return normal.has_filename() || normal == "/" ? normal : normal.parent_path();
}

bool is_closed(const fs::path& path) {
  constexpr auto needed = fs::perms::others_read | fs::perms::others_exec;
  std::error_code none;
  const fs::file_status status = fs::symlink_status(path, none);
  return geteuid() == 0 && fs::is_directory(status) && (status.permissions() & needed) != needed;
}

/// Plumb itself, its source, an installation's data, and the pictures of references are hidden: whoever runs
/// plumb or copies its pictures has not written a tracer.
std::vector<fs::path> places_of_plumb() {
  const std::vector<std::string> own = own_places();
  std::vector<fs::path> places(own.begin(), own.end());
  places.emplace_back(renderers::Cache().directory());
  if (const char* const references = std::getenv("PLUMB_REFERENCES")) places.emplace_back(references);
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none);
  if (!none) places.push_back(program);
  return places;
}

class Plan {
 public:
  void set(const fs::path& path, PlaceKind kind) { places_[path] = {kind, {}}; }

  /// Makes the links on the way as they are here, so that a path leads where it leads outside.
  void show(const std::string& given) {
    fs::path real = "/";
    std::deque<fs::path> ahead = names_of(fs::absolute(given));
    for (int links = 0; !ahead.empty() && links <= most_links;) {
      const fs::path name = ahead.front();
      ahead.pop_front();
      if (name == "..") {
        real = real.parent_path();
        continue;
      }
      std::error_code none;
      const fs::path target = fs::read_symlink(real / name, none);
      if (none) {
        real /= name;
        continue;
      }
      ++links;
      places_.try_emplace(real / name, Entry{PlaceKind::link, target.string()});
      if (target.is_absolute()) real = "/";
      const std::deque<fs::path> names = names_of(target);
      ahead.insert(ahead.begin(), names.begin(), names.end());
    }
    std::error_code none;
    if (ahead.empty() && fs::exists(real, none)) show_real(real);
  }

  void hide(const fs::path& path) {
    std::error_code none;
    const fs::path real = without_end_slash(fs::weakly_canonical(path, none));
    if (!none && fs::exists(real, none)) set(real, PlaceKind::hidden);
  }

  std::vector<Place> in_order() {
    for (const auto& [path, entry] : std::map(places_))
      for (fs::path at = path.parent_path(); entry.kind != PlaceKind::hidden && at != "/" && path != "/";
           at = at.parent_path())
        places_.try_emplace(at, Entry{PlaceKind::way, {}});
    std::vector<Place> result;
    std::vector<std::pair<fs::path, PlaceKind>> around;  // the places that hold the current one
    for (auto at = places_.begin(); at != places_.end(); ++at) {
      const auto& [path, entry] = *at;
      while (!around.empty() && !lies_in(path, around.back().first)) around.pop_back();
      const bool is_shown = !around.empty() && around.back().second == PlaceKind::shown;
      const auto next = std::next(at);
      const bool leads_on = next != places_.end() && lies_in(next->first, path);
      const PlaceKind kind =
          entry.kind == PlaceKind::hidden && !is_shown && leads_on ? PlaceKind::way : entry.kind;
      if (kind != PlaceKind::own && is_shown != (kind == PlaceKind::hidden)) continue;
      result.push_back({path.string(), kind, entry.target});
      around.emplace_back(path, kind);
    }
    return result;
  }

 private:
  /// Where a directory is closed to the user that root's programs become, the sandbox has one of its own that
  /// shows the entries. Links in it may be a student's, so nothing is shown because they lead there. What is
  /// hidden of it stays hidden.
  void show_real(const fs::path& real) {
    std::error_code none;
    if (!is_closed(real)) return set(real, PlaceKind::shown);
    set(real, PlaceKind::hidden);
    for (const auto& entry : fs::directory_iterator(real, none)) {
      const auto known = places_.find(entry.path());
      if (known != places_.end() && known->second.kind == PlaceKind::hidden) continue;
      if (entry.is_symlink(none))
        places_.try_emplace(entry.path(), Entry{PlaceKind::link, fs::read_symlink(entry, none).string()});
      else
        show_real(entry.path());
    }
  }

  struct Entry {
    PlaceKind kind;
    std::string target;
  };

  static std::deque<fs::path> names_of(const fs::path& path) {
    std::deque<fs::path> names;
    for (const fs::path& name : path.relative_path())
      if (!name.empty() && name != ".") names.push_back(name);
    return names;
  }

  std::map<fs::path, Entry> places_;  // a path comes before those that begin with it
};

void show_system(Plan& plan) {
  for (const char* const place : system_places) plan.show(place);
  for (const char* const name : settings) plan.show(std::string("/etc/") + name);
  std::error_code none;
  for (const auto& entry : fs::directory_iterator("/etc", none)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("java-") || name.starts_with("python3.")) plan.show(entry.path().string());
  }
}

void refuse_own(const std::string& path) {
  std::error_code none;
  const fs::path real = without_end_slash(fs::weakly_canonical(path, none));
  if (real == "/tmp" || real == sandbox_directory)
    throw std::runtime_error(path +
                             ": programs have a directory of their own at this place, so it cannot be "
                             "shown to them; move the files into another directory");
}

}  // namespace

bool lies_in(const fs::path& path, const fs::path& directory) {
  return std::mismatch(directory.begin(), directory.end(), path.begin(), path.end()).first == directory.end();
}

std::vector<Place> places_of(const SandboxView& view) {
  Plan plan;
  show_system(plan);
  for (const fs::path& path : places_of_plumb()) plan.hide(path);
  for (const std::string& path : view.readable) {
    refuse_own(path);
    plan.show(path);
  }
  for (const std::string& path : view.hidden) plan.hide(path);
  for (const char* const path : {"/dev", "/proc", "/tmp"}) plan.set(path, PlaceKind::own);
  return plan.in_order();
}

}  // namespace plumb::submissions
