// What makes a picture of a shot.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "references/renderers/holds.hpp"
#include "references/renderers/resolution.hpp"
#include "tracer/image/image.hpp"
#include "tracer/scene/shot.hpp"

namespace plumb::renderers {

/// A picture, and how it was made.
struct Rendered {
  Image image;                   ///< linear
  Holds holds = Holds::float32;  ///< less than the renderer's where its best file could not be used
  std::string warnings{};        ///< of the renderer, a line each; empty when there are none
  std::string not_read{};        ///< what else its file holds; empty when that is all
  double cpu_seconds = 0;        ///< of a program that ran now
  bool cached = false;           ///< or stored: it was not rendered now
  bool stored = false;
};

struct RendererFacts {
  std::string name;   ///< as it stands in JSON, e.g. "povray"
  std::string title;  ///< for readers, e.g. "POV-Ray"
  Holds holds = Holds::float32;
  /// Empty where it is not known: then no difference is explained.
  std::optional<Resolution> resolution{};
};

class Renderer {
 public:
  explicit Renderer(RendererFacts facts) : facts_(std::move(facts)) {}
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;
  virtual ~Renderer() = default;

  const RendererFacts& facts() const { return facts_; }

  /// Returns an empty text when it does not tell. Throws std::runtime_error when it cannot be asked.
  virtual std::string version() const = 0;

  /// Returns the picture in the shot's size; one that was kept from before may have another. Several threads
  /// may call it. Throws std::runtime_error.
  virtual Rendered render(const Shot& shot) const = 0;

  /// Returns what should be said at the end, e.g. that pictures could not be kept; else empty.
  virtual std::string complaint() const { return {}; }

 private:
  RendererFacts facts_;
};

/// What a program is asked: all that determines its picture, except the program's version.
struct ExportedShot {
  std::string renderer;                ///< its name, which is also that of its command
  std::vector<std::string> arguments;  ///< of its command line
  std::string text;                    ///< the exported scene
  int width;
  int height;
  Holds holds = Holds::float32;  ///< what is read of its files

  /// Returns e.g. "povray +Iin.pov +Oout.png".
  std::string command() const;
};

/// Another program, which renders scenes in a language of its own.
class ProgramRenderer : public Renderer {
 public:
  using Renderer::Renderer;

  /// Returns its path. Throws std::runtime_error that says how to get it when this machine has none.
  virtual std::string program() const = 0;

  /// Returns what the program would be asked. Starts nothing, and needs no program.
  virtual ExportedShot exported(const Shot& shot) const = 0;
};

}  // namespace plumb::renderers
