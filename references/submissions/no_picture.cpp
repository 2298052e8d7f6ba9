#include "references/submissions/no_picture.hpp"

#include <array>
#include <cctype>
#include <filesystem>
#include <string_view>

#include "references/submissions/shown_text.hpp"

namespace plumb::submissions {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_shown = 3;

struct Magic {
  std::string_view bytes;
  const char* kind;
};
constexpr std::array binary_kinds{Magic{"\x89PNG\r\n", "PNG"},   Magic{"\x76\x2f\x31\x01", "EXR"},
                                  Magic{"II*", "TIFF"},          Magic{"MM\0*", "TIFF"},
                                  Magic{"\xff\xd8\xff", "JPEG"}, Magic{"#?RADIANCE", "HDR"}};

/// P1 to P6, PF or Pf, then a blank and the width or a comment.
std::string netpbm_at(std::string_view text) {
  const auto is_blank = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  if (text.size() < 4 || text[0] != 'P' || !is_blank(text[2])) return {};
  if (std::string_view("123456Ff").find(text[1]) == std::string_view::npos) return {};
  std::size_t at = 2;
  while (at < text.size() && is_blank(text[at])) ++at;
  const bool has_width =
      at < text.size() && (text[at] == '#' || std::isdigit(static_cast<unsigned char>(text[at])) != 0);
  if (!has_width) return {};
  return std::string(text[1] == 'F' || text[1] == 'f' ? "PFM" : "PPM") + " (" +
         std::string(text.substr(0, 2)) + ")";
}

std::string image_at(std::string_view text) {
  for (const Magic& magic : binary_kinds)
    if (text.starts_with(magic.bytes)) return magic.kind;
  return netpbm_at(text);
}

std::string list_of(const std::vector<std::string>& names) {
  std::string list;
  for (std::size_t i = 0; i < names.size() && i < most_shown; ++i) list += (i == 0 ? "" : ", ") + names[i];
  return list + (names.size() > most_shown ? " and others" : "");
}

}  // namespace

std::string printed_image(const std::string& printed) {
  for (std::size_t at = 0; at < printed.size();) {
    std::string kind = image_at(std::string_view(printed).substr(at));
    if (!kind.empty()) return kind;
    const std::size_t end = printed.find('\n', at);
    at = end == std::string::npos ? printed.size() : end + 1;
  }
  return {};
}

std::vector<std::string> files_left_in(const std::string& directory, const std::string& but) {
  constexpr std::size_t longest_name = 60;
  std::vector<std::string> names;
  std::error_code error;
  fs::recursive_directory_iterator at(directory, fs::directory_options::skip_permission_denied, error);
  for (; !error && at != fs::recursive_directory_iterator() && names.size() <= most_shown;
       at.increment(error)) {
    std::error_code gone;
    const std::string name = at->path().lexically_relative(directory).string();
    const auto status = at->symlink_status(gone);
    if (fs::is_regular_file(status) && name != but) names.push_back(shown_name(name).substr(0, longest_name));
  }
  return names;
}

std::string why_no_picture(const std::string& printed, const std::vector<std::string>& left,
                           const std::string& expected) {
  if (const std::string kind = printed_image(printed); !kind.empty()) {
    return "the picture was printed to standard output as " + kind +
           ", expected it in the file {image}: write " +
           "it there, or, where all print it, judge --renderer 'sh -c \"\\\"$@\\\" > \\\"$0\\\"\" {image} "
           "COMMAND'";
  }
  if (!left.empty())
    return "wrote " + list_of(left) + ", expected " + expected + ": write to the path {image}";
  return "wrote nothing, no file and no picture on standard output; expected " + expected;
}

}  // namespace plumb::submissions
