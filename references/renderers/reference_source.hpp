// Where reference pictures come from: POV-Ray through the cache, or the stored images.
#pragma once

#include <memory>
#include <string>

#include "references/renderers/cache.hpp"
#include "references/renderers/povray.hpp"
#include "references/renderers/stored.hpp"

namespace plumb::references {

struct ReferencePicture {
  Image image;
  Holds holds = Holds::float32;
  std::string warnings;    ///< of the renderer
  double cpu_seconds = 0;  ///< when it was rendered now
  bool cached = false;     ///< or stored: not rendered now
  bool stored = false;
};

class ReferenceSource {
 public:
  /// The stored images when they are asked for, or when POV-Ray is absent.
  explicit ReferenceSource(bool stored);

  const std::string& version() const { return version_; }
  /// To be said loudly when stored images are used; else empty.
  const std::string& notice() const { return notice_; }

  /// What should be said at the end: POV-Ray's pictures could not be kept; else empty.
  std::string complaint() const { return cache_.complaint(); }

  /// Throws PovrayError or std::runtime_error. May be called from several threads.
  ReferencePicture picture(const PovrayJob& job) const;

 private:
  void use_stored(const std::string& why);
  ReferencePicture stored_picture(const PovrayJob& job) const;

  Cache cache_;
  std::unique_ptr<Povray> povray_;
  std::unique_ptr<StoredReferences> stored_;
  std::string version_;
  std::string notice_;
};

}  // namespace plumb::references
