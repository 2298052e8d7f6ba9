// bounds.json: what the comparison of single pictures allows, and why. It lies beside the baselines, or in
// the directory of the references.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "references/gates/bounds.hpp"

namespace plumb::gates {

/// The file is an object whose keys are names of scenes or pictures, e.g.
///     {"glass": {"allow_over": "0.1%", "ignore": ["0,0,64,16"], "because": "the clock is drawn there"}}
/// allow_over, relative, tolerance, ignore and only are as on the command line; "because" must be there.
class BoundsFile {
 public:
  static constexpr const char* file_name = "bounds.json";

  /// DIRECTORY/bounds.json; without that file there are no bounds. Throws std::runtime_error, naming file,
  /// name and key, when it is not as above.
  explicit BoundsFile(const std::string& directory);

  /// Returns `usual`, with what the file says of this name in its place; the file's regions are added.
  Bounds bounds_of(const std::string& name, const Bounds& usual) const;

  /// Returns the mask images of all entries.
  std::vector<std::string> mask_paths() const;

  /// Complains of bounds for what is not among these names; empty when there are none.
  std::string complaint_about_others(const std::vector<std::string>& names) const;

 private:
  struct Entry {
    std::optional<double> tolerance;
    std::optional<double> relative;
    std::optional<AllowOver> allow_over;
    std::vector<Region> ignore;
    std::vector<Region> only;
    std::string because;
  };
  class Reader;

  std::string path_;
  std::map<std::string, Entry> entries_;
};

}  // namespace plumb::gates
