#include "references/report/results_json.hpp"

#include <array>

#include "references/report/sentences.hpp"
#include "references/system/json.hpp"
#include "tracer/system/files.hpp"

namespace plumb::report {
namespace {

/// What the scene has none of differs by nothing; what could not be compared has no figures.
Json to_json(const gates::TermResult& t) {
  if (t.in_scene && !t.comparison)
    return {{"in_scene", true}, {"max_error", nullptr}, {"pixels_over", nullptr}, {"unexplained", nullptr}};
  const comparison::Comparison c = t.comparison.value_or(comparison::Comparison{});
  return {{"in_scene", t.in_scene},
          {"max_error", c.max_error},
          {"pixels_over", c.pixels_over},
          {"unexplained", t.unexplained}};
}

Json flip_json(const comparison::Flip& flip) {
  Json json{{"kind", flip.exposures ? "HDR" : "LDR"}, {"mean", flip.mean}, {"max", flip.max}};
  if (const auto& e = flip.exposures) {
    json["exposures"] = {{"start", e->start}, {"stop", e->stop}, {"count", e->count}};
  }
  return json;
}

constexpr std::array keys_of_figures{"max_error",   "judged_error", "mean_error", "rms_error",
                                     "pixels_over", "non_finite",   "worst",      "metrics",
                                     "budget",      "unexamined",   "unverified", "shapes"};

std::vector<std::string> texts_of(const std::vector<gates::Region>& regions) {
  std::vector<std::string> texts;
  for (const gates::Region& region : regions) texts.push_back(region.text);
  return texts;
}

}  // namespace

Json scene_json(const gates::SceneResult& r, const std::string& message) {
  Json json{{"scene", r.scene},
            {"status", gates::to_string(r.status)},
            {"message", message},
            {"width", r.width},
            {"height", r.height}};
  json.update(to_json(r.comparison));
  const bool has_figures = r.status != gates::Status::error && !r.no_figures;
  json["metrics"] = to_json(r.metrics);
  json["budget"] = to_json(r.budget);
  json["unexamined"] = r.budget.unexamined;
  json["unverified"] = r.budget.unverified();
  json["shapes"] = r.budget.shapes;
  for (const char* const key : keys_of_figures)
    if (!has_figures) json[key] = nullptr;  // 0 would say that nothing differs
  for (const gates::TermResult& t : r.terms) json["terms"][attribution::to_string(t.term)] = to_json(t);
  if (r.judgement) json["judgement"] = to_json(*r.judgement);
  json["seconds"] = {{"ours", r.seconds_ours}, {"reference", r.seconds_reference}};
  json["cached"] = r.cached;
  return json;
}

Json to_json(const attribution::Budget& budget) {
  Json json;
  for (std::size_t i = 0; i < attribution::cause_count; ++i) {
    const auto cause = static_cast<attribution::Cause>(i);
    json[attribution::to_string(cause)] = budget.count(cause);
  }
  return json;
}

Json to_json(const truth::Judgement& judgement) {
  Json json;
  for (const truth::Verdict verdict : truth::all_verdicts)
    json[truth::to_string(verdict)] = judgement.count(verdict);
  json["not_judged"] = judgement.not_judged;
  Json& pixels = json["pixels"] = Json::array();
  for (const truth::JudgedPixel& p : judgement.pixels) {
    pixels.push_back({{"x", p.x},
                      {"y", p.y},
                      {"verdict", truth::to_string(p.verdict)},
                      {"ours", p.ours},
                      {"reference", p.reference},
                      {"oracle", {p.oracle.x, p.oracle.y, p.oracle.z}}});
  }
  return json;
}

Json to_json(const comparison::Comparison& c) {
  return {{"max_error", c.max_error},
          {"judged_error", c.judged_error},
          {"mean_error", c.mean_error},
          {"rms_error", c.rms_error},
          {"pixels_over", c.pixels_over},
          {"non_finite", c.non_finite},
          {"worst",
           {{"x", c.worst.x}, {"y", c.worst.y}, {"ours", c.worst.test}, {"reference", c.worst.reference}}}};
}

Json to_json(const comparison::Metrics& m) {
  Json json{{"peak", m.peak}, {"psnr_db", m.psnr_db ? Json(*m.psnr_db) : Json()}};
  for (std::size_t i = 0; i < m.percentiles.size(); ++i) {
    const std::size_t permille = comparison::permilles[i];
    const std::string name =
        "p" + std::to_string(permille / 10) + (permille % 10 ? "." + std::to_string(permille % 10) : "");
    json["percentiles"][name] = m.percentiles[i];
  }
  json["bias"] = m.bias;
  for (std::size_t i = 0; i < m.scalars.size(); ++i)
    json[comparison::scalar_metrics()[i].key] = m.scalars[i] ? Json(*m.scalars[i]) : Json();
  json["flip"] = m.flip ? flip_json(*m.flip) : Json();
  return json;
}

Json to_json(const comparison::LikelyCause& c) {
  return {{"name", c.name},
          {"text", c.text},
          {"pixels_over", c.pixels_over},
          {"removed", c.removed},
          {"because", c.because}};
}

Json to_json(const gates::Bounds& bounds, const gates::BoundedComparison& result) {
  return {{"tolerance", bounds.limit.tolerance},
          {"relative", bounds.limit.relative},
          {"allow_over", bounds.allow_over.text()},
          {"allowed_over", result.allowed_over},
          {"ignore", texts_of(bounds.ignore)},
          {"only", texts_of(bounds.only)},
          {"pixels_compared", result.comparison.pixels},
          {"pixels_ignored", result.ignored},
          {"ignored_non_finite", result.ignored_non_finite},
          {"because", bounds.because}};
}

Json to_json(const gates::VerifyReport& report) {
  Json scenes = Json::array();
  for (const gates::SceneResult& result : report.scenes)
    scenes.push_back(scene_json(result, message_of(result)));
  return {{"tool", "plumb"},
          {"version", PLUMB_VERSION},
          {"reference", {{"renderer", report.reference.name}, {"version", report.reference_version}}},
          {"notice", report.notice},
          {"scenes", scenes}};
}

void write_json(const std::string& path, const Json& json) {
  write_file(path, system::json_text_of_any_bytes(json, 2) + "\n");
}

}  // namespace plumb::report
