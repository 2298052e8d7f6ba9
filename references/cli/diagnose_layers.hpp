// What `plumb diagnose --layer` does.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "references/cli/command_line.hpp"
#include "references/diagnosis/layer_diagnosis.hpp"
#include "references/gates/picture_options.hpp"

namespace plumb::cli {

/// A layer that was handed in, and what is wrong with it.
struct DiagnosedLayer {
  std::string name;  ///< normal or depth
  std::string file;
  diagnosis::LayerDiagnosis diagnosis;
};

/// An option whose values are NAME=FILE. `layers` must outlive it.
Option handed_in_layers_option(std::vector<std::string>& layers);

/// Diagnoses each NAME=FILE of the scene that `scene_file` names. Throws std::invalid_argument for an unknown
/// layer, and what handed_in_picture() throws.
std::vector<DiagnosedLayer> diagnosed_layers(const std::vector<std::string>& layers, const Scene& scene,
                                             const std::string& scene_file,
                                             const gates::PictureOptions& options);

void print(const DiagnosedLayer& layer, int hint);
nlohmann::ordered_json to_json(const std::vector<DiagnosedLayer>& layers, int hint);

/// 0 where all are right, 1 where faults explain one, else 3.
int exit_code_of(const std::vector<DiagnosedLayer>& layers);

}  // namespace plumb::cli
