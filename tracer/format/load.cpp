// From files to scenes, and from unreadable files to the dialect that would read them.
#include <sys/stat.h>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <set>

#include "tracer/format/reader.hpp"
#include "tracer/system/huge_pages.hpp"

namespace plumb {
namespace {

constexpr std::size_t largest_file = std::size_t{1} << 30;
constexpr std::size_t most_lines_shown = 5;

/// A dialect that was tried, and the number of its complaints.
struct Candidate {
  std::string dialect;
  std::size_t errors;
  std::size_t warnings;
};

/// Parts of a dialect that the findings ask for, and the greatest number of values after m.
struct Wanted {
  std::set<std::string> parts;
  std::size_t extra_numbers = 0;
};

Wanted wanted_by(const ReadResult& result, Wanted before) {
  for (const Finding& finding : result.findings) {
    if (!finding.remedy.empty()) before.parts.insert(finding.remedy);
    before.extra_numbers = std::max(before.extra_numbers, finding.extra_numbers);
  }
  return before;
}

std::string join(const std::set<std::string>& parts, const std::string& last) {
  std::string joined;
  for (const std::string& part : parts) joined += (joined.empty() ? "" : ",") + part;
  if (!last.empty()) joined += (joined.empty() ? "" : ",") + last;
  return joined;
}

std::size_t count_errors(const ReadResult& result) {
  return static_cast<std::size_t>(
      std::count_if(result.findings.begin(), result.findings.end(),
                    [](const Finding& f) { return f.severity == Severity::error; }));
}

/// The dialects that the findings under the course grammar suggest, those with the fewest errors and warnings
/// first.
std::vector<Candidate> candidates_for(std::string_view text) {
  constexpr int rounds = 3;  // because curing one part may show what another must
  Wanted wanted;
  for (int round = 0; round < rounds; ++round) {
    const std::string so_far = join(wanted.parts, "");
    const ReadResult result = read_scene(text, so_far.empty() ? Dialect{} : parse_dialect(so_far));
    wanted = wanted_by(result, wanted);
  }
  std::vector<std::string> layouts = known_material_layouts(wanted.extra_numbers);
  if (layouts.empty()) layouts.emplace_back();
  std::vector<std::string> names;
  for (const std::string& layout : layouts) names.push_back(join(wanted.parts, layout));
  if (wanted.parts.erase("la-ld") > 0) {  // nine numbers of a light mean one or the other
    wanted.parts.insert("brightness-rgb");
    for (const std::string& layout : layouts) names.push_back(join(wanted.parts, layout));
  }
  std::vector<Candidate> candidates;
  for (const std::string& name : names) {
    if (name.empty()) continue;
    const ReadResult result = read_scene(text, parse_dialect(name));
    const std::size_t errors = count_errors(result);
    candidates.push_back({name, errors, result.findings.size() - errors});
  }
  std::stable_sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return std::pair(a.errors, a.warnings) < std::pair(b.errors, b.warnings);
  });
  return candidates;
}

}  // namespace

std::string read_text_file(const std::string& path) {
  struct stat info {};
  if (stat(path.c_str(), &info) != 0) throw SceneError(path + ": cannot be read: " + std::strerror(errno));
  if (S_ISDIR(info.st_mode))
    throw SceneError(path + ": is a directory, expected a scene file; name a file in it");
  if (info.st_size > static_cast<off_t>(largest_file)) throw SceneError(path + ": is larger than 1 GiB");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw SceneError(path + ": cannot be opened: " + std::strerror(errno));
  std::string text;
  text.reserve(static_cast<std::size_t>(info.st_size));
  prefer_huge_pages(text.data(), text.capacity());
  std::string piece(std::size_t{1} << 16, '\0');
  while (file.read(piece.data(), static_cast<std::streamsize>(piece.size())) || file.gcount() > 0) {
    text.append(piece.data(), static_cast<std::size_t>(file.gcount()));
    if (text.size() > largest_file) throw SceneError(path + ": is larger than 1 GiB");
  }
  if (file.bad()) throw SceneError(path + ": cannot be read: " + std::strerror(errno));
  return text;
}

Scene load_scene(const std::string& path, const Dialect& dialect,
                 const std::function<void(const std::string&)>& warn) {
  ReadResult result = read_scene(read_text_file(path), dialect);
  std::string errors;
  std::size_t count = 0;
  for (const Finding& finding : result.findings) {
    if (finding.severity == Severity::warning) {
      if (warn) warn(to_string(finding, path));
    } else if (++count <= most_lines_shown) {
      errors += (errors.empty() ? "" : "\n") + to_string(finding, path);
    }
  }
  if (count > most_lines_shown) {
    errors += "\n" + path + ": " + std::to_string(count - most_lines_shown) + " more; see plumb lint " + path;
  }
  if (count > 0) throw SceneError(errors);
  return std::move(result.scene);
}

std::vector<std::string> propose_dialects(std::string_view text) {
  std::vector<std::string> names;
  for (const Candidate& candidate : candidates_for(text)) {
    if (candidate.errors == 0) names.push_back(candidate.dialect);
  }
  return names;
}

std::vector<std::string> nearest_dialects(std::string_view text) {
  const auto candidates = candidates_for(text);
  std::vector<std::string> names;
  if (candidates.empty() || candidates.front().errors == 0) return names;
  const std::size_t fewest = candidates.front().errors;
  if (fewest >= count_errors(read_scene(text))) return names;
  for (const Candidate& candidate : candidates) {
    if (candidate.errors == fewest) names.push_back(candidate.dialect);
  }
  return names;
}

}  // namespace plumb
