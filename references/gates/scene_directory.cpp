#include "references/gates/scene_directory.hpp"

#include <algorithm>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <string_view>

#include "references/renderers/baselines.hpp"
#include "tracer/text/words.hpp"

namespace plumb::gates {
namespace {

namespace fs = std::filesystem;

/// Walks directories before links to them, so that a scene is named after the place where it lies.
class Walk {
 public:
  explicit Walk(const fs::path& top) : top_(top) {}

  std::vector<std::string> names() {
    visit(top_, "");
    while (!links_.empty()) {
      const std::vector<std::string> links = std::move(links_);
      links_.clear();
      for (const std::string& link : links) visit(top_ / link, link + "/");
    }
    std::sort(names_.begin(), names_.end());
    return names_;
  }

 private:
  void visit(const fs::path& directory, const std::string& prefix) {
    if (!seen_.insert(fs::canonical(directory).native()).second) return;
    std::set<fs::directory_entry> entries;
    for (const auto& entry : fs::directory_iterator(directory)) entries.insert(entry);
    for (const auto& entry : entries) look_at(entry, prefix);
  }

  void look_at(const fs::directory_entry& entry, const std::string& prefix) {
    const fs::path file = entry.path().filename();
    const std::string name = prefix + file.string();
    std::error_code broken_link;
    if (file.native().front() == '.' || name == "baselines") return;
    if (!entry.is_directory(broken_link)) {
      if (file.extension() == ".sdf") names_.push_back(prefix + file.stem().string());
    } else if (entry.is_symlink()) {
      links_.push_back(name);
    } else {
      visit(entry.path(), name + "/");
    }
  }

  fs::path top_;
  std::vector<std::string> names_, links_;
  std::set<std::string> seen_;
};

bool is_plain_word(std::string_view text) {
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.+";
  return !text.empty() && text.front() != '.' && text.find_first_not_of(plain) == std::string_view::npos;
}

}  // namespace

std::string baselines_of(const std::string& directory, const std::string& variant) {
  const fs::path plain = fs::path(directory) / "baselines";
  return (variant.empty() ? plain : plain / variant).string();
}

std::string scene_path(const std::string& directory, const std::string& name) {
  return (fs::path(directory) / (name + ".sdf")).string();
}

std::vector<std::string> scene_names(const std::string& directory) {
  if (!fs::is_directory(directory))
    throw std::runtime_error(directory + ": found no such directory, expected one with scenes, *.sdf");
  return Walk(directory).names();
}

void expect_clear_variant(const std::string& directory, const std::string& variant,
                          const std::vector<std::string>& names) {
  if (!variant.empty() && !is_plain_word(variant))
    throw std::invalid_argument("--variant: found " + in_quotes(variant) +
                                ", expected letters, digits and _ - . + as in linux-gcc12");
  for (const std::string& name : names) {
    const std::string first = name.substr(0, name.find('/'));
    if (first == name || (first != variant && !renderers::Baselines::are_in(baselines_of(directory, first))))
      continue;
    throw std::runtime_error(directory + ": found " + in_quotes(first) +
                             " both as a directory of scenes and as a variant, whose images would lie in one "
                             "place; expected another name for one of them");
  }
}

}  // namespace plumb::gates
