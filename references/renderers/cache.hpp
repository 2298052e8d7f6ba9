// Pictures that programs rendered before, kept under a hash of all that determines them.
#pragma once

#include <mutex>
#include <optional>
#include <string>

#include "references/renderers/renderer.hpp"

namespace plumb::renderers {

class Cache {
 public:
  /// Lies in $PLUMB_CACHE, or in plumb in $XDG_CACHE_HOME or ~/.cache. Makes nothing until something is
  /// stored.
  Cache();
  explicit Cache(std::string directory) : directory_(std::move(directory)) {}

  const std::string& directory() const { return directory_; }

  /// Version of a program; asks it only when the file at its path is another than last time. Throws what it
  /// throws when it is absent or does not tell.
  std::string version_of(const ProgramRenderer& renderer) const;

  /// Returns nothing when there is no entry, or a damaged one: every entry carries a hash of its own bytes.
  std::optional<Rendered> find(const ExportedShot& shot, const std::string& version) const;

  /// A cache that cannot be written (a full disk, say) is no error: the next run renders again, and
  /// complaint() says so.
  void store(const ExportedShot& shot, const std::string& version, const Rendered& picture) const;

  /// Returns where the entry of a shot is, or would be.
  std::string entry_path(const ExportedShot& shot, const std::string& version) const;

  /// What could not be written first, why, and what to do about it; empty when all could. `title` is the
  /// renderer's, whose pictures are not kept.
  std::string complaint(const std::string& title) const;

 private:
  void write_entry(const std::string& path, const std::string& bytes) const;
  void prune() const;

  std::string directory_;
  mutable std::mutex mutex_;
  mutable std::string trouble_;  // the first
};

/// The most bytes that a cache keeps. The entries that were used least recently go first.
inline constexpr unsigned long long largest_cache = 4ULL << 30;

}  // namespace plumb::renderers
