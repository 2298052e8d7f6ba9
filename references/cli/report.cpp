#include "references/cli/report.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>

#include "references/system/json.hpp"
#include "tracer/system/files.hpp"

namespace plumb::cli {
namespace {

using references::SceneResult;
using references::Status;

std::string formatted(const char* format, const auto&... values) {
  std::string text(static_cast<std::size_t>(std::snprintf(nullptr, 0, format, values...)), '\0');
  std::snprintf(text.data(), text.size() + 1, format, values...);
  return text;
}

/// The first line, with what follows on lines of its own.
std::string indented(const std::string& message) {
  std::string text;
  for (const char c : message) {
    text += c;
    if (c == '\n') text += "      ";
  }
  return text;
}

std::string terms_text(const std::vector<references::TermResult>& terms) {
  std::string text;
  for (const references::TermResult& t : terms) {
    if (!t.comparison) continue;
    text += formatted(" %s %.2g", references::to_string(t.term), t.comparison->judged_error);
    if (t.unexplained > 0) text += formatted(" (%zu pixels unexplained)", t.unexplained);
    text += ",";
  }
  if (text.empty()) return " there is none to compare";
  text.pop_back();
  return text;
}

constexpr references::Verdict all_verdicts[] = {
    references::Verdict::ours_wrong, references::Verdict::reference_wrong, references::Verdict::both_wrong,
    references::Verdict::undecided};

/// What the scene has none of differs by nothing; what could not be compared has no figures.
Json to_json(const references::TermResult& t) {
  if (t.in_scene && !t.comparison)
    return {{"in_scene", true}, {"max_error", nullptr}, {"pixels_over", nullptr}, {"unexplained", nullptr}};
  const references::Comparison c = t.comparison.value_or(references::Comparison{});
  return {{"in_scene", t.in_scene},
          {"max_error", c.max_error},
          {"pixels_over", c.pixels_over},
          {"unexplained", t.unexplained}};
}

Json flip_json(const references::Flip& flip) {
  Json json{{"kind", flip.exposures ? "HDR" : "LDR"}, {"mean", flip.mean}, {"max", flip.max}};
  if (const auto& e = flip.exposures) {
    json["exposures"] = {{"start", e->start}, {"stop", e->stop}, {"count", e->count}};
  }
  return json;
}

constexpr std::array figures{"max_error",   "judged_error", "mean_error", "rms_error",
                             "pixels_over", "non_finite",   "worst",      "metrics",
                             "budget",      "unexamined",   "unverified", "shapes"};

}  // namespace

std::string judgement_text(const references::Judgement& judgement) {
  std::string text;
  for (const references::Verdict verdict : all_verdicts) {
    std::string name = to_string(verdict);
    std::replace(name.begin(), name.end(), '_', ' ');
    text += formatted("%s%s %zu", text.empty() ? "" : ", ", name.c_str(), judgement.count(verdict));
  }
  return text;
}

Json scene_json(const SceneResult& r) {
  Json json{{"scene", r.scene},
            {"status", to_string(r.status)},
            {"message", r.message},
            {"width", r.width},
            {"height", r.height}};
  json.update(plumb::cli::to_json(r.comparison));
  const bool has_figures = r.status != Status::error && r.not_compared.empty();
  json["metrics"] = plumb::cli::to_json(r.metrics);
  json["budget"] = plumb::cli::to_json(r.budget);
  json["unexamined"] = r.budget.unexamined;
  json["unverified"] = r.budget.unverified();
  json["shapes"] = r.budget.shapes;
  for (const char* const key : figures)
    if (!has_figures) json[key] = nullptr;  // 0 would say that nothing differs
  for (const references::TermResult& t : r.terms) json["terms"][references::to_string(t.term)] = to_json(t);
  if (r.judgement) json["judgement"] = plumb::cli::to_json(*r.judgement);
  json["seconds"] = {{"ours", r.seconds_ours}, {"reference", r.seconds_reference}};
  json["cached"] = r.cached;
  return json;
}

Json to_json(const references::Budget& budget) {
  Json json;
  for (std::size_t i = 0; i < references::cause_count; ++i) {
    const auto cause = static_cast<references::Cause>(i);
    json[references::to_string(cause)] = budget.count(cause);
  }
  return json;
}

Json to_json(const references::Judgement& judgement) {
  Json json;
  for (const references::Verdict verdict : all_verdicts) json[to_string(verdict)] = judgement.count(verdict);
  json["not_judged"] = judgement.not_judged;
  Json& pixels = json["pixels"] = Json::array();
  for (const references::JudgedPixel& p : judgement.pixels) {
    pixels.push_back({{"x", p.x},
                      {"y", p.y},
                      {"verdict", to_string(p.verdict)},
                      {"ours", p.ours},
                      {"reference", p.reference},
                      {"oracle", {p.oracle.x, p.oracle.y, p.oracle.z}}});
  }
  return json;
}

Json to_json(const references::Comparison& c) {
  return {{"max_error", c.max_error},
          {"judged_error", c.judged_error},
          {"mean_error", c.mean_error},
          {"rms_error", c.rms_error},
          {"pixels_over", c.pixels_over},
          {"non_finite", c.non_finite},
          {"worst",
           {{"x", c.worst.x}, {"y", c.worst.y}, {"ours", c.worst.test}, {"reference", c.worst.reference}}}};
}

Json to_json(const references::Metrics& m) {
  Json json{{"peak", m.peak}, {"psnr_db", m.psnr_db ? Json(*m.psnr_db) : Json()}};
  for (std::size_t i = 0; i < m.percentiles.size(); ++i) {
    const std::size_t permille = references::permilles[i];
    const std::string name =
        "p" + std::to_string(permille / 10) + (permille % 10 ? "." + std::to_string(permille % 10) : "");
    json["percentiles"][name] = m.percentiles[i];
  }
  json["bias"] = m.bias;
  for (std::size_t i = 0; i < m.scalars.size(); ++i)
    json[references::scalar_metrics()[i].key] = m.scalars[i] ? Json(*m.scalars[i]) : Json();
  json["flip"] = m.flip ? flip_json(*m.flip) : Json();
  return json;
}

Json to_json(const references::LikelyCause& c) {
  return {{"name", c.name},
          {"text", c.text},
          {"pixels_over", c.pixels_over},
          {"removed", c.removed},
          {"because", c.because}};
}

std::string cause_text(const references::LikelyCause& c) {
  if (!c.because.empty())
    return formatted("%s (then 0 pixels over, because %s)", c.text.c_str(), c.because.c_str());
  std::string text = formatted("%s (then %zu pixels over", c.text.c_str(), c.pixels_over);
  if (c.pixels_over > 0) text += formatted(", %.4g %% of the squared error gone", 100 * c.removed);
  return text + ")";
}

Json to_json(const references::VerifyReport& report) {
  Json scenes = Json::array();
  for (const SceneResult& result : report.scenes) scenes.push_back(scene_json(result));
  return {{"tool", "plumb"},
          {"version", PLUMB_VERSION},
          {"reference", {{"renderer", report.reference.name}, {"version", report.reference_version}}},
          {"notice", report.notice},
          {"scenes", scenes}};
}

void write_json(const std::string& path, const Json& json) {
  write_file(path, references::json_text_of_any_bytes(json, 2) + "\n");
}

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

std::string table_row(const SceneResult& r, std::size_t width) {
  const std::string name =
      r.scene.size() <= width ? r.scene : std::filesystem::path(r.scene).filename().string();
  std::string row = formatted("%-*s ", static_cast<int>(width), name.c_str());
  const bool is_trouble = r.status == Status::error;
  const std::string size = is_trouble ? "-" : std::to_string(r.width) + "x" + std::to_string(r.height);
  if (is_trouble || !r.not_compared.empty()) {
    row += formatted("%10s %10s %8s %7s %7s  ", size.c_str(), "-", "-", "-", "-");
  } else {
    row += formatted("%10s %10.2g %8zu %7zu %7zu  ", size.c_str(), r.comparison.judged_error,
                     r.comparison.pixels_over, r.budget.count(references::Cause::unexplained),
                     r.budget.unverified());
  }
  row += std::string(to_string(r.status)) + (r.stored ? " (stored)" : r.cached ? " (cached)" : "");
  if (!r.terms.empty()) row += "\n      largest error of each term:" + terms_text(r.terms);
  if (r.judgement && r.comparison.pixels_over > 0)
    row += "\n      judged in 113 bits: " + judgement_text(*r.judgement);
  if (!r.message.empty()) row += "\n      " + indented(r.message);
  return row;
}

std::string outcome(const references::VerifyReport& report) {
  const auto count = [&](Status status) {
    return std::count_if(report.scenes.begin(), report.scenes.end(),
                         [&](const SceneResult& s) { return s.status == status; });
  };
  const auto total = report.scenes.size();
  return formatted("%zu scene%s against %s%s %s: %td agree, %td differ, %td in trouble", total,
                   total == 1 ? "" : "s", report.notice.empty() ? "" : "stored images by ",
                   report.reference.title.c_str(), report.reference_version.c_str(), count(Status::agree),
                   count(Status::differ), count(Status::error));
}

}  // namespace plumb::cli
