#include "references/gates/image_pairs.hpp"

#include <glob.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <stdexcept>

#include "references/gates/bounds_file.hpp"
#include "tracer/image/format.hpp"

namespace plumb::gates {
namespace {

namespace fs = std::filesystem;

constexpr const char* wildcards = "*?[";

/// The pictures of one side, by their paths below its directory.
struct Side {
  std::string argument;
  std::string directory;
  std::set<std::string> files;
  std::vector<std::string> others;

  std::string path(const std::string& file) const { return (fs::path(directory) / file).string(); }
};

bool is_left_out(const fs::path& path, const std::vector<std::string>& left_out) {
  std::error_code ignored;
  return std::any_of(left_out.begin(), left_out.end(),
                     [&](const std::string& each) { return fs::equivalent(path, each, ignored); });
}

/// True for pipes and the like. A pipe that nobody writes to would never end.
bool is_no_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_other(path, ignored);
}

void add_file(Side& side, const fs::path& path, bool is_asked_for) {
  const fs::path below = path.lexically_relative(side.directory.empty() ? "." : side.directory);
  const std::string name = side.directory.empty() ? path.string() : below.string();
  if (!is_no_file(path) && (is_asked_for || is_image_name(name))) {
    side.files.insert(name);
  } else {
    side.others.push_back(path.string());
  }
}

void add_directory(Side& side, const std::vector<std::string>& left_out) {
  for (auto at = fs::recursive_directory_iterator(side.directory); at != fs::end(at); ++at) {
    const fs::path path = at->path();
    const bool is_hidden = path.filename().native().front() == '.';
    std::error_code unreadable;
    const bool is_directory = at->is_directory(unreadable);
    if (unreadable) {
      side.others.push_back(path.string());
    } else if (is_directory) {
      if (is_hidden) at.disable_recursion_pending();
      if (!is_hidden && at->is_symlink()) side.others.push_back(path.string());
    } else if (is_hidden) {
      if (is_image_name(path.string())) side.others.push_back(path.string());
    } else if (path.filename() != BoundsFile::file_name && !is_left_out(path, left_out)) {
      add_file(side, path, false);
    }
  }
}

struct Matches {
  glob_t found{};
  explicit Matches(const std::string& pattern) {
    const int code = ::glob(pattern.c_str(), GLOB_ERR, nullptr, &found);
    if (code != 0 && code != GLOB_NOMATCH)
      throw std::runtime_error(pattern + ": a directory of this pattern cannot be read");
  }
  ~Matches() { ::globfree(&found); }
  Matches(const Matches&) = delete;
  Matches& operator=(const Matches&) = delete;
};

void add_matches(Side& side, const std::vector<std::string>& left_out) {
  if (side.argument.find("**") != std::string::npos)
    throw std::runtime_error(side.argument +
                             ": found **, which would match one directory alone, expected a directory, which "
                             "is compared with all below it, or a pattern with one * for each name");
  const Matches matches(side.argument);
  for (std::size_t i = 0; i < matches.found.gl_pathc; ++i) {
    const fs::path path = matches.found.gl_pathv[i];
    if (!fs::is_directory(path) && !is_left_out(path, left_out)) add_file(side, path, true);
  }
}

Side side_of(const std::string& argument, const std::vector<std::string>& left_out) {
  Side side{argument, directory_of(argument), {}, {}};
  if (fs::is_directory(argument)) {
    add_directory(side, left_out);
    if (side.files.empty())
      throw std::runtime_error(argument + ": found no image in it, expected at least one");
  } else {
    add_matches(side, left_out);
    if (side.files.empty())
      throw std::runtime_error(argument + ": found no file that this pattern matches, expected at least one");
  }
  return side;
}

std::string without_extension(const std::string& file) { return fs::path(file).replace_extension().string(); }

using ByStem = std::map<std::string, std::vector<std::string>>;

ByStem by_stem(const Side& side) {
  ByStem stems;
  for (const std::string& file : side.files) stems[without_extension(file)].push_back(file);
  return stems;
}

std::string list(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

ImagePair missing(const Side& references, const Side& tests, const std::string& file,
                  const std::string& name) {
  return {name, references.path(file), "",
          tests.argument + ": found no image '" + name + "', expected one beside " + references.path(file)};
}

ImagePair surplus(const Side& references, const Side& tests, const std::string& file,
                  const std::string& name) {
  return {name, "", tests.path(file),
          tests.path(file) + ": found no reference '" + name + "' in " + references.argument +
              ", expected one for each image"};
}

/// Pairs the files of one stem.
class StemPairs {
 public:
  StemPairs(const Side& references, const Side& tests, std::vector<ImagePair>& pairs)
      : references_(references), tests_(tests), pairs_(pairs) {}

  void add(const std::string& stem, std::vector<std::string> mine, std::vector<std::string> theirs) {
    const bool is_alone = mine.size() <= 1 && theirs.size() <= 1;
    const auto name = [&](const std::string& file) { return is_alone ? stem : file; };
    std::vector<std::string> both;
    std::set_intersection(mine.begin(), mine.end(), theirs.begin(), theirs.end(), std::back_inserter(both));
    for (const std::string& file : both) {
      pairs_.push_back({name(file), references_.path(file), tests_.path(file), ""});
      std::erase(mine, file);
      std::erase(theirs, file);
    }
    if (mine.size() == 1 && theirs.size() == 1) return add_pair(name(mine[0]), mine[0], theirs[0]);
    if (!mine.empty() && !theirs.empty()) return add_ambiguous(stem, mine, theirs);
    for (const std::string& file : mine) pairs_.push_back(missing(references_, tests_, file, name(file)));
    for (const std::string& file : theirs) pairs_.push_back(surplus(references_, tests_, file, name(file)));
  }

 private:
  void add_pair(const std::string& name, const std::string& reference, const std::string& test) {
    pairs_.push_back({name, references_.path(reference), tests_.path(test), ""});
  }

  void add_ambiguous(const std::string& stem, const std::vector<std::string>& mine,
                     const std::vector<std::string>& theirs) {
    pairs_.push_back({stem, references_.path(mine[0]), tests_.path(theirs[0]),
                      stem + ": found " + list(mine) + " in " + references_.argument + " and " +
                          list(theirs) + " in " + tests_.argument +
                          ", expected one of each, or equal extensions"});
  }

  const Side& references_;
  const Side& tests_;
  std::vector<ImagePair>& pairs_;
};

}  // namespace

bool is_image_name(const std::string& path) {
  constexpr std::array<std::string_view, 13> known{".exr",  ".pfm", ".ppm", ".pgm", ".pbm",  ".png", ".tif",
                                                   ".tiff", ".bmp", ".tga", ".jpg", ".jpeg", ".hdr"};
  return std::find(known.begin(), known.end(), extension_of(path)) != known.end();
}

bool names_several(const std::string& argument) {
  std::error_code ignored;
  if (fs::is_directory(argument, ignored)) return true;
  return argument.find_first_of(wildcards) != std::string::npos && !fs::exists(argument, ignored);
}

std::string directory_of(const std::string& argument) {
  if (fs::is_directory(argument)) return argument;
  const std::string before = argument.substr(0, argument.find_first_of(wildcards));
  const std::size_t slash = before.rfind('/');
  return slash == std::string::npos ? "" : before.substr(0, slash + 1);
}

ImagePairs pair_images(const std::string& reference, const std::string& test,
                       const std::vector<std::string>& left_out) {
  const Side references = side_of(reference, left_out), tests = side_of(test, left_out);
  ImagePairs result{references.directory, tests.directory, {}, references.others};
  result.others.insert(result.others.end(), tests.others.begin(), tests.others.end());
  ByStem mine = by_stem(references), theirs = by_stem(tests);
  std::set<std::string> stems;
  for (const ByStem* const side : {&mine, &theirs})
    for (const auto& [stem, files] : *side) stems.insert(stem);
  StemPairs pairs(references, tests, result.pairs);
  for (const std::string& stem : stems) pairs.add(stem, mine[stem], theirs[stem]);
  return result;
}

}  // namespace plumb::gates
