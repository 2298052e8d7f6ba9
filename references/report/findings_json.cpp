#include "references/report/findings_json.hpp"

#include "references/report/compared_contents.hpp"

namespace plumb::report {
namespace {

Json contents_of(const PixelRows& rows) {
  const Window w = window_of(rows);
  const std::string& part = rows.contents.part;
  return {{"channels", channels_of(rows)},
          {"part", part.empty() ? Json() : Json(part)},
          {"window", {w.x, w.y, w.width, w.height}}};
}

/// {"compared": {"channels": [...], "part": ..., "window": [x, y, w, h]}, "not_compared": [...]}
Json contents_json(const NamedRows& reference, const NamedRows& test) {
  Json compared = contents_of(reference.rows);
  if (compared["part"].is_null()) compared["part"] = contents_of(test.rows)["part"];
  Json other = contents_of(test.rows);
  if (other["part"].is_null()) other["part"] = compared["part"];
  if (other != compared) compared["test"] = other;
  return {{"compared", compared}, {"not_compared", left_out(reference, test)}};
}

}  // namespace

Json json_of(const gates::Findings& f) {
  const comparison::Comparison& c = f.result.comparison;
  Json json{{"tool", "plumb"},
            {"version", PLUMB_VERSION},
            {"reference", f.reference_path},
            {"test", f.test_path},
            {"status", f.agrees() ? "agree" : "differ"},
            {"tolerance", f.bounds.limit.tolerance},
            {"width", f.test.width},
            {"height", f.test.height}};
  json.update(to_json(c));
  json.update(contents_json({f.reference_path, f.reference}, {f.test_path, f.test}));
  json["worst"]["test"] = c.worst.test;
  if (!f.bounds.are_plain()) json["bounds"] = to_json(f.bounds, f.result);
  if (f.cause) json["likely_cause"] = to_json(*f.cause);
  if (f.metrics) json["metrics"] = to_json(*f.metrics);
  if (!f.no_metrics.empty()) json["no_metrics"] = f.no_metrics;
  return json;
}

}  // namespace plumb::report
