// What channels are called, in files that name them and in those whose format says it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace plumb {

/// Y, Y A, R G B or R G B A; nothing for other counts.
std::vector<std::string> usual_channels(int count);

/// R, G, B, A or Y when the name says so, with its layer or without: R, red, diffuse.R, LeR. Else the name.
std::string channel_role(std::string_view name);

/// The layer of a name: "diffuse." of diffuse.R, "Le" of LeR; empty without.
std::string_view channel_layer(std::string_view name);

/// Where each channel comes to lie: the layer without a name first, R G B A within a layer, the others as
/// they come. Element i is the place in `names` of what lies at i.
std::vector<std::size_t> channel_order(const std::vector<std::string>& names);

/// Readable: what is no printable ASCII becomes a question mark.
std::string printable(std::string_view text);

}  // namespace plumb
