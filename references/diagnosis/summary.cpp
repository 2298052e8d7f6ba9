#include <algorithm>
#include <cctype>
#include <string>

#include "references/diagnosis/diagnosis.hpp"

namespace plumb::diagnosis {
namespace {

std::string count_text(std::size_t count, std::size_t of) {
  return std::to_string(count) + " of " + std::to_string(of) + " pixels";
}

std::string in_words(const ShapeSeen& shape) {
  return shape.name.empty() ? std::string("the background") : "'" + shape.name + "'";
}

/// E.g. "where nothing is hit, it is black".
std::string as_clause(const Habit& habit) {
  std::string text = habit.title.substr(0, habit.title.size() - 1);
  text.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(text.front())));
  return text;
}

std::string shapes_in_words(const std::vector<ShapeSeen>& shapes) {
  constexpr std::size_t most = 3;
  if (shapes.size() == 1) return "all on " + in_words(shapes.front());
  std::string text;
  for (std::size_t i = 0; i < std::min(most, shapes.size()); ++i)
    text += (i == 0 ? "" : ", ") + std::to_string(shapes[i].pixels) + " on " + in_words(shapes[i]);
  return shapes.size() > most ? text + ", others elsewhere" : text;
}

std::string not_right_in_words(const Diagnosis& d) {
  switch (d.verdict) {
    case PictureVerdict::right:
      return {};
    case PictureVerdict::right_apart:
      if (d.explains_all() && !d.habits.empty()) return "right, with habits";
      return "right apart from " + count_text(d.unexplained_pixels, d.pixels) + ", " +
             shapes_in_words(d.shapes);
    case PictureVerdict::faults:
      return d.explains_all()
                 ? std::string()
                 : "explains a part; " + count_text(d.unexplained_pixels, d.pixels) + " have another cause";
    case PictureVerdict::unexplained:
      break;
  }
  return count_text(d.unexplained_pixels, d.pixels) + " are not right" +
         (d.is_of_one_colour ? std::string("; ") + one_colour_tells_nothing : std::string());
}

}  // namespace

std::string summary_of(const Diagnosis& diagnosis) {
  std::string text = not_right_in_words(diagnosis);
  if (diagnosis.certain.camera == Certainty::right && diagnosis.verdict == PictureVerdict::unexplained)
    text += "; the camera is right";
  for (const Habit& habit : diagnosis.habits) text += "; " + as_clause(habit);
  if (diagnosis.non_finite == 0) return text;
  return text + (text.empty() ? "" : "; ") + std::to_string(diagnosis.non_finite) +
         (diagnosis.non_finite == 1 ? " pixel is not finite" : " pixels are not finite");
}

}  // namespace plumb::diagnosis
