#include <array>
#include <cmath>
#include <cstdio>

#include "references/report/packing.hpp"
#include "references/studies/stability/atlas.hpp"
#include "references/studies/stability/pictures.hpp"
#include "tracer/system/in_parallel.hpp"

namespace plumb::references::stability {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json json_of(const std::vector<std::pair<double, double>>& pairs) {
  Json all = Json::array();
  for (const auto& [value, y] : pairs) all.push_back({Json(value), std::isnan(y) ? Json() : Json(y)});
  return all;
}

Json json_of(const Row& row) {
  const Breaks& b = row.breaks;
  return {{"method", row.method},
          {"real", row.real},
          {"source", row.source},
          {"status", row.unavailable.empty() ? "measured" : "renderer unavailable"},
          {"measures", row.measures},
          {"breaks",
           {{"missed", json_of(b.missed)},
            {"ulp16", json_of(b.ulp16)},
            {"e6", json_of(b.e6)},
            {"percent", json_of(b.percent)},
            {"self_shadow", json_of(b.self_shadow)}}},
          {"cause", row.unavailable.empty() ? row.cause : row.unavailable},
          {"remedy", row.remedy},
          {"curve", json_of(row.curve)},
          {"wrong", json_of(row.wrong)}};
}

std::string cell(const std::optional<double>& value) {
  std::array<char, 16> text{};
  if (value) std::snprintf(text.data(), text.size(), "%.1e", *value);
  return value ? text.data() : "-";
}

std::string line(const std::array<std::string, 7>& cells) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), "%-22s %-12s %9s %9s %9s %9s %9s\n", cells[0].c_str(),
                cells[1].c_str(), cells[2].c_str(), cells[3].c_str(), cells[4].c_str(), cells[5].c_str(),
                cells[6].c_str());
  return text.data();
}

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  return safe;
}

/// From exact to lost, by Okabe and Ito's palette, which colour-blind readers tell apart.
const char* colour_of(double error) {
  if (std::isnan(error)) return "#BBBBBB";
  if (error <= 1e-12) return "#0072B2";
  if (error <= 1e-6) return "#56B4E9";
  if (error <= 0.01) return "#F0E442";
  return error < 1 ? "#E69F00" : "#000000";
}

/// Of single rays: the error by the condition, both logarithmic, and a line where it breaks first.
std::string drawn_curve(const Row& row) {
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
                "<line x1=%.1f x2=%.1f y1=0 y2=%.0f stroke='#D55E00'/></svg><br>at %.2g",
                across(first_break(row)), across(first_break(row)), height, first_break(row));
  return "<svg width=136 height=64 role=img aria-label='error by the condition'>"
         "<rect width=136 height=64 fill='#f4f4f4'/><polyline fill=none stroke='#0072B2' points='" +
         points + "'/>" + text.data();
}

/// The failure as it is seen.
std::string picture_cell(const Row& row, const std::optional<FailurePicture>& picture) {
  if (!row.breaks.any()) return "<td></td>";
  if (!picture) return "<td class=seen>" + drawn_curve(row) + "</td>";
  std::array<char, 64> at{};
  std::snprintf(at.data(), at.size(), "at %.2g", 1.5 * first_break(row));
  if (!picture->refused.empty())
    return "<td>" + std::string(at.data()) + ": " + escaped(picture->refused) + "</td>";
  const auto image = [](const char* what, const std::string& bytes) {
    return "<img alt='" + std::string(what) + "' title='" + what + "' src='data:image/png;base64," +
           base64(bytes) + "'>";
  };
  return "<td class=seen>" + image("as rendered", picture->seen) + image("its error", picture->errors) +
         "<br>" + at.data() + "</td>";
}

/// Of each row of each condition; most of the time POV-Ray waits.
std::vector<std::vector<std::optional<FailurePicture>>> pictures_of(
    const std::vector<Condition>& conditions) {
  std::vector<std::vector<std::optional<FailurePicture>>> pictures;
  std::vector<std::pair<std::size_t, std::size_t>> places;
  for (const Condition& condition : conditions) {
    for (std::size_t row = 0; row < condition.rows.size(); ++row) places.emplace_back(pictures.size(), row);
    pictures.emplace_back(condition.rows.size());
  }
  in_parallel(places.size(), 4 * processors(), [&](std::size_t i) {
    const auto [condition, row] = places[i];
    pictures[condition][row] = failure_picture(conditions[condition], conditions[condition].rows[row]);
  });
  return pictures;
}

std::string map_row(const Row& row, const std::optional<FailurePicture>& picture) {
  std::string html = "<tr><td title='" + escaped(row.source) + "'>" + escaped(row.method) + "</td><td>" +
                     row.real + "</td><td class=map>";
  if (!row.unavailable.empty())
    return html + "</td><td colspan=8><b>not measured:</b> " + escaped(row.unavailable) + "</td></tr>\n";
  for (const auto& [value, error] : row.curve) {
    std::array<char, 160> box{};
    std::snprintf(box.data(), box.size(), "<i style='background:%s' title='%.3g: error %.1e'></i>",
                  colour_of(error), value, error);
    html += box.data();
  }
  const Breaks& b = row.breaks;
  html += "</td>";
  for (const auto& value : {b.missed, b.ulp16, b.e6, b.percent, b.self_shadow})
    html += "<td>" + cell(value) + "</td>";
  html += picture_cell(row, picture);
  if (!row.breaks.any()) return html + "<td></td><td></td></tr>\n";
  return html + "<td>" + escaped(row.cause) + "</td><td>" + escaped(row.remedy) + "</td></tr>\n";
}

}  // namespace

nlohmann::ordered_json to_json(const std::vector<Condition>& conditions) {
  Json list = Json::array();
  for (const Condition& condition : conditions) {
    Json rows = Json::array();
    for (const Row& row : condition.rows) rows.push_back(json_of(row));
    list.push_back({{"name", condition.name}, {"unit", condition.unit}, {"rows", std::move(rows)}});
  }
  return {{"tool", "plumb"}, {"version", PLUMB_VERSION}, {"conditions", std::move(list)}};
}

std::string table_of(const std::vector<Condition>& conditions) {
  std::string text;
  for (const Condition& condition : conditions) {
    text += condition.name + ": " + condition.unit + ", first value at which a ray fails\n";
    text += line({"method", "real", "missed", "16 ulp", "1e-6", "1 %", "itself"});
    for (const Row& row : condition.rows) {
      if (!row.unavailable.empty()) {
        text += row.method + ": not measured: " + row.unavailable + "\n";
        continue;
      }
      const Breaks& b = row.breaks;
      text += line({row.method, row.real, cell(b.missed), cell(b.ulp16), cell(b.e6), cell(b.percent),
                    cell(b.self_shadow)});
    }
    text += "\n";
  }
  return text;
}

std::string page_of(const std::vector<Condition>& conditions) {
  std::string html =
      "<!DOCTYPE html><html lang=en><meta charset=utf-8><title>Where methods fail</title><style>"
      "body{font:14px sans-serif;margin:2em;color:#222}table{border-collapse:collapse;margin-bottom:2em}"
      "td,th{padding:2px 6px;text-align:left;border-bottom:1px solid #ddd}.map{white-space:nowrap}"
      ".map i,.key i{display:inline-block;width:10px;height:16px}.key span{margin-right:1.5em}"
      ".seen,td:nth-child(-n+2){white-space:nowrap}.seen img{margin-right:2px}</style>"
      "<h1>Where methods fail</h1><p class=key>Largest error of t, of a direction, a point or a pixel: ";
  for (const auto& [error, words] :
       {std::pair(0.0, "to 1e-12"), std::pair(1e-7, "to 1e-6"), std::pair(1e-3, "to 1 %"),
        std::pair(0.1, "more"), std::pair(1.0, "hit lost, or false"),
        std::pair(std::nan(""), "rounding leaves nothing to hit")})
    html += std::string("<span><i style='background:") + colour_of(error) + "'></i> " + words + "</span>";
  html += "</p>\n";
  const auto pictures = pictures_of(conditions);
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    const Condition& condition = conditions[i];
    std::array<char, 64> range{};
    std::snprintf(range.data(), range.size(), " 1 to %.0e, logarithmic", condition.last);
    html += "<h2>" + condition.name + "</h2><table><tr><th>method</th><th>real</th><th>" + condition.unit +
            range.data() +
            "</th><th>missed</th><th>16 ulp</th><th>1e-6</th><th>1 %</th><th>meets itself</th>"
            "<th>seen past it, and its error</th><th>cause</th><th>remedy</th></tr>\n";
    for (std::size_t row = 0; row < condition.rows.size(); ++row)
      html += map_row(condition.rows[row], pictures[i][row]);
    html += "</table>\n";
  }
  return html + "</html>\n";
}

}  // namespace plumb::references::stability
