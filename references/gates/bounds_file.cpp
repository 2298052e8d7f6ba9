#include "references/gates/bounds_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "references/system/json.hpp"
#include "tracer/system/files.hpp"
#include "tracer/text/words.hpp"

namespace plumb::gates {
namespace {

using Json = nlohmann::json;

/// Refuses two equal keys, of which the library would silently keep the last.
Json parsed(const std::string& path) {
  std::vector<std::set<std::string>> open;
  const auto refuse_twins = [&](int, Json::parse_event_t event, const Json& value) {
    if (event == Json::parse_event_t::object_start) open.emplace_back();
    if (event == Json::parse_event_t::object_end) open.pop_back();
    if (event == Json::parse_event_t::key && !open.back().insert(value.get<std::string>()).second)
      throw std::runtime_error(path + ": found " + in_quotes(value.get<std::string>()) +
                               " twice, expected it once");
    return true;
  };
  try {
    return Json::parse(read_file(path), refuse_twins);
  } catch (const Json::exception& error) {
    throw std::runtime_error(path + ": cannot be read as JSON: " + error.what());
  }
}

bool is_blank(const std::string& text) { return text.find_first_not_of(" \t\r\n") == std::string::npos; }

/// Turns an error of the command line into one of the file.
auto in_file(const auto& parse) {
  try {
    return parse();
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(error.what());
  }
}

}  // namespace

/// Reads one entry.
class BoundsFile::Reader {
 public:
  Reader(const std::string& path, const std::string& name)
      : directory_(std::filesystem::path(path).parent_path().string()),
        where_(path + ": " + in_quotes(name)) {}

  Entry read(const Json& json) const {
    if (!json.is_object()) fail("", json, "an object with a \"because\"");
    Entry entry;
    for (const auto& [key, value] : json.items()) read_key(key, value, entry);
    if (!json.contains("because"))
      throw std::runtime_error(where_ + ": found no \"because\", expected one that says why this is allowed");
    return entry;
  }

 private:
  void read_key(const std::string& key, const Json& value, Entry& entry) const {
    if (key == "tolerance") {
      entry.tolerance = number(key, value);
    } else if (key == "relative") {
      entry.relative = number(key, value);
    } else if (key == "allow_over") {
      entry.allow_over = allow_over(key, value);
    } else if (key == "ignore") {
      entry.ignore = regions(key, value);
    } else if (key == "only") {
      entry.only = regions(key, value);
    } else if (key == "because") {
      entry.because = because(key, value);
    } else {
      throw std::runtime_error(where_ + ": found the key " + in_quotes(key) +
                               ", expected tolerance, relative, allow_over, ignore, only or because");
    }
  }

  [[noreturn]] void fail(const std::string& key, const Json& found, const std::string& expected) const {
    throw std::runtime_error(where_ + (key.empty() ? "" : ": " + in_quotes(key)) + ": found " +
                             system::json_text_of_any_bytes(found) + ", expected " + expected);
  }

  double number(const std::string& key, const Json& value) const {
    if (!value.is_number() || !(value.get<double>() >= 0) || !std::isfinite(value.get<double>()))
      fail(key, value, "a finite number >= 0");
    return value.get<double>();
  }

  AllowOver allow_over(const std::string& key, const Json& value) const {
    if (!value.is_number_unsigned() && !value.is_string())
      fail(key, value, "a number of pixels or a percentage of them, e.g. 12 or \"0.5%\"");
    return in_file([&] {
      return parse_allow_over(value.is_string() ? value.get<std::string>() : system::json_text(value),
                              where_ + ": " + key);
    });
  }

  std::vector<Region> regions(const std::string& key, const Json& value) const {
    const Json list = value.is_array() ? value : Json::array({value});
    std::vector<Region> regions;
    for (const Json& each : list) {
      if (!each.is_string() || is_blank(each.get<std::string>()))
        fail(key, each, "\"X,Y,W,H\", the path of a mask image, or a list of these");
      regions.push_back(
          in_file([&] { return parse_region(each.get<std::string>(), where_ + ": " + key, directory_); }));
    }
    if (regions.empty()) fail(key, value, "at least one region");
    return regions;
  }

  std::string because(const std::string& key, const Json& value) const {
    if (!value.is_string() || is_blank(value.get<std::string>())) fail(key, value, "why this is allowed");
    return value.get<std::string>();
  }

  std::string directory_;
  std::string where_;
};

BoundsFile::BoundsFile(const std::string& directory)
    : path_((std::filesystem::path(directory) / file_name).string()) {
  if (!std::filesystem::exists(path_)) return;
  const Json json = parsed(path_);
  if (!json.is_object())
    throw std::runtime_error(path_ + ": found no object, expected one whose keys are names of pictures");
  for (const auto& [name, entry] : json.items()) entries_[name] = Reader(path_, name).read(entry);
}

Bounds BoundsFile::bounds_of(const std::string& name, const Bounds& usual) const {
  Bounds bounds = usual;
  const auto found = entries_.find(name);
  if (found == entries_.end()) return bounds;
  const Entry& entry = found->second;
  bounds.limit = {entry.tolerance.value_or(usual.limit.tolerance),
                  entry.relative.value_or(usual.limit.relative)};
  bounds.allow_over = entry.allow_over.value_or(usual.allow_over);
  bounds.ignore.insert(bounds.ignore.end(), entry.ignore.begin(), entry.ignore.end());
  bounds.only.insert(bounds.only.end(), entry.only.begin(), entry.only.end());
  bounds.because = entry.because;
  return bounds;
}

std::vector<std::string> BoundsFile::mask_paths() const {
  std::vector<std::string> paths;
  for (const auto& [name, entry] : entries_) {
    const std::vector<std::string> masks = bounds_of(name, {}).mask_paths();
    paths.insert(paths.end(), masks.begin(), masks.end());
  }
  return paths;
}

std::string BoundsFile::complaint_about_others(const std::vector<std::string>& names) const {
  for (const auto& [name, entry] : entries_) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    return path_ + ": found bounds of " + in_quotes(name) + ", expected the name of one that is compared";
  }
  return {};
}

}  // namespace plumb::gates
