#include "references/renderers/registry.hpp"

#include <cctype>
#include <stdexcept>
#include <utility>

#include "references/renderers/cached.hpp"
#include "references/renderers/povray.hpp"
#include "references/renderers/stored.hpp"

namespace plumb::renderers {
namespace {

struct Entry {
  const char* name;
  std::unique_ptr<const ProgramRenderer> (*make)(double time_limit_seconds);
};

constexpr Entry entries[] = {{"povray", &povray_renderer}};

std::string in_capitals(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

Reference stored_reference(std::unique_ptr<const ProgramRenderer> renderer, const std::string& why) {
  const std::string notice = "NO " + in_capitals(renderer->facts().title) +
                             " IS RUN: stored reference images are used (" + why + ")";
  return {std::make_unique<StoredRenderer>(std::move(renderer)), notice};
}

}  // namespace

std::unique_ptr<const ProgramRenderer> program_renderer(const ReferenceOptions& options) {
  std::string known;
  for (const Entry& entry : entries) {
    if (options.name.empty() || options.name == entry.name) return entry.make(options.time_limit_seconds);
    known += std::string(known.empty() ? "" : ", ") + entry.name;
  }
  throw std::invalid_argument("found no reference renderer '" + options.name + "', expected one of " + known);
}

Reference reference_renderer(const ReferenceOptions& options) {
  auto renderer = program_renderer(options);
  if (options.stored) return stored_reference(std::move(renderer), "--stored");
  try {
    renderer->program();
  } catch (const std::runtime_error& absent) {
    return stored_reference(std::move(renderer), absent.what());
  }
  return {std::make_unique<CachedRenderer>(std::move(renderer)), ""};
}

}  // namespace plumb::renderers
