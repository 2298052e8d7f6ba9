#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "references/cli/commands.hpp"
#include "references/cli/options.hpp"
#include "references/report/results_json.hpp"
#include "tracer/format/reader.hpp"
#include "tracer/text/words.hpp"

namespace plumb::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::vector<std::string> scenes;
  std::string json;
  Dialect dialect;
  std::string dialect_name;
};

struct Linted {
  std::string scene;
  std::string trouble;  ///< the file cannot be read at all
  std::vector<Finding> findings;
  std::vector<std::string> dialects;  ///< that read it without an error
  std::vector<std::string> nearest;   ///< where there is none: those that leave the fewest errors
  std::vector<Finding> remaining;     ///< what the first of these leaves
  std::vector<std::string> ordered;   ///< shapes and cameras that other orders of transforms place elsewhere

  std::ptrdiff_t count(Severity severity) const {
    return std::count_if(findings.begin(), findings.end(),
                         [&](const Finding& f) { return f.severity == severity; });
  }
  bool is_readable() const { return trouble.empty() && count(Severity::error) == 0; }
};

bool is_same(const std::vector<TransformStep>& a, const std::vector<TransformStep>& b) {
  const Mat4<double> x = transform_of<double>(a).matrix;
  const Mat4<double> y = transform_of<double>(b).matrix;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      // because the steps of one matrix round differently in another order, by some 1e-16
      const double size = std::max(std::abs(x[column][row]), std::abs(y[column][row]));
      if (std::abs(x[column][row] - y[column][row]) > 1e-9 * std::max(1.0, size)) return false;
    }
  }
  return true;
}

/// What is placed elsewhere when successive transforms act in another order than the dialect's.
std::vector<std::string> placed_by_order(const std::string& text, const Scene& scene, Dialect dialect) {
  std::vector<std::string> names;
  const auto compare = [&](const auto& ours, const auto& theirs) {
    for (std::size_t i = 0; i < ours.size(); ++i) {
      if (ours[i].transform.size() < 2 || is_same(ours[i].transform, theirs[i].transform)) continue;
      if (std::find(names.begin(), names.end(), ours[i].name) == names.end()) names.push_back(ours[i].name);
    }
  };
  const TransformOrder own = dialect.order;
  for (const TransformOrder order : {TransformOrder::pre, TransformOrder::post, TransformOrder::trs}) {
    if (order == own) continue;
    dialect.order = order;
    const ReadResult other = read_scene(text, dialect);
    if (other.has_errors()) continue;
    compare(scene.shapes, other.scene.shapes);
    compare(scene.cameras, other.scene.cameras);
  }
  return names;
}

/// Whether the user said in which order transforms act.
bool names_an_order(const std::string& dialect) {
  const std::string parts = "," + dialect + ",";
  for (const char* order : {",pre,", ",post,", ",trs,"}) {
    if (parts.find(order) != std::string::npos) return true;
  }
  return false;
}

Linted lint(const std::string& scene, const std::string& dialect_name, const Dialect& dialect) {
  Linted linted{scene, {}, {}, {}, {}, {}, {}};
  try {
    const std::string text = read_text_file(scene);
    const ReadResult read = read_scene(text, dialect);
    linted.findings = read.findings;
    if (linted.is_readable()) {
      if (!names_an_order(dialect_name)) linted.ordered = placed_by_order(text, read.scene, dialect);
      return linted;
    }
    linted.dialects = propose_dialects(text);
    if (linted.dialects.empty()) linted.nearest = nearest_dialects(text);
    if (!linted.nearest.empty()) {
      linted.remaining = read_scene(text, parse_dialect(linted.nearest.front())).findings;
    }
  } catch (const SceneError& error) {
    linted.trouble = error.what();
  }
  return linted;
}

std::string plural(std::ptrdiff_t n, const char* what) {
  return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

/// "mend lines 3:7, 9:1 first, then "
std::string places_of(const std::vector<Finding>& findings) {
  std::string places;
  for (const Finding& f : findings) {
    if (f.severity != Severity::error) continue;
    places += (places.empty() ? "" : ", ") + std::to_string(f.line) + ":" + std::to_string(f.column);
  }
  return "mend " + places + " first, then ";
}

/// That a file is read does not say that it is read as its author meant.
void print_order(const Linted& linted) {
  if (linted.ordered.empty()) return;
  std::string names;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, linted.ordered.size()); ++i)
    names += (i == 0 ? "" : ", ") + in_quotes(linted.ordered[i]);
  if (linted.ordered.size() > 3) names += " and " + std::to_string(linted.ordered.size() - 3) + " more";
  std::printf(
      "%s: where %s stands depends on the order of its transforms: the first line acts first, as with "
      "--dialect pre; post and trs give another picture\n",
      linted.scene.c_str(), names.c_str());
}

void print(const Linted& linted) {
  if (!linted.trouble.empty()) {
    std::printf("%s\n", linted.trouble.c_str());
    return;
  }
  for (const Finding& finding : linted.findings)
    std::printf("%s\n", to_string(finding, linted.scene).c_str());
  std::printf("%s: %s, %s\n", linted.scene.c_str(), plural(linted.count(Severity::error), "error").c_str(),
              plural(linted.count(Severity::warning), "warning").c_str());
  print_order(linted);
  const bool mends_needed = linted.dialects.empty();
  const std::vector<std::string>& dialects = mends_needed ? linted.nearest : linted.dialects;
  if (dialects.empty()) return;
  const char* const several = " in several ways; only its author knows which is meant:";
  std::printf("%s: %sit can be read%s\n", linted.scene.c_str(),
              mends_needed ? places_of(linted.remaining).c_str() : "",
              dialects.size() > 1 ? several : " with");
  for (const std::string& dialect : dialects) std::printf("    --dialect %s\n", dialect.c_str());
}

Json to_json(const std::vector<Finding>& findings) {
  Json json = Json::array();
  for (const Finding& f : findings) {
    json.push_back({{"severity", f.severity == Severity::error ? "error" : "warning"},
                    {"line", f.line},
                    {"column", f.column},
                    {"message", f.message}});
  }
  return json;
}

Json to_json(const Linted& linted) {
  return {{"scene", linted.scene},
          {"status", linted.is_readable() ? "readable" : "error"},
          {"message", linted.trouble},
          {"findings", to_json(linted.findings)},
          {"dialects", linted.dialects},
          {"nearest_dialects", linted.nearest},
          {"remaining", to_json(linted.remaining)},
          {"placed_by_order", linted.ordered}};
}

int run_lint(const Options& options) {
  Json scenes = Json::array();
  bool all_readable = true;
  for (const std::string& scene : options.scenes) {
    const Linted linted = lint(scene, options.dialect_name, options.dialect);
    all_readable = all_readable && linted.is_readable();
    if (options.json != "-") print(linted);
    scenes.push_back(to_json(linted));
  }
  if (!options.json.empty()) {
    report::write_json(options.json, {{"tool", "plumb"}, {"version", PLUMB_VERSION}, {"scenes", scenes}});
  }
  return all_readable ? exit_agrees : exit_trouble;
}

}  // namespace

Command lint_command() {
  auto options = std::make_shared<Options>();
  return {.name = "lint",
          .purpose = "Say all that is wrong with scene files, and which dialect would read them.",
          .footer =
              "Example: plumb lint tests/scenes/*.sdf\nExit codes: 0 all can be read (warnings allowed), 2 "
              "some cannot.",
          .options = {{"SCENE", &options->scenes, "scene files", {.is_required = true}},
                      output_option("--json", options->json, "write the findings as JSON"),
                      dialect_option(options->dialect, &options->dialect_name, ":\n" + describe_dialects())},
          .run = [options](auto&) { return run_lint(*options); }};
}

}  // namespace plumb::cli
