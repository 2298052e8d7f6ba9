#include <algorithm>
#include <cstdio>
#include <memory>

#include "references/cli/commands.hpp"
#include "references/cli/options.hpp"
#include "references/cli/report.hpp"
#include "tracer/scene/reader.hpp"

namespace plumb::cli {
namespace {

struct Options {
  std::vector<std::string> scenes;
  std::string json;
  SceneOptions common;
};

struct Linted {
  std::string scene;
  std::string trouble;  ///< the file cannot be read at all
  std::vector<Finding> findings;
  std::vector<std::string> dialects;  ///< that read it without an error
  std::vector<std::string> nearest;   ///< where there is none: those that leave the fewest errors
  std::vector<Finding> remaining;     ///< what the first of these leaves

  std::ptrdiff_t count(Severity severity) const {
    return std::count_if(findings.begin(), findings.end(),
                         [&](const Finding& f) { return f.severity == severity; });
  }
  bool is_readable() const { return trouble.empty() && count(Severity::error) == 0; }
};

Linted lint(const std::string& scene, const Dialect& dialect) {
  Linted linted{scene, {}, {}, {}, {}, {}};
  try {
    const std::string text = read_text_file(scene);
    linted.findings = read_scene(text, dialect).findings;
    if (linted.is_readable()) return linted;
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

void print(const Linted& linted) {
  if (!linted.trouble.empty()) {
    std::printf("%s\n", linted.trouble.c_str());
    return;
  }
  for (const Finding& finding : linted.findings)
    std::printf("%s\n", to_string(finding, linted.scene).c_str());
  std::printf("%s: %s, %s\n", linted.scene.c_str(), plural(linted.count(Severity::error), "error").c_str(),
              plural(linted.count(Severity::warning), "warning").c_str());
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
          {"remaining", to_json(linted.remaining)}};
}

int run_lint(const Options& options) {
  const Dialect dialect = dialect_of(options.common);
  Json scenes = Json::array();
  bool all_readable = true;
  for (const std::string& scene : options.scenes) {
    const Linted linted = lint(scene, dialect);
    all_readable = all_readable && linted.is_readable();
    if (options.json != "-") print(linted);
    scenes.push_back(to_json(linted));
  }
  if (!options.json.empty()) {
    write_json(options.json, {{"tool", "plumb"}, {"version", PLUMB_VERSION}, {"scenes", scenes}});
  }
  return all_readable ? exit_agrees : exit_trouble;
}

}  // namespace

Command add_lint(CLI::App& plumb) {
  CLI::App* app = plumb.add_subcommand(
      "lint", "Say all that is wrong with scene files, and which dialect would read them.");
  auto options = std::make_shared<Options>();
  app->add_option("SCENE", options->scenes, "scene files")->required()->expected(-1);
  app->add_option("--json", options->json, "write the findings as JSON; - is standard output")
      ->type_name("FILE");
  add_dialect(*app, options->common, true);
  app->footer(
      "Example: plumb lint tests/scenes/*.sdf\nExit codes: 0 all can be read (warnings allowed), 2 some "
      "cannot.");
  return {app, [options] { return run_lint(*options); }};
}

}  // namespace plumb::cli
