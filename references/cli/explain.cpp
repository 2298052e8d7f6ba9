#include "references/report/explain.hpp"

#include <cstdio>
#include <memory>

#include "references/cli/commands.hpp"
#include "references/cli/handed_in_picture.hpp"
#include "references/cli/options.hpp"
#include "references/diagnosis/pixel_beside.hpp"
#include "references/renderers/ours.hpp"
#include "references/renderers/registry.hpp"
#include "references/system/json.hpp"
#include "tracer/format/reader.hpp"
#include "tracer/system/files.hpp"

namespace plumb::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::string scene;
  int x = 0;
  int y = 0;
  bool stored = false;
  std::string image;  ///< of another tracer; empty when none was given
  std::string json;
  gates::PictureOptions picture;
};

/// The reference's colour of the pixel, or why there is none.
struct ReferencePixel {
  std::optional<Rgbd> colour;
  std::string from;
};

/// A picture of pixels with as many rays as are not traced here may take the reference for ever.
constexpr double time_limit_when_cut_seconds = 10;

ReferencePixel reference_pixel(const Options& options, const Shot& shot, bool is_cut) {
  try {
    renderers::ReferenceOptions asked;
    asked.stored = options.stored;
    if (is_cut) asked.time_limit_seconds = time_limit_when_cut_seconds;
    const auto renderer = renderers::reference_renderer(asked).renderer;
    const Image image = renderer->render(shot).image;
    if (const std::string complaint = renderer->complaint(); !complaint.empty()) warn(complaint);
    const float* const p = image.pixel(options.x, options.y);
    return {Rgbd(p[0], p[1], p[2]), renderer->facts().title + " " + renderer->version()};
  } catch (const std::runtime_error& error) {
    return {std::nullopt, error.what()};
  }
}

void print_colour(const char* name, const Rgbd& c, const std::string& from) {
  std::printf("%-11s%.9g %.9g %.9g%s\n", name, c.x, c.y, c.z, from.c_str());
}

void print_tree(const Options& options, const Shot& shot, const attribution::RayNode& tree) {
  const std::string note = report::cut_note(tree);
  std::printf("pixel (%d, %d) of %s, %d x %d\n%s", options.x, options.y, options.scene.c_str(), shot.width,
              shot.height, report::explain_text(shot.scene, tree).c_str());
  if (!note.empty()) std::printf("note       %s\n", note.c_str());
  print_colour("ours", tree.colour, note.empty() ? "" : "   of the rays that were traced");
}

/// The engine's colour of the pixel, as `verify` compares it. Nothing where the pixel has more rays than are
/// traced here: the picture may take for ever.
std::optional<Rgbd> engine_pixel(const Options& options, const Shot& shot, bool is_cut) {
  if (is_cut) return std::nullopt;
  const Image image = renderers::OurRenderer(renderers::OwnTracer::engine).render(shot).image;
  const float* const p = image.pixel(options.x, options.y);
  return Rgbd(p[0], p[1], p[2]);
}

/// Of two tracers that agree nothing is said.
std::string note_of(const attribution::RayNode& tree, const std::optional<Rgbd>& engine) {
  return engine ? report::engine_note(tree.colour, *engine) : std::string();
}

void print_engine(const attribution::RayNode& tree, const std::optional<Rgbd>& engine) {
  const std::string note = note_of(tree, engine);
  if (!note.empty()) print_colour("engine", *engine, "   " + note);
}

void print_reference(const attribution::RayNode& tree, const ReferencePixel& reference) {
  if (!reference.colour) {
    std::printf("reference  none: %s\n", reference.from.c_str());
    return;
  }
  print_colour("reference", *reference.colour, "   " + reference.from);
  if (!attribution::is_cut(tree)) print_colour("difference", tree.colour - *reference.colour, "");
}

using BesideOurs = std::optional<diagnosis::PixelBeside>;

/// What the picture of another tracer has at the pixel; nothing when none was given.
BesideOurs pixel_of(const std::optional<ImageFile>& seen, const Options& options, const Shot& shot,
                    bool is_cut) {
  if (!seen) return std::nullopt;
  if (is_cut)
    throw std::invalid_argument(
        "--image: found a pixel of more rays than are traced here, expected fewer; choose a smaller --depth");
  return diagnosis::pixel_beside(shot, *seen, options.x, options.y);
}

void print_beside(const Options& options, const BesideOurs& beside) {
  if (!beside) return;
  const auto print = [](const char* name, const std::array<double, 3>& c, const std::string& from) {
    std::printf("%-11s%.9g %.9g %.9g   %s\n", name, c[0], c[1], c[2], from.c_str());
  };
  std::printf("in %s:\n", options.image.c_str());
  print("yours", beside->seen, "");
  print("expected", beside->expected, beside->encoding.in_words());
}

Json to_json(const Options& options, const BesideOurs& beside) {
  if (!beside) return {};
  return {{"file", options.image},
          {"yours", beside->seen},
          {"expected", beside->expected},
          {"encoding", beside->encoding.in_words()}};
}

Json to_json(const Options& options, const Shot& shot, const attribution::RayNode& tree,
             const std::optional<Rgbd>& engine, const ReferencePixel& reference, const BesideOurs& beside) {
  const auto list = [](const Rgbd& c) { return Json{c.x, c.y, c.z}; };
  return {{"tool", "plumb"},
          {"version", PLUMB_VERSION},
          {"scene", options.scene},
          {"x", options.x},
          {"y", options.y},
          {"width", shot.width},
          {"height", shot.height},
          {"ours", list(tree.colour)},
          {"engine", engine ? list(*engine) : Json()},
          {"engine_note", note_of(tree, engine)},
          {"reference", reference.colour ? list(*reference.colour) : Json()},
          {"reference_from", reference.from},
          {"image", to_json(options, beside)},
          {"is_cut", attribution::is_cut(tree)},
          {"note", report::cut_note(tree)},
          {"tree", report::explain_json(shot.scene, tree)}};
}

void check_pixel(const Options& options, const Shot& shot) {
  if (options.x < shot.width && options.y < shot.height) return;
  throw std::invalid_argument("found pixel " + std::to_string(options.x) + " " + std::to_string(options.y) +
                              ", expected one of the picture, " + std::to_string(shot.width) + " x " +
                              std::to_string(shot.height) + ", counted from 0, row 0 on top");
}

int run_explain(const Options& options) {
  const Scene scene = load_scene(options.scene, options.picture.dialect, warn);
  Shot shot = shot_of(scene, options.picture);
  std::optional<ImageFile> seen;
  if (!options.image.empty())
    seen = handed_in_picture(options.image, options.scene, options.picture, shot).seen;
  check_pixel(options, shot);
  const attribution::TreeTracer tracer(shot);
  const attribution::RayNode tree = tracer.tree_of(options.x, options.y);
  const bool prints = options.json != "-", is_cut = attribution::is_cut(tree);
  const BesideOurs beside = pixel_of(seen, options, shot, is_cut);
  if (prints) print_tree(options, shot, tree);
  const std::optional<Rgbd> engine = engine_pixel(options, shot, is_cut);
  if (prints) print_engine(tree, engine);
  if (prints) print_beside(options, beside);
  if (prints) flush_output();  // the reference renders the whole picture, which may take a while
  const ReferencePixel reference = reference_pixel(options, shot, is_cut);
  if (prints) print_reference(tree, reference);
  if (options.json.empty()) return exit_agrees;
  const Json json = to_json(options, shot, tree, engine, reference, beside);
  // Indented, 3,000 rays of depth 256 are hundreds of megabytes of blanks.
  const int indent = is_cut ? -1 : 2;
  write_file(options.json, system::json_text_of_any_bytes(json, indent) + "\n");
  return exit_agrees;
}

}  // namespace

Command explain_command() {
  auto options = std::make_shared<Options>();
  return {
      .name = "explain",
      .purpose = "Print the rays of one pixel: what each meets, every term of every light, and the sum.",
      .footer =
          "Example: plumb explain tests/scenes/mirror.sdf 80 60 --image mine.ppm\n"
          "Points and lengths are in world space. Exit codes: 0 explained, 2 trouble.",
      .options = joined(
          {{{"SCENE", &options->scene, "scene file", {.is_required = true}},
            {"X", &options->x, "column, counted from 0", {.is_required = true, .range = within(0, 65534)}},
            {"Y",
             &options->y,
             "row, counted from 0, row 0 on top",
             {.is_required = true, .range = within(0, 65534)}},
            {"--image",
             &options->image,
             "picture of another tracer: its levels at the pixel stand beside those that a right tracer "
             "writes",
             {.value = "IMAGE"}},
            {"--stored", &options->stored, "take the reference's value from the stored images"},
            output_option("--json", options->json, "write the ray tree as JSON")},
           scene_options(options->picture)}),
      .run = [options](auto&) { return run_explain(*options); }};
}

}  // namespace plumb::cli
