#include "tracer/system/leftovers.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>

#include "tracer/system/descriptor.hpp"

namespace plumb {
namespace {

namespace fs = std::filesystem;
using Number = unsigned long long;

constexpr std::string_view prefix = "plumb-";

struct Owner {
  Number space;  ///< of process numbers
  Number process;
  Number start;  ///< in ticks since the machine's start
};

/// Returns the number in the link pid:[4026531836]; 0 where there is no /proc.
Number own_space() {
  std::error_code none;
  const std::string link = fs::read_symlink("/proc/self/ns/pid", none).string();
  const std::size_t digits = link.find_first_of("0123456789");
  return digits == std::string::npos ? 0 : std::strtoull(link.c_str() + digits, nullptr, 10);
}

/// Returns field 22 of /proc/pid/stat, see proc(5); the name before it may hold blanks and parentheses.
/// Returns 0 when there is no such process.
Number start_of(Number process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::size_t name_end = text.rfind(')');
  if (name_end == std::string::npos) return 0;
  std::istringstream fields(text.substr(name_end + 1));
  std::string field;
  for (int i = 3; i <= 22; ++i) fields >> field;
  return std::strtoull(field.c_str(), nullptr, 10);
}

/// Returns the owner in a name that temporary_name() began.
std::optional<Owner> owner_in(std::string_view name) {
  if (name.starts_with('.')) name.remove_prefix(1);
  if (!name.starts_with(prefix)) return std::nullopt;
  const char* at = name.data() + prefix.size();
  const char* const end = name.data() + name.size();
  Owner owner{};
  for (Number* const number : {&owner.space, &owner.process, &owner.start}) {
    const auto [after, error] = std::from_chars(at, end, *number);
    if (error != std::errc() || after == end || *after != '-') return std::nullopt;
    at = after + 1;
  }
  const bool is_random = at != end && std::all_of(at, end, [](unsigned char c) { return std::isalnum(c); });
  return is_random ? std::optional(owner) : std::nullopt;
}

/// True for this user. Root's confined runs belong to users of their own, see
/// references/submissions/sandbox/sandbox.cpp.
bool is_of_this_user(uid_t user) {
  constexpr uid_t first_confined = 1'900'000'000;
  constexpr uid_t last_confined = 2'000'000'000;
  return user == ::geteuid() || (::geteuid() == 0 && user >= first_confined && user <= last_confined);
}

bool is_running(const Owner& owner, const struct stat& info) {
  // The owner claims a thing a moment after making it; its process number means nothing in another space.
  constexpr std::time_t moment_seconds = 60;
  if (owner.space != own_space()) return std::time(nullptr) - info.st_mtim.tv_sec < moment_seconds;
  return owner.start != 0 && start_of(owner.process) == owner.start;
}

/// True if somebody has locked it. Where there are no locks, only the number of the process tells.
bool is_claimed(const std::string& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  return file.number() >= 0 && ::flock(file.number(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

/// A confined program may have left directories that not even their owner may enter.
void make_removable(const fs::path& directory) {
  std::error_code ignored;
  fs::permissions(directory, fs::perms::owner_all, fs::perm_options::add, ignored);
  for (fs::recursive_directory_iterator at(directory, ignored), end; !ignored && at != end;
       at.increment(ignored)) {
    if (fs::is_directory(at->symlink_status(ignored)))
      fs::permissions(at->path(), fs::perms::owner_all, fs::perm_options::add, ignored);
  }
}

void remove_if_left(const fs::path& path) {
  const std::optional<Owner> owner = owner_in(path.filename().native());
  struct stat info {};
  if (!owner || ::lstat(path.c_str(), &info) != 0 || !is_of_this_user(info.st_uid)) return;
  if (!S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode)) return;
  if (is_running(*owner, info) || is_claimed(path)) return;
  std::error_code error;
  fs::remove_all(path, error);
  if (!error || !S_ISDIR(info.st_mode)) return;
  make_removable(path);
  fs::remove_all(path, error);
}

/// True the first time that it is asked about a directory.
bool is_new(const std::string& directory) {
  static std::mutex mutex;
  static std::set<std::string> seen;
  const std::lock_guard lock(mutex);
  return seen.insert(directory).second;
}

}  // namespace

std::string temporary_name() {
  static const std::string name = std::string(prefix) + std::to_string(own_space()) + "-" +
                                  std::to_string(::getpid()) + "-" +
                                  std::to_string(start_of(static_cast<Number>(::getpid()))) + "-";
  return name;
}

void claim_temporary(int descriptor) {
  // Where there are no locks, the number of the process has to do.
  static_cast<void>(::flock(descriptor, LOCK_EX | LOCK_NB));
}

void remove_leftovers(const std::string& directory) {
  if (!is_new(directory)) return;
  std::error_code error;
  std::set<fs::path> paths;
  for (fs::directory_iterator at(directory, error), end; !error && at != end; at.increment(error)) {
    if (owner_in(at->path().filename().native())) paths.insert(at->path());
  }
  for (const fs::path& path : paths) remove_if_left(path);
}

}  // namespace plumb
