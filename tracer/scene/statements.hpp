// One function for each statement of the course grammar. `tokens` is what follows the keyword.
#pragma once

#include <vector>

#include "tracer/scene/line.hpp"

namespace plumb {

void read_material(Line& line, const Token& keyword, std::vector<Token>& tokens);
void read_shape(Line& line, const Token& keyword, std::vector<Token>& tokens);
void read_light(Line& line, const Token& keyword, std::vector<Token>& tokens);
void read_camera(Line& line, const Token& keyword, std::vector<Token>& tokens);
void read_transform(Line& line, const Token& keyword, std::vector<Token>& tokens);
void read_render(Line& line, const Token& keyword, std::vector<Token>& tokens);

/// `ambient r g b` and `background r g b`; `earlier_line` is that of an earlier one, or 0.
void read_colour(Line& line, const Token& keyword, const std::vector<Token>& tokens, Rgbd& colour,
                 int& earlier_line);

}  // namespace plumb
