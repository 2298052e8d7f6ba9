#include "references/cli/layers_option.hpp"

#include <algorithm>
#include <cstdio>
#include <sstream>
#include <stdexcept>

#include "references/report/layer_pictures.hpp"
#include "tracer/image/format.hpp"
#include "tracer/image/image_writer.hpp"
#include "tracer/image/io.hpp"
#include "tracer/text/words.hpp"

namespace plumb::cli {
namespace {

using textbook::Layer;

constexpr Word<Layer> names[] = {
    {"normal", Layer::normal},   {"depth", Layer::depth},          {"point", Layer::point},
    {"object", Layer::object},   {"shadow", Layer::shadow},        {"direction", Layer::direction},
    {"ambient", Layer::ambient}, {"diffuse", Layer::diffuse},      {"specular", Layer::specular},
    {"mirror", Layer::mirror},   {"refraction", Layer::refraction}};

std::string all_names() {
  std::string all;
  for (const auto& each : names) all += (all.empty() ? "" : ", ") + std::string(each.word);
  return all;
}

std::vector<Layer> layers_named(const std::string& text) {
  std::vector<Layer> layers;
  std::istringstream words(text + ",");  // ended by a comma each, the last and an empty one, too
  for (std::string word; std::getline(words, word, ',');) {
    const Layer layer = layer_named("--layers", word);
    if (std::ranges::find(layers, layer) != layers.end())
      throw std::invalid_argument("--layers: found " + in_quotes(word) +
                                  " twice, expected each layer once; leave one out");
    layers.push_back(layer);
  }
  return layers;
}

}  // namespace

Layer layer_named(const std::string& option, const std::string& name) {
  std::vector<std::string_view> candidates;
  for (const auto& each : names) {
    if (name == each.word) return each.value;
    candidates.emplace_back(each.word);
  }
  const auto nearest = nearest_name(name, candidates);
  throw std::invalid_argument(option + ": found " + in_quotes(name) + ", expected " +
                              (nearest ? "'" + *nearest + "', or another of " : "some of ") + all_names());
}

Option layers_option(std::vector<Layer>& layers) {
  return {"--layers",
          [&layers](const std::string& text) { layers = layers_named(text); },
          "render with the textbook tracer in double, and add what the first ray of each pixel meets and the "
          "terms of its colour as channels of the EXR, with a PNG of each beside it: " +
              all_names() + ", joined by commas",
          {.value = "NAMES",
           .excludes = {"--stats", "--stats-json", "--samples", "--fault", "--error", "--real", "--engine",
                        "--encode"},
           .needs = {"--output"}}};
}

void write_layers(const std::string& path, const Shot& shot, const RenderJob& job,
                  const std::vector<Layer>& layers) {
  if (path == "-" || extension_of(path) != ".exr") {
    throw std::invalid_argument("--layers: found " + in_quotes(path) +
                                " to write, expected a name that ends in .exr; pass -o NAME.exr");
  }
  const ImageFile rendered = textbook::render_layers(shot.scene, shot.camera, job, layers);
  write_channels(path, rendered);
  std::printf("%s\n", path.c_str());
  const std::string stem = path.substr(0, path.size() - std::string_view(".exr").size());
  for (const Layer layer : layers) {
    const std::string file = stem + "." + word_for(layer, names) + ".png";
    write_image(file, report::picture_of(layer, rendered, layers, shot.scene), report::encoding_of(layer));
    std::printf("%s\n", file.c_str());
  }
}

}  // namespace plumb::cli
