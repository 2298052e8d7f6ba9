#include "references/teaching/document.hpp"

#include <algorithm>

namespace plumb::teaching {
namespace {

std::string padded(std::string_view text, std::size_t width) {
  return std::string(text) + std::string(width - std::min(width, text.size()), ' ');
}

/// Columns in groups of ten, so that they can be counted.
std::string row_of(std::string_view name, std::size_t width, const std::string& cells) {
  std::string row = padded(name, width);
  for (std::size_t i = 0; i < cells.size(); ++i) row += (i % 10 == 0 ? " " : "") + std::string(1, cells[i]);
  while (row.ends_with(' ')) row.pop_back();
  return row + "\n";
}

std::size_t widest_id() {
  std::size_t width = 0;
  for (const faults::Fault& fault : faults::fault_catalogue()) width = std::max(width, fault.id.size());
  return width;
}

std::string matrix_rows(const Matrix& matrix) {
  const std::size_t scenes = matrix.scenes().size();
  std::string tens;
  std::string units;
  for (std::size_t i = 1; i <= scenes; ++i) {
    tens += i % 10 == 0 ? static_cast<char>('0' + i / 10 % 10) : ' ';
    units += static_cast<char>('0' + i % 10);
  }
  const std::size_t width = widest_id();
  std::string text = row_of("", width, tens) + row_of("", width, units);
  for (std::size_t fault = 0; fault < faults::fault_catalogue().size(); ++fault) {
    std::string cells;
    for (std::size_t i = 0; i < scenes; ++i) cells += matrix.shows(i, fault) ? '#' : '.';
    text += row_of(faults::fault_catalogue()[fault].id, width, cells);
  }
  return text;
}

std::string scene_table(const Matrix& matrix) {
  std::string text = "| | scene | faults seen |\n|---|---|---|\n";
  for (std::size_t i = 0; i < matrix.scenes().size(); ++i) {
    std::size_t seen = 0;
    for (std::size_t fault = 0; fault < faults::fault_catalogue().size(); ++fault)
      seen += matrix.shows(i, fault);
    text += "| " + std::to_string(i + 1) + " | [" + matrix.scenes()[i] + "](" + matrix.scenes()[i] + ") | " +
            std::to_string(seen) + " |\n";
  }
  return text;
}

std::string set_text(const Matrix& matrix, const TeachingSet& set) {
  std::string text = std::to_string(set.scenes.size()) + " scenes tell all " +
                     std::to_string(faults::fault_catalogue().size()) +
                     " faults apart, from each other and from the "
                     "right picture" +
                     (set.left.empty() ? "" : ", but for the pairs below") + "; " +
                     (set.is_proven ? "fewer do not.\n\n" : "that fewer would not is not proven.\n\n");
  for (const std::size_t scene : set.scenes) text += "- `" + matrix.scenes()[scene] + "`\n";
  if (set.left.empty()) return text;
  text += "\nNo scene here tells apart:\n\n";
  for (const Pair& pair : set.left)
    text += "- " + picture_name(pair.a) + " and " + picture_name(pair.b) + "\n";
  return text;
}

}  // namespace

std::string picture_name(std::size_t picture) {
  return picture == 0 ? "the right picture" : std::string(faults::fault_catalogue()[picture - 1].id);
}

std::string markdown_of(const Matrix& matrix, const TeachingSet& set) {
  return "# Which scene reveals which mistake\n\n"
         "Written by `build/plumb faults --corpus tests/scenes > tests/scenes/TEACHING.md`: every fault of "
         "the "
         "catalogue rendered in every scene at " +
         std::to_string(matrix_width) + " x " + std::to_string(matrix_height) +
         " pixels, tone-mapped and truncated to 8 bits. Two pictures are told apart where more than half a "
         "percent "
         "of the pixels have a component more than 2 levels away.\n\n## The teaching set\n\n" +
         set_text(matrix, set) +
         "\n## The matrix\n\n`#`: the fault is seen in the scene of that number; `plumb faults` explains "
         "each "
         "fault.\n\n```\n" +
         matrix_rows(matrix) + "```\n\n## The scenes\n\n" + scene_table(matrix);
}

}  // namespace plumb::teaching
