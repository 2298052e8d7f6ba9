#include "references/report/atlas.hpp"

#include <array>
#include <cmath>
#include <cstdio>

#include "references/report/html/document.hpp"
#include "references/report/html/escape.hpp"
#include "references/report/html/packing.hpp"
#include "references/studies/stability/pictures.hpp"
#include "tracer/system/in_parallel.hpp"

namespace plumb::report {
namespace {

/// How large an error is, as the style sheet names it, from exact to lost.
const char* size_of(double error) {
  if (std::isnan(error)) return "error-none";
  if (error <= 1e-12) return "error-exact";
  if (error <= 1e-6) return "error-e6";
  if (error <= 0.01) return "error-percent";
  return error < 1 ? "error-more" : "error-lost";
}

/// Of single rays: the error by the condition, both logarithmic, and a line where it breaks first.
std::string drawn_curve(const studies::stability::Row& row) {
  constexpr double width = 136, height = 64, decades = 20;
  const double last = std::log(std::max(row.curve.back().first, 2.0));
  const auto across = [&](double value) { return width * std::log(std::max(value, 1.0)) / last; };
  std::string points;
  std::array<char, 160> text{};
  for (const auto& [value, error] : row.curve) {
    if (std::isnan(error)) continue;
    const double level = 1 + std::log10(std::max(error, std::pow(10, -decades))) / decades;
    std::snprintf(text.data(), text.size(), "%.1f,%.1f ", across(value), 2 + (height - 4) * (1 - level));
    points += text.data();
  }
  std::snprintf(text.data(), text.size(),
                "<line x1=\"%.1f\" x2=\"%.1f\" y1=\"0\" y2=\"%.0f\" stroke=\"#D55E00\"/></svg>at %.2g",
                across(studies::stability::first_break(row)), across(studies::stability::first_break(row)),
                height, studies::stability::first_break(row));
  return "<svg width=\"136\" height=\"64\" role=\"img\" aria-label=\"difference by the condition\">"
         "<rect class=\"ground\" width=\"136\" height=\"64\"/><polyline fill=\"none\" stroke=\"#0072B2\" "
         "points=\"" +
         points + "\"/>" + text.data();
}

/// The failure as it is seen.
std::string picture_cell(const studies::stability::Row& row,
                         const std::optional<studies::stability::FailurePicture>& picture) {
  if (!row.breaks.any()) return "<td></td>";
  if (!picture) return html::element("td", "seen", drawn_curve(row));
  std::array<char, 64> at{};
  std::snprintf(at.data(), at.size(), "at %.2g", 1.5 * studies::stability::first_break(row));
  const std::string place(at.data());
  if (!picture->refused.empty())
    return html::element("td", "", html_escaped(place + ": " + picture->refused));
  return html::element("td", "seen",
                       html::image(base64(picture->seen), row.method + " " + place) +
                           html::image(base64(picture->errors), "difference of " + row.method + " " + place) +
                           "<br>" + place);
}

/// Of each row of each condition; most of the time POV-Ray waits.
std::vector<std::vector<std::optional<studies::stability::FailurePicture>>> pictures_of(
    const std::vector<studies::stability::Condition>& conditions) {
  std::vector<std::vector<std::optional<studies::stability::FailurePicture>>> pictures;
  std::vector<std::pair<std::size_t, std::size_t>> places;
  for (const studies::stability::Condition& condition : conditions) {
    for (std::size_t row = 0; row < condition.rows.size(); ++row) places.emplace_back(pictures.size(), row);
    pictures.emplace_back(condition.rows.size());
  }
  in_parallel(places.size(), 4 * processors(), [&](std::size_t i) {
    const auto [condition, row] = places[i];
    pictures[condition][row] =
        studies::stability::failure_picture(conditions[condition], conditions[condition].rows[row]);
  });
  return pictures;
}

/// A box a value of the condition, coloured by the error there.
std::string map_of(const studies::stability::Row& row) {
  std::string boxes;
  for (const auto& [value, error] : row.curve) {
    std::array<char, 160> box{};
    std::snprintf(box.data(), box.size(), "<i class=\"%s\" title=\"%.3g: error %.1e\"></i>", size_of(error),
                  value, error);
    boxes += box.data();
  }
  return html::element("td", "map", boxes);
}

std::string map_row(const studies::stability::Row& row,
                    const std::optional<studies::stability::FailurePicture>& picture) {
  std::string cells = "<th scope=\"row\" title=\"" + html_escaped(row.source) + "\">" +
                      html_escaped(row.method) + " " + html::element("span", "muted", row.real) + "</th>";
  if (!row.unavailable.empty())
    return html::element(
        "tr", "",
        cells + "<td colspan=\"9\"><b>not measured:</b> " + html_escaped(row.unavailable) + "</td>\n");
  cells += map_of(row);
  const studies::stability::Breaks& b = row.breaks;
  for (const auto& value : {b.missed, b.ulp16, b.e6, b.percent, b.self_shadow})
    cells += html::element("td", "number", value_text(value));
  cells += picture_cell(row, picture);
  const bool breaks = row.breaks.any();
  cells += html::element("td", "", breaks ? html_escaped(row.cause) : "") +
           html::element("td", "", breaks ? html_escaped(row.remedy) : "");
  return html::element("tr", "", cells) + "\n";
}

/// What the colours of the maps mean.
std::string key_of_colours() {
  std::string text = "Largest error of t, of a direction, a point or a pixel: ";
  for (const auto& [error, words] :
       {std::pair(0.0, "to 1e-12"), std::pair(1e-7, "to 1e-6"), std::pair(1e-3, "to 1 %"),
        std::pair(0.1, "more"), std::pair(1.0, "hit lost, or false"),
        std::pair(std::nan(""), "rounding leaves nothing to hit")})
    text += html::element("span", "", html::element("i", size_of(error), "") + words);
  return html::element("p", "error-key", text) + "\n";
}

std::string table_of(const studies::stability::Condition& condition,
                     const std::vector<std::optional<studies::stability::FailurePicture>>& pictures) {
  std::array<char, 64> range{};
  std::snprintf(range.data(), range.size(), " 1 to %.0e, logarithmic", condition.last);
  std::string rows;
  for (std::size_t row = 0; row < condition.rows.size(); ++row)
    rows += map_row(condition.rows[row], pictures[row]);
  return html::element("h2", "", html_escaped(condition.name)) +
         html::table(
             condition.name,
             {"method and its numbers", html_escaped(condition.unit) + range.data(), "missed", "16 ulp",
              "1e-6", "1 %", "meets itself", "past it, and the difference", "cause", "remedy"},
             rows);
}

/// How much of it breaks, in one sentence.
std::string conclusion_of_conditions(const std::vector<studies::stability::Condition>& conditions) {
  std::size_t all = 0, broken = 0, unavailable = 0;
  for (const studies::stability::Condition& condition : conditions) {
    for (const studies::stability::Row& row : condition.rows) {
      ++all;
      if (!row.unavailable.empty()) ++unavailable;
      if (row.breaks.any()) ++broken;
    }
  }
  return std::to_string(broken) + " of " + std::to_string(all) +
         " measurements, each of a method with its numbers under a condition, break within their sweep" +
         (unavailable > 0 ? "; " + std::to_string(unavailable) + " could not be made." : ".");
}

}  // namespace

std::string page_of(const std::vector<studies::stability::Condition>& conditions) {
  std::string body = key_of_colours();
  const auto pictures = pictures_of(conditions);
  for (std::size_t i = 0; i < conditions.size(); ++i) body += table_of(conditions[i], pictures[i]);
  return html::page({"Where methods fail", conclusion_of_conditions(conditions), body, ""});
}

}  // namespace plumb::report
