// Two image files, compared.
#pragma once

#include <optional>
#include <string>

#include "references/comparison/comparison.hpp"
#include "references/comparison/metrics/metrics.hpp"
#include "references/comparison/mismatch.hpp"
#include "references/gates/bounds.hpp"
#include "tracer/image/io.hpp"

namespace plumb::gates {

/// What is asked for of every pair.
struct PairOptions {
  ReadRequest read;
  bool metrics = false;
};

struct Findings {
  std::string reference_path;
  std::string test_path;
  Bounds bounds;
  PixelRows reference;
  PixelRows test;
  BoundedComparison result;
  std::optional<comparison::LikelyCause> cause;
  std::optional<comparison::Metrics> metrics;
  std::string no_metrics;  ///< why there are none although they were asked for

  bool agrees() const { return result.agrees(); }
};

/// Throws std::runtime_error or std::invalid_argument when the files cannot be compared.
Findings compare_files(const std::string& reference, const std::string& test, const Bounds& bounds,
                       const PairOptions& options);

}  // namespace plumb::gates
