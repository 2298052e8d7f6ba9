// Names of one kind of things (materials, shapes, lights, cameras), and where they were defined.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace plumb {

/// A hash table with linear probing (Knuth, "The Art of Computer Programming", vol. 3, 6.4, algorithm L):
/// scenes have millions of names, and a list node for each is what their reading would wait for. Views point
/// into the text.
class Names {
 public:
  struct Key {
    std::string_view name;
    std::uint32_t hash;
  };

  /// What define looks for. Its slot is fetched from memory meanwhile: large tables are nowhere near.
  Key key_of(std::string_view name) const;
  /// Makes room for so many names, so that none is moved while they are defined.
  void reserve(std::size_t names);
  /// The line of an earlier definition of the same name, which stays, or nothing.
  std::optional<int> define(const Key& key, std::size_t id, int line);
  std::optional<int> define(std::string_view name, std::size_t id, int line) {
    return define(key_of(name), id, line);
  }
  std::optional<std::size_t> find(std::string_view name) const;
  /// Sorted.
  std::vector<std::string_view> all() const;

 private:
  struct Entry {
    std::string_view name;
    std::uint32_t id;
    int line;
  };
  /// Half of a hash, to compare before the name is looked at, and 1 + the place of the entry; 0 is free.
  struct Slot {
    std::uint32_t hash = 0;
    std::uint32_t entry = 0;
  };

  std::size_t slot_of(const Key& key) const;
  void grow(std::size_t slots);

  std::vector<Entry> entries_;
  std::vector<Slot> slots_;  ///< a power of two of them, at most 3 of 4 taken
};

}  // namespace plumb
