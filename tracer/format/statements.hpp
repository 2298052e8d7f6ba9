// One function for each statement of the course grammar. `tokens` holds what follows the keyword.
#pragma once

#include <string_view>
#include <vector>

#include "tracer/format/line.hpp"

namespace plumb {

void read_material(Line& line, const Token& keyword, std::vector<Token>& tokens);
void read_shape(Line& line, const Token& keyword, std::vector<Token>& tokens);
void read_light(Line& line, const Token& keyword, std::vector<Token>& tokens);
void read_camera(Line& line, const Token& keyword, std::vector<Token>& tokens);
void read_transform(Line& line, const Token& keyword, std::vector<Token>& tokens);
void read_render(Line& line, const Token& keyword, std::vector<Token>& tokens);

/// Reads the line at the front of the text when it is a valid sphere or box in the usual spelling: single
/// blanks, no comment. Returns its length without the end of the line. For any other line it returns 0 and
/// changes nothing; read_shape and the others know what is wrong.
std::size_t read_plain_shape(Draft& draft, std::string_view text, int line);

/// Reads `ambient r g b` and `background r g b`. `earlier_line` is the line of an earlier one, or 0.
void read_colour(Line& line, const Token& keyword, const std::vector<Token>& tokens, Rgbd& colour,
                 int& earlier_line);

}  // namespace plumb
