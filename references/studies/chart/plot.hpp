// Draws a chart as a picture, with matplotlib.
#pragma once

#include <string>
#include <vector>

namespace plumb::studies {

/// The python that draws: Debian's own, for which python3-matplotlib is installed.
inline const std::vector<std::string> usual_python{"/usr/bin/python3"};

/// Throws std::runtime_error naming the package when matplotlib is missing, before minutes are spent on
/// measuring.
void check_plotting(const std::vector<std::string>& python = usual_python);

/// Draws the JSON of a chart into files. Their extension is their format: .svg, .png. Throws
/// std::runtime_error.
void plot_chart(const std::string& json, const std::vector<std::string>& files,
                const std::vector<std::string>& python = usual_python);

}  // namespace plumb::studies
