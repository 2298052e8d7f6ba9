#include "references/cli/scene_report.hpp"

#include <algorithm>
#include <map>

#include "tracer/text/numbers.hpp"
#include "tracer/text/shell_word.hpp"

namespace plumb::cli {
namespace {

using references::PixelNote;
using references::SceneResult;

std::string judged_text(const references::JudgedPixel& p) {
  std::string verdict = references::to_string(p.verdict);
  std::replace(verdict.begin(), verdict.end(), '_', ' ');
  return "in 113 bits: " + verdict + "; the scene as written gives " + to_text(p.oracle.x) + " " +
         to_text(p.oracle.y) + " " + to_text(p.oracle.z) + "\n";
}

/// A note for each pixel over, with who is wrong where that was asked, and its rays where they were kept.
std::vector<PixelNote> notes_of(const SceneResult& result) {
  std::map<std::pair<int, int>, std::string> judged;
  if (result.judgement)
    for (const references::JudgedPixel& p : result.judgement->pixels) judged[{p.x, p.y}] = judged_text(p);
  std::map<std::pair<int, int>, std::string> rays;
  for (const auto& [place, text] : result.pictures->explanations) rays[{place.x, place.y}] = text;
  std::vector<PixelNote> notes;
  for (const references::AttributedPixel& p : result.budget.pixels) {
    const auto found = rays.find({p.x, p.y});
    notes.push_back({p.x, p.y, references::to_string(p.cause),
                     judged[{p.x, p.y}] + (found == rays.end() ? "" : found->second)});
  }
  return notes;
}

/// The scene's object of --json; what was not compared has no figures.
Json shown_result(const SceneResult& result, double tolerance) {
  Json json = scene_json(result);
  json["tolerance"] = tolerance;
  json.erase("judgement");  // its pixels are in their notes
  if (result.judgement && result.comparison.pixels_over > 0)
    json["message"] = result.message + (result.message.empty() ? "" : "\n") +
                      "judged in 113 bits: " + judgement_text(*result.judgement);
  if (result.not_compared.empty()) return json;
  const Json figures = to_json(result.comparison);
  for (const auto& [figure, value] : figures.items()) json.erase(figure);
  for (const char* const key : {"metrics", "budget", "unexamined", "unverified", "shapes"}) json.erase(key);
  json["not_compared"] = result.not_compared;
  return json;
}

}  // namespace

SceneReport::SceneReport(const std::string& directory, const std::string& title, double tolerance)
    : tolerance_(tolerance) {
  if (directory.empty()) return;
  writer_ = std::make_unique<references::ReportWriter>(directory, title, "plumb " PLUMB_VERSION);
}

void SceneReport::add(const SceneResult& result, const std::optional<std::string>& options,
                      const std::string& approve_command) {
  if (!writer_) return;
  references::ReportEntry entry;
  entry.name = result.scene;
  entry.result = shown_result(result, tolerance_);
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

}  // namespace plumb::cli
