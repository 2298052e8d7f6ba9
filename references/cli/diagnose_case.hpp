// What `plumb diagnose --case` does.
#pragma once

#include <optional>
#include <string>

#include "references/gates/picture_options.hpp"

namespace plumb::cli {

struct CaseOptions {
  std::string directory;  ///< of the pictures; empty when no case was asked for
  std::string scenes;     ///< directory; empty: that of the pictures, or plumb's own when it has none
  std::string json;
  int hint = 3;
  std::optional<double> tolerance;
  gates::PictureOptions picture;
};

/// Diagnoses each picture of the directory that has the name of a scene, and all of them together. Returns
/// the exit code: 0 all are right, 1 something is known, 3 nothing is. Throws std::invalid_argument when no
/// picture has the name of a scene.
int diagnose_case(const CaseOptions& options);

}  // namespace plumb::cli
