#include "references/renderers/renderer.hpp"

namespace plumb::renderers {

std::string ExportedShot::command() const {
  std::string command = renderer;
  for (const std::string& argument : arguments) command += " " + argument;
  return command;
}

}  // namespace plumb::renderers
