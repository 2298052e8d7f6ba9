#include "tracer/format/names.hpp"

#include <algorithm>
#include <bit>
#include <functional>

#include "tracer/system/huge_pages.hpp"

namespace plumb {
namespace {

std::uint32_t hash_of(std::string_view name) {
  return static_cast<std::uint32_t>(std::hash<std::string_view>{}(name));
}

std::size_t slots_for(std::size_t names) { return std::bit_ceil(names + names / 3 + 1); }

}  // namespace

void Names::reserve(std::size_t names) {
  entries_.reserve(names);
  prefer_huge_pages(entries_.data(), names * sizeof(Entry));
  if (slots_for(names) > slots_.size()) grow(slots_for(names));
}

Names::Key Names::key_of(std::string_view name) const {
  const Key key{name, hash_of(name)};
  if (!slots_.empty()) __builtin_prefetch(&slots_[key.hash & (slots_.size() - 1)], 1);
  return key;
}

std::optional<int> Names::define(const Key& key, std::size_t id, int line) {
  if (slots_for(entries_.size() + 1) > slots_.size()) grow(slots_for(entries_.size() + 1));
  Slot& slot = slots_[slot_of(key)];
  if (slot.entry != 0) return entries_[slot.entry - 1].line;
  entries_.push_back({key.name, static_cast<std::uint32_t>(id), line});
  slot = {key.hash, static_cast<std::uint32_t>(entries_.size())};
  return std::nullopt;
}

std::optional<std::size_t> Names::find(std::string_view name) const {
  if (slots_.empty()) return std::nullopt;
  const Slot& slot = slots_[slot_of({name, hash_of(name)})];
  return slot.entry == 0 ? std::nullopt : std::optional<std::size_t>(entries_[slot.entry - 1].id);
}

std::vector<std::string_view> Names::all() const {
  std::vector<std::string_view> names;
  names.reserve(entries_.size());
  for (const Entry& entry : entries_) names.push_back(entry.name);
  std::sort(names.begin(), names.end());
  return names;
}

/// Returns where the name is, or the free slot where it belongs.
std::size_t Names::slot_of(const Key& key) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t at = key.hash & mask;
  while (slots_[at].entry != 0 &&
         (slots_[at].hash != key.hash || entries_[slots_[at].entry - 1].name != key.name)) {
    at = (at + 1) & mask;
  }
  return at;
}

void Names::grow(std::size_t slots) {
  std::vector<Slot> before;
  before.swap(slots_);
  slots_.reserve(slots);
  prefer_huge_pages(slots_.data(), slots * sizeof(Slot));
  slots_.resize(slots);
  const std::size_t mask = slots - 1;
  for (const Slot& slot : before) {
    if (slot.entry == 0) continue;
    std::size_t at = slot.hash & mask;
    while (slots_[at].entry != 0) at = (at + 1) & mask;
    slots_[at] = slot;
  }
}

}  // namespace plumb
