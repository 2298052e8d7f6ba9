#include "references/report/results_table.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "references/report/formatted.hpp"
#include "references/report/sentences.hpp"

namespace plumb::report {
namespace {

/// The first line, with what follows on lines of its own.
std::string indented(const std::string& message) {
  std::string text;
  for (const char c : message) {
    text += c;
    if (c == '\n') text += "      ";
  }
  return text;
}

std::string terms_text(const std::vector<gates::TermResult>& terms) {
  std::string text;
  for (const gates::TermResult& t : terms) {
    if (!t.comparison) continue;
    text += formatted(" %s %.2g", attribution::to_string(t.term), t.comparison->judged_error);
    if (t.unexplained > 0) text += formatted(" (%zu pixels unexplained)", t.unexplained);
    text += ",";
  }
  if (text.empty()) return " there is none to compare";
  text.pop_back();
  return text;
}

}  // namespace

std::size_t name_width(const std::vector<std::string>& scenes) {
  constexpr std::size_t least = 20;
  constexpr std::size_t most = 60;
  std::size_t width = least;
  for (const std::string& scene : scenes) width = std::max(width, scene.size());
  return std::min(width, most);
}

std::string table_head(std::size_t width) {
  return formatted("%-*s %10s %10s %8s %7s %7s  %s", static_cast<int>(width), "scene", "size", "error",
                   "over", "unexpl.", "unver.", "result");
}

std::string table_row(const gates::SceneResult& r, const std::string& message, std::size_t width) {
  const std::string name =
      r.scene.size() <= width ? r.scene : std::filesystem::path(r.scene).filename().string();
  std::string row = formatted("%-*s ", static_cast<int>(width), name.c_str());
  const bool is_trouble = r.status == gates::Status::error;
  const std::string size = is_trouble ? "-" : std::to_string(r.width) + "x" + std::to_string(r.height);
  if (is_trouble || r.no_figures) {
    row += formatted("%10s %10s %8s %7s %7s  ", size.c_str(), "-", "-", "-", "-");
  } else {
    row += formatted("%10s %10.2g %8zu %7zu %7zu  ", size.c_str(), r.comparison.judged_error,
                     r.comparison.pixels_over, r.budget.count(attribution::Cause::unexplained),
                     r.budget.unverified());
  }
  row += std::string(gates::to_string(r.status)) + (r.stored ? " (stored)" : r.cached ? " (cached)" : "");
  if (!r.terms.empty()) row += "\n      largest error of each term:" + terms_text(r.terms);
  if (r.judgement && r.comparison.pixels_over > 0)
    row += "\n      judged in 113 bits: " + judgement_text(*r.judgement);
  if (!message.empty()) row += "\n      " + indented(message);
  return row;
}

std::string outcome(const gates::VerifyReport& report) {
  const auto count = [&](gates::Status status) {
    return std::count_if(report.scenes.begin(), report.scenes.end(),
                         [&](const gates::SceneResult& s) { return s.status == status; });
  };
  const auto total = report.scenes.size();
  return formatted("%zu scene%s against %s%s %s: %td agree, %td differ, %td in trouble", total,
                   total == 1 ? "" : "s", report.notice.empty() ? "" : "stored images by ",
                   report.reference.title.c_str(), report.reference_version.c_str(),
                   count(gates::Status::agree), count(gates::Status::differ), count(gates::Status::error));
}

}  // namespace plumb::report
