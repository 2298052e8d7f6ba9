#include "references/report/scene_report.hpp"

#include <map>

#include "references/report/explanations.hpp"
#include "references/report/results_json.hpp"
#include "references/report/sentences.hpp"
#include "tracer/text/shell_word.hpp"

namespace plumb::report {
namespace {

/// A note for each pixel over, with who is wrong where that was asked, and its rays where they were kept.
std::vector<PixelNote> notes_of(const gates::SceneResult& result) {
  std::map<std::pair<int, int>, std::string> judged;
  if (result.judgement)
    for (const truth::JudgedPixel& p : result.judgement->pixels) judged[{p.x, p.y}] = judged_text(p);
  const auto rays = explanations_of(result);
  std::vector<PixelNote> notes;
  for (const attribution::AttributedPixel& p : result.budget.pixels) {
    const auto found = rays.find({p.x, p.y});
    notes.push_back({p.x, p.y, attribution::to_string(p.cause),
                     judged[{p.x, p.y}] + (found == rays.end() ? "" : found->second)});
  }
  return notes;
}

/// The scene's object of --json; what was not compared has no figures.
Json shown_result(const gates::SceneResult& result, const std::string& message, double tolerance) {
  Json json = scene_json(result, message);
  json["tolerance"] = tolerance;
  json.erase("judgement");  // its pixels are in their notes
  if (result.judgement && result.comparison.pixels_over > 0)
    json["message"] =
        message + (message.empty() ? "" : "\n") + "judged in 113 bits: " + judgement_text(*result.judgement);
  if (!result.no_figures) return json;
  const Json figures = report::to_json(result.comparison);
  for (const auto& [figure, value] : figures.items()) json.erase(figure);
  for (const char* const key : {"metrics", "budget", "unexamined", "unverified", "shapes"}) json.erase(key);
  json["not_compared"] = not_compared_text(result);
  return json;
}

}  // namespace

SceneReport::SceneReport(const std::string& directory, const std::string& title, double tolerance)
    : tolerance_(tolerance) {
  if (directory.empty()) return;
  writer_ = std::make_unique<ReportWriter>(directory, title, "plumb " PLUMB_VERSION);
}

void SceneReport::add(const gates::SceneResult& result, const std::optional<std::string>& options) {
  add(result, message_of(result), options, "");
}

void SceneReport::add(const gates::RegressedScene& scene, const std::optional<std::string>& options,
                      const std::string& approve_command) {
  add(scene.result, message_of(scene), options, approve_command);
}

void SceneReport::add(const gates::SceneResult& result, const std::string& message,
                      const std::optional<std::string>& options, const std::string& approve_command) {
  if (!writer_) return;
  ReportEntry entry;
  entry.name = result.scene;
  entry.result = shown_result(result, message, tolerance_);
  entry.approve_command = approve_command;
  if (result.pictures) {
    entry.reference = result.pictures->reference;
    entry.test = result.pictures->ours;
    entry.notes = notes_of(result);
    entry.mask = result.mask;
    if (options) entry.explain_command = "plumb explain" + *options + " " + shell_word(result.scene);
  }
  writer_->add(entry);
}

void SceneReport::finish() {
  if (writer_) writer_->finish();
}

}  // namespace plumb::report
