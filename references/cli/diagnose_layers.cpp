#include "references/cli/diagnose_layers.hpp"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "references/cli/handed_in_picture.hpp"
#include "references/cli/layers_option.hpp"
#include "references/cli/options.hpp"
#include "references/cli/told_fault.hpp"
#include "references/report/diagnosis_json.hpp"
#include "tracer/text/words.hpp"

namespace plumb::cli {
namespace {

using Json = nlohmann::ordered_json;
using diagnosis::LayerFault;
using diagnosis::LayerVerdict;
using textbook::Layer;

Layer layer_of(const std::string& name) {
  const Layer layer = layer_named("--layer", name);
  if (layer != Layer::normal && layer != Layer::depth)
    throw std::invalid_argument("--layer: found " + in_quotes(name) +
                                ", expected normal or depth, the layers from which mistakes are told");
  return layer;
}

DiagnosedLayer diagnosed_layer(const std::string& text, const Scene& scene, const std::string& scene_file,
                               const gates::PictureOptions& options) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals + 1 == text.size())
    throw std::invalid_argument("--layer: found " + in_quotes(text) +
                                ", expected a layer and its picture, e.g. normal=normals.png");
  const std::string name = text.substr(0, equals), file = text.substr(equals + 1);
  const Layer layer = layer_of(name);
  Shot shot = shot_of(scene, options);
  const auto picture =
      handed_in_picture(file, scene_file, options, shot, textbook::channels_of(layer, scene));
  return {name, file, diagnosis::diagnose_layer(shot, picture.seen, layer)};
}

const char* word_of(LayerVerdict verdict) {
  switch (verdict) {
    case LayerVerdict::right:
      return "right";
    case LayerVerdict::faults:
      return "faults";
    case LayerVerdict::unexplained:
      break;
  }
  return "unexplained";
}

void print(const LayerFault& found, int hint) {
  const faults::Fault& fault = *found.fault;
  if (hint == 1) {
    std::printf("  look at the slide \"%s\"\n", text_of(fault.slide).c_str());
    return;
  }
  std::printf("  %s (slide \"%s\")\n", text_of(fault.explanation).c_str(), text_of(fault.slide).c_str());
  if (hint == 2) return;
  print_formulas(fault);
  for (const faults::Fault* other : found.alike)
    std::printf("      or     %s: it gives the same layer here\n", text_of(other->id).c_str());
}

Json to_json(const LayerFault& found, int hint) {
  Json json = report::fault_json(*found.fault, hint, Json::object());
  if (hint >= 3) json["alike"] = report::ids_json(found.alike);
  return json;
}

}  // namespace

Option handed_in_layers_option(std::vector<std::string>& layers) {
  return {"--layer",
          &layers,
          "your tracer's own picture of a layer, normal or depth, whose mistake is told from it alone; IMAGE "
          "may then be left out. A file with the channels of plumb render --layers is read by their names",
          {.value = "NAME=FILE", .is_repeatable = true}};
}

std::vector<DiagnosedLayer> diagnosed_layers(const std::vector<std::string>& layers, const Scene& scene,
                                             const std::string& scene_file,
                                             const gates::PictureOptions& options) {
  std::vector<DiagnosedLayer> all;
  for (const std::string& layer : layers) all.push_back(diagnosed_layer(layer, scene, scene_file, options));
  return all;
}

void print(const DiagnosedLayer& layer, int hint) {
  const diagnosis::LayerDiagnosis& d = layer.diagnosis;
  const std::string head = layer.file + ": " + layer.name;
  const double share = 100.0 * static_cast<double>(d.explained) / static_cast<double>(d.pixels);
  switch (d.verdict) {
    case LayerVerdict::right:
      std::printf("%s: right, written as %s (%.1f %% of %zu pixels)\n", head.c_str(), d.encoding.c_str(),
                  share, d.pixels);
      return;
    case LayerVerdict::faults:
      std::printf("%s: %zu fault%s explain%s it, written as %s (%.1f %% of %zu pixels)\n", head.c_str(),
                  d.faults.size(), d.faults.size() == 1 ? "" : "s", d.faults.size() == 1 ? "s" : "",
                  d.encoding.c_str(), share, d.pixels);
      for (const LayerFault& found : d.faults) print(found, hint);
      return;
    case LayerVerdict::unexplained:
      std::printf("%s: no fault, and no two, explain 99 %% of it\n", head.c_str());
  }
}

Json to_json(const std::vector<DiagnosedLayer>& layers, int hint) {
  Json all = Json::array();
  for (const auto& [name, file, d] : layers) {
    Json faults = Json::array();
    for (const LayerFault& found : d.faults) faults.push_back(to_json(found, hint));
    all.push_back({{"layer", name},
                   {"file", file},
                   {"verdict", word_of(d.verdict)},
                   {"faults", faults},
                   {"encoding", d.encoding.empty() ? Json() : Json(d.encoding)},
                   {"pixels", d.pixels},
                   {"explained", d.explained}});
  }
  return all;
}

int exit_code_of(const std::vector<DiagnosedLayer>& layers) {
  const auto any = [&](LayerVerdict verdict) {
    return std::ranges::any_of(
        layers, [&](const DiagnosedLayer& layer) { return layer.diagnosis.verdict == verdict; });
  };
  if (any(LayerVerdict::faults)) return exit_differs;
  return any(LayerVerdict::unexplained) ? exit_abstains : exit_agrees;
}

}  // namespace plumb::cli
