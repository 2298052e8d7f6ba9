// Two image files, compared: the findings, as text and as JSON.
#pragma once

#include <optional>
#include <string>

#include "references/cli/report.hpp"
#include "references/comparison/comparison.hpp"
#include "references/comparison/mismatch.hpp"
#include "references/gates/bounds.hpp"
#include "tracer/image/io.hpp"

namespace plumb::cli {

/// What is asked for of every pair.
struct PairOptions {
  ReadRequest read;
  bool metrics = false;
};

struct Findings {
  std::string reference_path;
  std::string test_path;
  references::Bounds bounds;
  PixelRows reference;
  PixelRows test;
  references::BoundedComparison result;
  std::optional<references::LikelyCause> cause;
  std::optional<references::Metrics> metrics;
  std::string no_metrics;  ///< why there are none although they were asked for

  bool agrees() const { return result.agrees(); }
};

/// Throws std::runtime_error or std::invalid_argument when the files cannot be compared.
Findings compare_files(const std::string& reference, const std::string& test,
                       const references::Bounds& bounds, const PairOptions& options);

/// What of the files was compared and what was not, in lines; empty for plain pictures.
std::string contents_of(const Findings& findings);

/// "agree", "agree within the bounds" when some pixels are over, or "differ".
std::string verdict_of(const Findings& findings);

void print(const Findings& findings);
Json json_of(const Findings& findings);

/// E.g. "3 of 100 pixels are over", with the bounds and the likely cause on lines of their own.
std::string details_of(const Findings& findings);

/// The same of a pair that agrees; empty when there is nothing but that to be said.
std::string output_of(const Findings& findings);

}  // namespace plumb::cli
