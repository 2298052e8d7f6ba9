// Results as JSON and as lines of a table.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "references/comparison/metrics/metrics.hpp"
#include "references/comparison/mismatch.hpp"
#include "references/gates/verify.hpp"

namespace plumb::cli {

using Json = nlohmann::ordered_json;

/// max_error, mean_error, rms_error, pixels_over, non_finite, worst
Json to_json(const references::Comparison& comparison);

/// The pixels of each cause; the sum is pixels_over.
Json to_json(const references::Budget& budget);

/// E.g. "ours wrong 0, reference wrong 12, both wrong 0, undecided 3".
std::string judgement_text(const references::Judgement& judgement);

/// The pixels of each verdict, those not judged, and "pixels": x, y, verdict, ours, reference, oracle of
/// each.
Json to_json(const references::Judgement& judgement);

/// One of the "scenes" of a report.
Json scene_json(const references::SceneResult& result);

/// peak, psnr_db, percentiles, bias; those that are one number and flip when they were computed. What does
/// not exist is null.
Json to_json(const references::Metrics& metrics);

/// name, text, pixels_over, removed, because
Json to_json(const references::LikelyCause& cause);
/// E.g. "rows are flipped (then 0 pixels over)".
std::string cause_text(const references::LikelyCause& cause);

Json to_json(const references::VerifyReport& report);

/// Pretty-printed, to a file or (`-`) to standard output.
void write_json(const std::string& path, const Json& json);

/// Width of the first column that holds these names.
std::size_t name_width(const std::vector<std::string>& scenes);
/// The column "error" is what the tolerance is held against: relative above 1.
std::string table_head(std::size_t name_width);
std::string table_row(const references::SceneResult& result, std::size_t name_width);

/// E.g. "20 scenes: 19 agree, 1 differs".
std::string outcome(const references::VerifyReport& report);

}  // namespace plumb::cli
