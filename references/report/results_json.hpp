// Results of verify, regress and compare as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "references/comparison/metrics/metrics.hpp"
#include "references/comparison/mismatch.hpp"
#include "references/gates/bounds.hpp"
#include "references/gates/verify.hpp"

namespace plumb::report {

using Json = nlohmann::ordered_json;

/// max_error, mean_error, rms_error, pixels_over, non_finite, worst
Json to_json(const comparison::Comparison& comparison);

/// The pixels of each cause; the sum is pixels_over.
Json to_json(const attribution::Budget& budget);

/// The pixels of each verdict, those not judged, and "pixels": x, y, verdict, ours, reference, oracle of
/// each.
Json to_json(const truth::Judgement& judgement);

/// One of the "scenes" of a result; `message` is what is said of it.
Json scene_json(const gates::SceneResult& result, const std::string& message);

/// peak, psnr_db, percentiles, bias; those that are one number and flip when they were computed. What does
/// not exist is null.
Json to_json(const comparison::Metrics& metrics);

/// name, text, pixels_over, removed, because
Json to_json(const comparison::LikelyCause& cause);

/// What was allowed, what was ignored and why, as "bounds" of a result.
Json to_json(const gates::Bounds& bounds, const gates::BoundedComparison& result);

Json to_json(const gates::VerifyReport& report);

/// Pretty-printed, to a file or (`-`) to standard output.
void write_json(const std::string& path, const Json& json);

}  // namespace plumb::report
