// Names of one kind of things (materials, shapes, lights, cameras), and where they were defined.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace plumb {

/// A hash table with linear probing (Knuth, "The Art of Computer Programming", vol. 3, 6.4, algorithm L).
/// Scenes have millions of names, and one list node per name would take most of the time of reading. Views
/// point into the text, which must outlive it.
class Names {
 public:
  struct Key {
    std::string_view name;
    std::uint32_t hash;
  };

  /// Returns the key that define() takes. Begins to fetch its slot, because a large table is in no cache.
  Key key_of(std::string_view name) const;
  /// Makes room for this number of names, so that none is moved while they are defined.
  void reserve(std::size_t names);
  /// Defines a name and returns nothing, or returns the line of its earlier definition, which stays.
  std::optional<int> define(const Key& key, std::size_t id, int line);
  std::optional<int> define(std::string_view name, std::size_t id, int line) {
    return define(key_of(name), id, line);
  }
  std::optional<std::size_t> find(std::string_view name) const;
  /// Returns all names, sorted.
  std::vector<std::string_view> all() const;

 private:
  struct Entry {
    std::string_view name;
    std::uint32_t id;
    int line;
  };
  /// Half of a hash, compared before the name is, and 1 + the index of the entry; an entry of 0 means free.
  struct Slot {
    std::uint32_t hash = 0;
    std::uint32_t entry = 0;
  };

  std::size_t slot_of(const Key& key) const;
  void grow(std::size_t slots);

  std::vector<Entry> entries_;
  std::vector<Slot> slots_;  ///< their number is a power of two; at most 3 of 4 are taken
};

}  // namespace plumb
