// What `plumb render --layers` does.
#pragma once

#include <string>
#include <vector>

#include "references/cli/command_line.hpp"
#include "tracer/scene/shot.hpp"
#include "tracer/textbook/layers.hpp"

namespace plumb::cli {

/// An option whose value is names of layers, joined by commas. `layers` must outlive it.
Option layers_option(std::vector<textbook::Layer>& layers);

/// Returns the layer of that name. Throws std::invalid_argument, beginning with the option's name.
textbook::Layer layer_named(const std::string& option, const std::string& name);

/// Writes the picture and its layers to the EXR that `path` names, and a PNG of each layer beside it. Prints
/// the names of all files that it writes.
void write_layers(const std::string& path, const Shot& shot, const RenderJob& job,
                  const std::vector<textbook::Layer>& layers);

}  // namespace plumb::cli
