// Makes sure that no result is written over what the same command reads.
#pragma once

#include "references/cli/command_line.hpp"

namespace plumb::cli {

/// Throws std::invalid_argument naming the option when the file of --json, --csv, --junit, --stats-json,
/// --svg, -o or --diff is one that another option or argument of the command names, or when a file of
/// results would take the place of a scene, a picture, the record of approvals, a submission or a file that
/// --renderer names; and when two outputs, --resume and the pages of --report among them, are one file.
void refuse_to_overwrite_inputs(const Request& request);

}  // namespace plumb::cli
