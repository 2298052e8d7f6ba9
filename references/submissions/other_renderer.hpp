// Somebody else's renderer as one that `plumb regress` gates: confined as submissions are.
#pragma once

#include <string>
#include <vector>

#include "references/gates/regress.hpp"
#include "references/submissions/sandbox/sandbox.hpp"
#include "tracer/format/dialect.hpp"

namespace plumb::references {

struct ConfinedCommand {
  std::vector<std::string> words;     ///< with {scene} and {image}
  std::vector<std::string> readable;  ///< paths that it may read in the hidden places
  SandboxLimits limits;
};

/// {image} is the file that the scene's render line names, beside the scene. Runs nothing yet but a trial of
/// the sandbox: throws std::runtime_error when nothing can be confined here.
OtherRenderer confined_renderer(const std::string& asked, const ConfinedCommand& command,
                                const Dialect& dialect);

}  // namespace plumb::references
