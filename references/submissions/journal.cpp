#include "references/submissions/journal.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "references/submissions/record.hpp"
#include "references/system/json.hpp"

namespace plumb::submissions {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view head = "{\"plumb judge\":\"results of a run that has not ended\"}\n";
constexpr std::string_view key_begins = "{\"key\":\"";
constexpr std::size_t key_size = 64;  // of a SHA-256 in hexadecimal

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw std::runtime_error(path + ": " + what);
}

int open_journal(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (file < 0) fail(path, std::string("cannot be written: ") + std::strerror(errno));
  return file;
}

std::string key_of(const std::string& line) {
  return line.starts_with(key_begins) ? line.substr(key_begins.size(), key_size) : std::string();
}

}  // namespace

Journal::Journal(const std::string& path) : path_(path), file_(open_journal(path)) {
  if (::flock(file_.number(), LOCK_EX | LOCK_NB) != 0)
    fail(path, "another plumb judge keeps its results here; wait for it, or give --resume another file");
  read_lines();
}

/// Reads line by line, because lines with pictures are long.
void Journal::read_lines() {
  std::ifstream in(path_, std::ios::binary);
  std::string line;
  while (std::getline(in, line)) {
    const bool is_torn = in.eof();  // there is no line feed at its end
    const bool is_head = is_torn ? head.starts_with(line) : line + "\n" == head;
    if (size_ == 0 && !is_head)
      fail(path_, "found something else than results that plumb judge keeps; give --resume another file");
    if (is_torn) break;
    if (const std::string key = key_of(line); key.size() == key_size) lines_[key] = {size_, line.size()};
    size_ += line.size() + 1;
  }
  found_ = lines_.size();
  if (::ftruncate(file_.number(), static_cast<off_t>(size_)) != 0)
    fail(path_, std::string("cannot be written: ") + std::strerror(errno));
  if (size_ == 0) append(std::string(head));
}

void Journal::append(const std::string& line) {
  std::size_t done = 0;
  while (done < line.size()) {
    const ssize_t written = ::write(file_.number(), line.data() + done, line.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written > 0) {
      done += static_cast<std::size_t>(written);
      continue;
    }
    const int error = written < 0 ? errno : ENOSPC;
    static_cast<void>(!::ftruncate(file_.number(), static_cast<off_t>(size_)));
    fail(path_, std::string("cannot be written: ") + std::strerror(error));
  }
  size_ += line.size();
}

std::string Journal::line_at(const KeptLine& line) const {
  std::string bytes(line.size, '\0');
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t got =
        ::pread(file_.number(), bytes.data() + done, bytes.size() - done, static_cast<off_t>(line.at + done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) fail(path_, "cannot be read");
    done += static_cast<std::size_t>(got);
  }
  return bytes;
}

std::optional<JudgedPicture> Journal::find(const std::string& key) const {
  const std::scoped_lock lock(mutex_);
  const auto line = lines_.find(key);
  if (line == lines_.end()) return std::nullopt;
  try {
    JudgedPicture picture =
        picture_of_record(system::parse_ordered_json(line_at(line->second)).at("picture"));
    picture.kept = line->second;
    return picture;
  } catch (const std::exception&) {
    return std::nullopt;  // what cannot be read is judged anew
  }
}

void Journal::keep(const std::string& key, JudgedPicture& picture,
                   const std::optional<report::html::ThreePictures>& pictures) {
  Json json{{"key", key}, {"picture", record_of(picture)}};
  if (pictures) json["pictures"] = {pictures->right, pictures->yours, pictures->difference};
  const std::string line = system::json_text_of_any_bytes(json);
  const std::scoped_lock lock(mutex_);
  const KeptLine kept{size_, line.size()};
  append(line + "\n");
  lines_[key] = picture.kept = kept;
}

std::optional<report::html::ThreePictures> Journal::pictures_of(const JudgedPicture& picture) const {
  if (picture.kept.size == 0) return std::nullopt;
  const std::scoped_lock lock(mutex_);
  const Json line = system::parse_ordered_json(line_at(picture.kept));
  if (!line.contains("pictures")) return std::nullopt;
  const Json& three = line.at("pictures");
  return report::html::ThreePictures{three.at(0), three.at(1), three.at(2)};
}

void Journal::remove() {
  if (::unlink(path_.c_str()) != 0 && errno != ENOENT)
    fail(path_, std::string("cannot be removed: ") + std::strerror(errno));
}

}  // namespace plumb::submissions
