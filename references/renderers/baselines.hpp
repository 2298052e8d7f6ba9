// Baselines: the approved images of a directory of scenes, each with who approved it, when and why.
#pragma once

#include <string>
#include <vector>

#include "references/system/process.hpp"
#include "tracer/image/image.hpp"

namespace plumb::renderers {

struct Baseline {
  std::string name;  ///< that of NAME.sdf and NAME.exr, with its directories, e.g. "a/b"
  int width = 0;
  int height = 0;
  std::string who;
  std::string when;  ///< UTC, ISO 8601
  std::string why;
  std::string version;        ///< of plumb
  std::string scene_sha256;   ///< of the scene file, as sha256sum prints it
  std::string pixels_sha256;  ///< of the float32 values
  std::string command;        ///< renders the image, in the directory of the scenes
  std::string renderer{};     ///< somebody else's command; empty: the image is plumb's own
};

/// Reads baselines.json and the images of one directory.
class Baselines {
 public:
  /// Reads baselines.json; an absent one is empty. Throws std::runtime_error when it is damaged.
  explicit Baselines(std::string directory);

  /// True if the directory has records.
  static bool are_in(const std::string& directory);

  const std::vector<Baseline>& all() const { return entries_; }
  const Baseline* find(const std::string& name) const;
  std::string image_path(const std::string& name) const;
  /// Returns the names of the records and of the images, sorted: after a bad merge one may lack the other.
  /// Images of variants, which have records of their own, are left out.
  std::vector<std::string> names() const;

  /// Returns the pixels. Throws std::runtime_error when they cannot be read or do not have the recorded hash.
  Image load(const Baseline& entry) const;

 private:
  std::string directory_;
  std::vector<Baseline> entries_;  ///< sorted by name
};

/// Images and records that replace baselines, all of them or none: commit() renames what was written aside.
class BaselineUpdate {
 public:
  /// `aside` is a directory on the file system of the baselines, in which a hidden one is made. Throws
  /// std::runtime_error.
  BaselineUpdate(std::string directory, const std::string& aside);

  /// Adds an image and sets size and hash in its record. Throws std::runtime_error when it cannot be written.
  void add(Baseline record, const Image& image);
  void forget(const std::string& name) { gone_.push_back(name); }

  /// Replaces the baselines and keeps what others have stored since. Throws std::runtime_error.
  void commit();

 private:
  /// Also removes the directories that this leaves empty.
  void remove_image(const std::string& name) const;

  std::string directory_;
  system::TemporaryDirectory aside_;
  std::vector<Baseline> added_;
  std::vector<std::string> gone_;
};

}  // namespace plumb::renderers
