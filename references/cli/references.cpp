#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "references/cli/commands.hpp"
#include "references/cli/options.hpp"
#include "references/comparison/comparison.hpp"
#include "references/renderers/registry.hpp"
#include "references/renderers/stored.hpp"
#include "references/system/digest.hpp"
#include "tracer/format/reader.hpp"
#include "tracer/system/installation.hpp"

namespace plumb::cli {
namespace {

namespace fs = std::filesystem;

/// The same renderer on another machine may round a float32 differently in its last bits.
constexpr double tolerance = 1e-6;

struct Options {
  bool check = false;
  std::vector<std::string> update;
};

/// How a record names the scenes that plumb comes with, wherever they lie.
constexpr const char* own_scenes = "tests/scenes";

std::string path_of(const std::string& recorded) {
  const fs::path below = fs::path(recorded).lexically_relative(own_scenes);
  if (!below.empty() && *below.begin() != "..") return (data_directory(Data::scenes) / below).string();
  return (fs::path(source_directory()) / recorded).string();
}

std::string recorded_name(const std::string& path) {
  const fs::path below = fs::relative(path, data_directory(Data::scenes));
  if (!below.empty() && *below.begin() != "..") return (own_scenes / below).string();
  if (std::getenv("PLUMB_REFERENCES") == nullptr)
    throw std::invalid_argument(path + ": is none of plumb's own, expected a scene of " +
                                data_directory(Data::scenes) +
                                ", or PLUMB_REFERENCES set to a directory of yours");
  return fs::relative(path, source_directory()).string();
}

std::string complaint_about(const renderers::StoredReferences& stored,
                            const renderers::StoredReference& entry,
                            const renderers::ProgramRenderer& renderer) {
  const Scene scene = load_scene(path_of(entry.scene), Dialect{});
  const Shot shot = shot_of(scene, ShotOptions{});
  if (system::sha256(renderer.exported(shot).text) != entry.export_sha256)
    return "the scene is exported to another text than then";
  const Image reference = stored.load(entry);
  const auto c = comparison::compare(reference, renderer.render(shot).image, tolerance);
  if (c.agrees()) return {};
  return std::to_string(c.pixels_over) + " pixels differ from " + renderer.facts().title + "'s, by up to " +
         std::to_string(c.max_error);
}

int check() {
  const renderers::StoredReferences stored(renderers::StoredReferences::default_directory());
  const auto renderer = renderers::program_renderer({});
  const std::string version = renderer->version();
  const std::string& title = renderer->facts().title;
  std::size_t failures = 0;
  for (const renderers::StoredReference& entry : stored.all()) {
    std::string complaint;
    try {
      complaint = complaint_about(stored, entry, *renderer);
    } catch (const std::exception& error) {
      complaint = error.what();
    }
    const std::string by = entry.version == version ? "" : " (stored by " + title + " " + entry.version + ")";
    std::printf("%-44s %s%s\n", entry.scene.c_str(), complaint.empty() ? "holds" : complaint.c_str(),
                by.c_str());
    flush_output();
    failures += complaint.empty() ? 0 : 1;
  }
  std::printf("%zu stored reference images against %s %s: %zu hold, %zu do not\n", stored.all().size(),
              title.c_str(), version.c_str(), stored.all().size() - failures, failures);
  if (stored.all().empty()) return exit_trouble;
  return failures == 0 ? exit_agrees : exit_differs;
}

int update(const std::vector<std::string>& scenes) {
  renderers::StoredReferences stored(renderers::StoredReferences::default_directory());
  const auto renderer = renderers::program_renderer({});
  const std::string version = renderer->version();
  for (const std::string& path : scenes) {
    const Scene scene = load_scene(path, Dialect{});
    const Shot shot = shot_of(scene, ShotOptions{});
    const renderers::ExportedShot now = renderer->exported(shot);
    const renderers::Rendered picture = renderer->render(shot);
    if (picture.holds != renderers::Holds::float32 || !picture.warnings.empty()) {
      throw std::runtime_error(path + ": not stored, " + renderer->facts().title +
                               " warns: " + picture.warnings);
    }
    renderers::StoredReference entry;
    entry.scene = recorded_name(path);
    entry.image = fs::path(path).stem().string() + ".exr";
    entry.width = shot.width;
    entry.height = shot.height;
    entry.export_sha256 = system::sha256(now.text);
    entry.renderer = now.renderer;
    entry.version = version;
    entry.command = now.command();
    stored.store(entry, picture.image);
    std::printf("%s\n", entry.image.c_str());
  }
  return exit_agrees;
}

}  // namespace

Command references_command() {
  auto options = std::make_shared<Options>();
  return {.name = "references",
          .purpose = "Check or renew the stored reference images.",
          .footer = "Example: plumb references --check\nExit codes: 0 all hold, 1 some do not, 2 trouble.",
          .options = {{"--check", &options->check, "render all of them again with POV-Ray and compare"},
                      {"--update",
                       &options->update,
                       "scenes whose reference images POV-Ray is to make anew",
                       {.value = "SCENE", .excludes = {"--check"}}}},
          .run = [options](auto&) { return options->check ? check() : update(options->update); },
          .wants_an_option = true};
}

}  // namespace plumb::cli
