// Somebody else's renderer, confined as submissions are.
#pragma once

#include <string>
#include <vector>

#include "references/renderers/renderer.hpp"
#include "references/submissions/sandbox/sandbox.hpp"

namespace plumb::submissions {

struct ConfinedCommand {
  std::vector<std::string> words;     ///< with {scene} and {image}
  std::vector<std::string> readable;  ///< paths that it may read in the hidden places
  SandboxLimits limits;
};

/// {scene} is a copy of the shot's file; {image} is the file that the scene's render line names, beside it.
/// The values of the picture are as they stand in its file.
class ConfinedRenderer : public renderers::Renderer {
 public:
  /// `asked` is the command as it was asked for, and names the renderer. Runs nothing yet but a trial of the
  /// sandbox: throws std::runtime_error when nothing can be confined here.
  ConfinedRenderer(const std::string& asked, ConfinedCommand command);

  std::string version() const override { return {}; }
  renderers::Rendered render(const Shot& shot) const override;

 private:
  ConfinedCommand command_;
};

}  // namespace plumb::submissions
