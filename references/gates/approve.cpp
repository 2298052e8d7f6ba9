#include "references/gates/approve.hpp"

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <string_view>

#include "references/gates/approved_images.hpp"
#include "references/system/digest.hpp"
#include "tracer/format/reader.hpp"
#include "tracer/text/shell_word.hpp"
#include "tracer/text/words.hpp"

namespace plumb::gates {
namespace {

namespace fs = std::filesystem;

bool is_among(const std::vector<std::string>& sorted, const std::string& name) {
  return std::binary_search(sorted.begin(), sorted.end(), name);
}

std::string now() {
  const std::time_t time = std::time(nullptr);
  std::tm utc{};
  char text[sizeof "2000-01-01T00:00:00Z"];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", gmtime_r(&time, &utc));
  return text;
}

/// Returns the part of a path behind the directory, if the path leads into it; else the text as it stands.
std::string part_within(const std::string& text, const std::string& directory) {
  const fs::path path(text);
  const fs::path lexical = path.lexically_normal().lexically_relative(fs::path(directory).lexically_normal());
  if (!lexical.empty() && *lexical.begin() != ".." && lexical != ".") return lexical.string();
  if (!path.has_parent_path()) return text;
  const fs::path real = fs::weakly_canonical(path.parent_path()).lexically_relative(fs::canonical(directory));
  if (real.empty() || *real.begin() == "..") return text;
  return (real / path.filename()).lexically_normal().string();
}

/// Returns the name of the scene, or of the baseline without a scene, that the text means.
std::string name_meant(const std::string& text, const std::string& directory,
                       const std::vector<std::string>& known) {
  const std::string within = part_within(text, directory);
  constexpr std::string_view extension = ".sdf";
  const bool is_file = within.ends_with(extension);
  const std::string name = is_file ? within.substr(0, within.size() - extension.size()) : within;
  if (is_among(known, name)) return name;
  if (is_among(known, within)) return within;
  const auto nearest = nearest_name(name, {known.begin(), known.end()});
  throw std::invalid_argument("--update: found " + in_quotes(text) + ", expected a scene in " + directory +
                              (nearest ? "; did you mean '" + *nearest + "'?" : ""));
}

/// Returns the command that renders the image, in the directory of the scenes.
std::string command_of(const std::string& name, const RegressOptions& options,
                       const ApprovalRequest& request) {
  if (options.other) return options.other->facts().name;
  const std::string file = (name.front() == '-' ? "./" : "") + name + ".sdf";  // not to be an option
  const fs::path image = fs::path("baselines") / options.variant / (name + ".exr");
  return "plumb render " + shell_word(file) + " -o " + shell_word(image.string()) + request.arguments;
}

renderers::Baseline record_of(const std::string& path, const std::string& name, const RegressOptions& options,
                              const ApprovalRequest& request) {
  renderers::Baseline record;
  record.name = name;
  record.who = request.who;
  record.when = now();
  record.why = request.why;
  record.version = PLUMB_VERSION;
  record.scene_sha256 = system::sha256(read_text_file(path));
  record.command = command_of(name, options, request);
  if (options.other) record.renderer = options.other->facts().name;
  return record;
}

/// True if the baseline holds this image. A damaged one does not, so it is approved anew.
bool holds(const renderers::Baselines& baselines, const renderers::Baseline& record, const Image& image) {
  try {
    const Image approved = baselines.load(record);
    return approved.width == image.width && approved.height == image.height && approved.rgb == image.rgb;
  } catch (const std::runtime_error&) {
    return false;
  }
}

/// Says who approved this very image of this very scene before; empty when nobody did.
std::string approved_before(const ApprovedImages& approved, const renderers::Baseline& record,
                            const Image& image) {
  const auto found = approved.find(record.name);
  if (!found) return {};
  const renderers::Baseline& before = *found->record;
  const bool is_same = before.scene_sha256 == record.scene_sha256 && before.renderer == record.renderer &&
                       (before.command == record.command || !approved.has_own(record.name)) &&
                       holds(*found->baselines, before, image);
  return is_same ? "as " + before.who + " approved it, " + before.when + ": " + before.why : "";
}

void refuse_non_finite(const Image& image, const std::string& path) {
  const std::string complaint = non_finite_pixels(image);
  if (complaint.empty()) return;
  throw std::runtime_error(path + ": not approved, nothing is stored: " + complaint +
                           "; is a light or a colour far too bright?");
}

std::vector<std::string> sorted_union(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  std::sort(a.begin(), a.end());
  a.erase(std::unique(a.begin(), a.end()), a.end());
  return a;
}

}  // namespace

namespace {

std::vector<std::string> meant(const std::string& directory, const std::vector<std::string>& scenes,
                               const ApprovedImages& approved, const ApprovalRequest& request) {
  const std::vector<std::string> known = sorted_union(scenes, approved.names());
  std::vector<std::string> names;
  for (const std::string& text : request.scenes) names.push_back(name_meant(text, directory, known));
  if (request.all_new)
    std::copy_if(scenes.begin(), scenes.end(), std::back_inserter(names),
                 [&](const std::string& name) { return !approved.find(name); });
  return sorted_union(names, {});
}

/// An update of a variant leaves the plain baselines alone.
void expect_own(const std::string& name, const ApprovedImages& approved, const RegressOptions& options) {
  if (options.variant.empty() || approved.has_own(name) || !approved.find(name)) return;
  throw std::invalid_argument("--update: the scene " + in_quotes(name) +
                              " is gone, and its baseline is a plain one, not of the variant " +
                              in_quotes(options.variant) + "; forget it without --variant");
}

Approved approve_one(const std::string& path, const std::string& name, const ApprovedImages& approved,
                     const RegressOptions& options, const ApprovalRequest& request,
                     renderers::BaselineUpdate& update) {
  const renderers::Baseline record = record_of(path, name, options, request);
  const renderers::Rendered picture = rendered(path, options, request.warn);
  refuse_non_finite(picture.image, path);
  const std::string before = approved_before(approved, record, picture.image);
  if (before.empty()) update.add(record, picture.image);
  return {name,   false,           is_of_one_colour(picture.image), picture.image.width, picture.image.height,
          before, picture.not_read};
}

}  // namespace

std::vector<Approved> approve(const std::string& directory, const RegressOptions& options,
                              const ApprovalRequest& request) {
  const std::vector<std::string> scenes = scene_names(directory);
  if (scenes.empty() && request.all_new)
    throw std::runtime_error(directory + ": found no scene in it, expected at least one *.sdf");
  expect_clear_variant(directory, options.variant, scenes);
  const ApprovedImages approved(directory, options.variant);
  renderers::BaselineUpdate update(baselines_of(directory, options.variant), directory);
  std::vector<Approved> result;
  for (const std::string& name : meant(directory, scenes, approved, request)) {
    if (is_among(scenes, name)) {
      result.push_back(approve_one(scene_path(directory, name), name, approved, options, request, update));
    } else {
      expect_own(name, approved, options);
      update.forget(name);
      result.push_back({name, true});
    }
  }
  update.commit();
  return result;
}

}  // namespace plumb::gates
