// Writes the page of a diagnosis.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "references/diagnosis/diagnosis.hpp"
#include "tracer/scene/shot.hpp"

namespace plumb::report {

/// Faults that give the same picture here, and the scene of ours that tells most of them apart.
struct TellApart {
  std::vector<const faults::Fault*> faults;
  std::optional<std::string> scene;  ///< none where none tells any of them apart
};

/// What was diagnosed. All that it refers to must outlive it.
struct Diagnosed {
  const std::string& image;  ///< name of the file
  const Shot& shot;          ///< of the size of the picture
  const ImageFile& seen;
  const diagnosis::Diagnosis& diagnosis;
  const std::vector<TellApart>& tell_apart;
  const std::string& not_looked_at;  ///< may be empty
};

/// Writes DIR/diagnose.html: their picture, ours, with the faults, and what remains; each fault as `hint`
/// tells it. Throws std::runtime_error when it cannot be written.
void write_diagnosis(const std::string& directory, const Diagnosed& diagnosed, int hint);

}  // namespace plumb::report
