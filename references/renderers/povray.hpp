// Runs the real POV-Ray and takes its linear float32 pixels.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "references/renderers/holds.hpp"
#include "references/renderers/resolution.hpp"
#include "tracer/image/image.hpp"

namespace plumb::references {

/// POV-Ray is not there, failed, or was too slow. The message holds its own, with the line of SDL.
class PovrayError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct PovrayJob {
  std::string text;  ///< SDL
  int width;
  int height;
  bool without_bounding = false;  ///< -MB
  double time_limit_seconds = 600;
  std::vector<std::string> more_arguments{};  ///< after all others, which they override
  /// Which of its files is read: its state file, or its linear PNG of so many bits, clamped at 1.
  Holds holds = Holds::float32;
};

struct PovrayPicture {
  Image image;
  double cpu_seconds = 0;
  Holds holds = Holds::float32;  ///< as asked for, or bits16 when the state file could not be used
  std::string warnings;          ///< what POV-Ray warned of, a line each; empty when nothing
};

/// The command line after the program's name; the same for every run, so that it can be recorded.
std::vector<std::string> povray_arguments(const PovrayJob& job);

/// Of POV-Ray 3.7 with the scenes that plumb exports.
const Resolution& povray_resolution();

class Povray {
 public:
  /// Finds povray on PATH. Throws PovrayError when it is absent.
  Povray();

  const std::string& program() const { return program_; }

  /// E.g. 3.7.0.10.unofficial. Starts POV-Ray. Throws PovrayError.
  std::string version() const;

  /// May be called from several threads. Throws PovrayError.
  PovrayPicture render(const PovrayJob& job) const;

 private:
  std::string program_;
};

}  // namespace plumb::references
