// What is said of two image files that were compared.
#pragma once

#include <string>

#include "references/gates/findings.hpp"

namespace plumb::report {

/// What of the files was compared and what was not, in lines; empty for plain pictures.
std::string contents_of(const gates::Findings& findings);

/// "agree", "agree within the bounds" when some pixels are over, or "differ".
std::string verdict_of(const gates::Findings& findings);

/// A line for each figure, the verdict last.
std::string table_of(const gates::Findings& findings);

/// E.g. "3 of 100 pixels are over", with the bounds and the likely cause on lines of their own.
std::string details_of(const gates::Findings& findings);

/// The same of a pair that agrees; empty when there is nothing but that to be said.
std::string output_of(const gates::Findings& findings);

}  // namespace plumb::report
