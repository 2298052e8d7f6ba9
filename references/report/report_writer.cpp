#include "references/report/report_writer.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "references/attribution/causes.hpp"
#include "references/report/conclusion.hpp"
#include "references/report/html/own_page.hpp"
#include "references/report/html/packing.hpp"
#include "references/report/html/thumbnail.hpp"
#include "references/report/page.hpp"
#include "references/report/picture.hpp"
#include "references/report/script_json.hpp"
#include "references/system/digest.hpp"
#include "tracer/system/files.hpp"

namespace plumb::report {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t hash_size = 16;

void make_directory(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (!fs::is_directory(path)) {
    throw std::runtime_error(path + ": cannot be made a directory for the report: " + error.message());
  }
}

/// NUMBER-HASH.js: what reports name their pictures, and hardly anybody else.
bool is_name_of_picture(const fs::path& path) {
  const std::string stem = path.stem().string();
  const std::size_t dash = stem.find('-');
  return path.extension() == ".js" && dash != std::string::npos && dash > 0 &&
         stem.size() == dash + 1 + hash_size && stem.find_first_not_of("0123456789") == dash &&
         stem.find_first_not_of("0123456789abcdef", dash + 1) == std::string::npos;
}

std::string data_url(const std::string& png) { return "data:image/png;base64," + base64(png); }

Json json_of(const ReportEntry& entry) {
  Json json{{"name", entry.name},
            {"result", entry.result},
            {"conclusion", conclusion_of(entry.result)},
            {"causes", causes_of(entry)},
            {"explain", entry.explain_command},
            {"approve", entry.approve_command}};
  if (!entry.reference || !entry.test) return json;
  json["width"] = entry.test->width;
  json["height"] = entry.test->height;
  json["thumbnail"] = data_url(thumbnail(*entry.test, entry.test_is_encoded));
  json["encoded"] = {{"reference", entry.reference_is_encoded}, {"test", entry.test_is_encoded}};
  json["error_thumbnail"] = data_url(error_thumbnail(*entry.reference, *entry.test));
  return json;
}

/// With the colours of their pixels.
Json known_causes() {
  Json causes = Json::array();
  for (const attribution::CauseRow& row : attribution::cause_rows())
    causes.push_back({{"name", row.name}, {"colour", row.colour}});
  return causes;
}

}  // namespace

ReportWriter::ReportWriter(std::string directory, std::string title, std::string subtitle,
                           std::size_t most_inline)
    : directory_(std::move(directory)),
      title_(std::move(title)),
      subtitle_(std::move(subtitle)),
      most_inline_(most_inline) {
  make_directory(directory_);
  refuse_to_replace_others((fs::path(directory_) / "index.html").string());
}

void ReportWriter::add(const ReportEntry& entry) {
  Picture picture;
  if (entry.reference && entry.test) {
    const std::string packed = deflated(picture_bytes(entry));
    picture.text = base64(packed);
    picture.id = system::sha256(picture.text).substr(0, hash_size);
  }
  Json json = json_of(entry);
  const std::lock_guard lock(mutex_);
  // By number and content: an earlier report keeps its own pictures until it is replaced.
  if (!picture.id.empty()) picture.id = std::to_string(pictures_.size()) + "-" + picture.id;
  json["picture"] = picture.id;
  scenes_.push_back(std::move(json));
  inline_bytes_ += picture.text.size();
  pictures_.push_back(std::move(picture));
  if (inline_bytes_ <= most_inline_) return;
  is_beside_ = true;
  for (Picture& each : pictures_) move_beside(each);
}

void ReportWriter::move_beside(Picture& picture) const {
  if (picture.text.empty()) return;
  const std::string folder = directory_ + "/pictures";
  make_directory(folder);
  // A classic script: pages that were opened as files may not fetch, but may load scripts.
  write_file(folder + "/" + picture.id + ".js",
             "plumb_picture(\"" + picture.id + "\",\"" + picture.text + "\");\n");
  picture.text = std::string();
}

std::string ReportWriter::blocks() const {
  const Json report{{"title", title_},
                    {"subtitle", subtitle_},
                    {"version", PLUMB_VERSION},
                    {"side_files", is_beside_},
                    {"conclusion", conclusion_of_all(scenes_)},
                    {"causes", known_causes()},
                    {"scenes", scenes_}};
  std::string html =
      "<script type=\"application/json\" id=\"report-data\">" + script_json(report) + "</script>\n";
  for (const Picture& picture : pictures_) {
    if (picture.text.empty()) continue;
    html += "<script type=\"text/plain\" id=\"picture-" + picture.id + "\">" + picture.text + "</script>\n";
  }
  return html;
}

void ReportWriter::finish() {
  const std::lock_guard lock(mutex_);
  write_file(directory_ + "/index.html",
             assembled_page(title_, conclusion_of_all(scenes_), blocks(), is_beside_));
  remove_old_pictures();
}

void ReportWriter::remove_old_pictures() const {
  const fs::path folder = directory_ + "/pictures";
  if (!fs::is_directory(folder)) return;
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (!is_name_of_picture(entry.path())) continue;
    const std::string id = entry.path().stem().string();
    const bool is_used = is_beside_ && std::any_of(pictures_.begin(), pictures_.end(),
                                                   [&](const Picture& p) { return p.id == id; });
    if (!is_used) old.push_back(entry.path());
  }
  std::error_code ignored;  // what stays costs only room
  for (const fs::path& path : old) fs::remove(path, ignored);
  if (fs::is_empty(folder, ignored)) fs::remove(folder, ignored);
}

}  // namespace plumb::report
