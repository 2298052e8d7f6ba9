// Reference images that are kept in the repository, each with its origin.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "references/renderers/renderer.hpp"
#include "tracer/image/image.hpp"

namespace plumb::renderers {

struct StoredReference {
  std::string scene;  ///< path of the scene, from the top of the repository
  std::string image;  ///< file name in the directory of stored images
  int width = 0;
  int height = 0;
  std::string export_sha256;  ///< of the exported text, which finds the image again
  std::string pixels_sha256;  ///< of the float32 values
  std::string renderer;       ///< its name, e.g. "povray"
  std::string version;
  std::string command;  ///< made the image from the exported text
};

class StoredReferences {
 public:
  /// Reads provenance.json of the directory; without that file there are no images. Throws std::runtime_error
  /// when it is damaged.
  explicit StoredReferences(std::string directory);

  /// Returns $PLUMB_REFERENCES when it is set, else the directory of plumb's own stored images.
  static std::string default_directory();

  const std::vector<StoredReference>& all() const { return entries_; }
  std::optional<StoredReference> find(const std::string& export_text, int width, int height) const;

  /// Returns the pixels. Throws std::runtime_error when they cannot be read or do not have the recorded hash.
  Image load(const StoredReference& entry) const;

  /// Writes image and entry, in place of one for the same scene. Keeps what others have stored since. Throws
  /// std::runtime_error.
  void store(StoredReference entry, const Image& image);

 private:
  std::string directory_;
  std::vector<StoredReference> entries_;
};

/// A program's pictures, rendered before: no program is started, and none is needed.
class StoredRenderer : public Renderer {
 public:
  explicit StoredRenderer(std::unique_ptr<const ProgramRenderer> renderer);

  /// Of the first image that it made; empty when there is none.
  std::string version() const override;
  Rendered render(const Shot& shot) const override;

 private:
  std::unique_ptr<const ProgramRenderer> renderer_;
  StoredReferences stored_;
};

}  // namespace plumb::renderers
