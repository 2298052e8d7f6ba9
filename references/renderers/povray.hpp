// Runs the real POV-Ray and takes its linear float32 pixels.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "references/renderers/renderer.hpp"
#include "tracer/image/image.hpp"

namespace plumb::renderers {

/// POV-Ray is missing, failed, or was too slow. The message holds its own, with the line of SDL.
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

/// Returns the command line after the program's name. It is the same for every run, so that it can be
/// recorded.
std::vector<std::string> povray_arguments(const PovrayJob& job);

/// What POV-Ray is asked.
ExportedShot exported_by(const PovrayJob& job);

/// Of POV-Ray 3.7 with the scenes that plumb exports.
const Resolution& povray_resolution();

class Povray {
 public:
  /// Finds povray on PATH. Throws PovrayError when it is absent.
  Povray();

  const std::string& program() const { return program_; }

  /// Returns e.g. 3.7.0.10.unofficial. Starts POV-Ray. Throws PovrayError.
  std::string version() const;

  /// Renders a picture. Several threads may call it. Throws PovrayError.
  Rendered render(const PovrayJob& job) const;

 private:
  std::string program_;
};

struct PovraySettings {
  Holds holds = Holds::float32;
  std::vector<std::string> more_arguments{};  ///< after all others, which they override
  double time_limit_seconds = 600;
  bool in_own_units = false;  ///< of the scene, in which POV-Ray is at its weakest
};

/// Exports a shot, and has POV-Ray render it.
class PovrayRenderer : public ProgramRenderer {
 public:
  explicit PovrayRenderer(PovraySettings settings = {});

  std::string program() const override { return Povray().program(); }
  std::string version() const override { return Povray().version(); }
  ExportedShot exported(const Shot& shot) const override;
  Rendered render(const Shot& shot) const override;

 private:
  PovrayJob job_of(const Shot& shot) const;

  PovraySettings settings_;
};

std::unique_ptr<const ProgramRenderer> povray_renderer(double time_limit_seconds);

}  // namespace plumb::renderers
