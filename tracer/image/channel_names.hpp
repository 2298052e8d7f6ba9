// Names of channels, for files that name them and for formats that imply them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace plumb {

/// Returns Y, Y A, R G B or R G B A for 1 to 4 channels; nothing for other numbers.
std::vector<std::string> usual_channels(int count);

/// Returns R, G, B, A or Y when the name says so, with or without its layer: R, red, diffuse.R, LeR. Else
/// returns the name without its layer.
std::string channel_role(std::string_view name);

/// Returns the layer of a name: "diffuse." of diffuse.R, "Le" of LeR; empty when there is none.
std::string_view channel_layer(std::string_view name);

/// Returns the order in which channels lie in memory: the layer without a name first, R G B A within a layer,
/// others as they come. Element i is the index in `names` of the channel at place i.
std::vector<std::size_t> channel_order(const std::vector<std::string>& names);

/// Returns the text with a question mark for each byte that is not printable ASCII.
std::string printable(std::string_view text);

}  // namespace plumb
