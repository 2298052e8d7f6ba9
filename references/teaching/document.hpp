// Writes the matrix and the teaching set as text for people.
#pragma once

#include <string>

#include "references/teaching/cover.hpp"

namespace plumb::teaching {

/// Returns "the right picture", or the fault's id. Pictures are numbered as in Matrix.
std::string picture_name(std::size_t picture);

/// Returns Markdown: the set, what no scene tells apart, and a row for each fault with a column for each
/// scene.
std::string markdown_of(const Matrix& matrix, const TeachingSet& set);

}  // namespace plumb::teaching
