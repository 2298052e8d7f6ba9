// Reads scene text: the course grammar, strictly unless a dialect is named.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "tracer/format/dialect.hpp"
#include "tracer/scene/scene.hpp"
#include "tracer/scene/scene_error.hpp"

namespace plumb {

enum class Severity { warning, error };

/// One thing to say about a scene file. Line and column count from 1; columns count bytes.
struct Finding {
  Severity severity;
  int line;
  int column;
  std::string message;            ///< what was found, what was expected, the likely fix
  std::string remedy{};           ///< the part of a dialect that would read it, or empty
  std::size_t extra_numbers = 0;  ///< numbers after m of a material that the dialect has no names for
};

/// Returns "FILE:LINE:COLUMN: error: message".
std::string to_string(const Finding& finding, const std::string& file);

struct ReadResult {
  Scene scene;  ///< complete and consistent when there are no errors
  std::vector<Finding> findings;

  bool has_errors() const;
};

/// Reads the whole text and reports all findings in the order of the file. Never throws on bad input.
ReadResult read_scene(std::string_view text, const Dialect& dialect = {});

/// Returns the text of a regular file or of a pipe. Throws SceneError when it is missing, a directory,
/// unreadable, or larger than 1 GiB.
std::string read_text_file(const std::string& path);

/// Reads a file. `warn` gets one line per warning. Throws SceneError with the first errors.
Scene load_scene(const std::string& path, const Dialect& dialect,
                 const std::function<void(const std::string&)>& warn = {});

/// Returns the dialects that read the text without an error, best first; empty when none is known to.
std::vector<std::string> propose_dialects(std::string_view text);

/// Returns the dialects that leave the fewest errors. Empty when one leaves none, or when none leaves fewer
/// than the course grammar does.
std::vector<std::string> nearest_dialects(std::string_view text);

}  // namespace plumb
