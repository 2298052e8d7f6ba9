// The page that a diagnosis writes.
#pragma once

#include <string>

#include "references/diagnosis/diagnosis.hpp"

namespace plumb::cli {

/// What was diagnosed; all must outlive it.
struct Diagnosed {
  const std::string& image;  ///< name of the file
  const Scene& scene;
  const Camera& camera;
  const textbook::RenderJob& job;  ///< of the size of the picture
  const ImageFile& seen;
  const references::Diagnosis& diagnosis;
};

/// DIR/diagnose.html: their picture, ours, with the faults, and what remains; each fault as `hint` tells it.
/// Throws std::runtime_error when it cannot be written.
void write_diagnosis(const std::string& directory, const Diagnosed& diagnosed, int hint);

}  // namespace plumb::cli
