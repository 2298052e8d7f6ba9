// Writes one result as JSON that holds all of it, for the journal; reports have JSON of their own.
#pragma once

#include <nlohmann/json.hpp>

#include "references/submissions/grade.hpp"

namespace plumb::submissions {

nlohmann::ordered_json record_of(const JudgedPicture& picture);

/// Throws std::exception when another version wrote the record.
JudgedPicture picture_of_record(const nlohmann::ordered_json& record);

}  // namespace plumb::submissions
