#include "references/cli/own_inputs.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace plumb::cli {
namespace {

namespace fs = std::filesystem;

bool is_one_of(const std::string& word, const std::vector<std::string>& all) {
  return std::find(all.begin(), all.end(), word) != all.end();
}

/// Whether it holds text or a drawing about results: never a scene or a picture.
bool holds_results(const std::string& option) {
  return is_one_of(option, {"--json", "--csv", "--junit", "--stats-json", "--svg"});
}

bool is_output(const std::string& option) {
  return holds_results(option) || is_one_of(option, {"--output", "--diff"});
}

bool is_input_by_name(const fs::path& path) {
  return is_one_of(path.extension().string(), {".sdf", ".ppm", ".pgm", ".pbm", ".pfm", ".png", ".exr", ".tif",
                                               ".tiff", ".bmp", ".tga", ".jpg", ".jpeg", ".hdr"}) ||
         is_one_of(path.filename().string(), {"baselines.json", "bounds.json"});
}

[[noreturn]] void refuse(const std::string& option, const std::string& file) {
  throw std::invalid_argument(option + ": found " + file +
                              ", which is an input, expected the name of another file");
}

}  // namespace

void refuse_to_overwrite_inputs(const CLI::App& command) {
  for (const CLI::Option* const output : command.get_options()) {
    const std::string name = output->get_name();
    if (!is_output(name)) continue;
    for (const std::string& file : output->results()) {
      std::error_code none;
      if (!fs::is_regular_file(file, none)) continue;
      if (holds_results(name) && is_input_by_name(file)) refuse(name, file);
      for (const CLI::Option* const other : command.get_options()) {
        if (is_output(other->get_name())) continue;
        for (const std::string& input : other->results())
          if (fs::equivalent(input, file, none)) refuse(name, file);
      }
    }
  }
}

}  // namespace plumb::cli
