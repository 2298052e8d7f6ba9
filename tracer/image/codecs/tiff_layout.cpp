#include "tracer/image/codecs/tiff_layout.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <string_view>

#include "tracer/image/codecs/damage.hpp"

namespace plumb::codecs {
namespace {

/// Bytes of a value by the number of its type; 0: no such type.
constexpr std::array<unsigned char, 19> sizes{0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8, 4, 0, 0, 8, 8, 8};

struct Values {
  std::uint64_t at = 0;
  std::uint64_t count = 0;
  std::uint64_t size = 0;  ///< bytes of each
};

/// Where pixels are: strips and tiles have tags of their own for the same.
struct Pieces {
  Values offsets;
  Values counts;
};

class Layout {
 public:
  explicit Layout(const Source& source)
      : path_(source.path),
        file_(source.file->bytes()),
        is_big_endian_(file_[0] == 'M'),
        is_long_(number(2, 2, "header") == 43),
        word_(is_long_ ? 8 : 4) {}

  void check() {
    std::uint64_t at = number(word_, word_, "header");
    // A chain that does not end is a ring.
    constexpr std::size_t most = 1 << 16;
    std::set<std::uint64_t> seen;
    while (at != 0 && seen.size() < most && seen.insert(at).second) at = check_directory(at);
  }

 private:
  /// The offset of the next directory.
  std::uint64_t check_directory(std::uint64_t at) {
    const std::uint64_t head = is_long_ ? 8 : 2, entry = is_long_ ? 20 : 12;
    const std::uint64_t entries = number(at, head, "directory");
    expect(at + head, entries, entry, "directory");
    Pieces strips, tiles;
    for (std::uint64_t i = 0; i < entries; ++i) check_entry(at + head + i * entry, strips, tiles);
    check_pieces(strips, "strip");
    check_pieces(tiles, "tile");
    return number(at + head + entries * entry, word_, "directory");
  }

  /// Checks an entry. A value that fits stands in the entry itself.
  void check_entry(std::uint64_t at, Pieces& strips, Pieces& tiles) const {
    const std::uint64_t tag = number(at, 2, "entry"), type = number(at + 2, 2, "entry");
    Values values{at + 4 + word_, number(at + 4, word_, "entry"), type < sizes.size() ? sizes[type] : 0U};
    if (values.size == 0) return;
    if (values.count > word_ / values.size) values.at = number(values.at, word_, "entry");
    expect(values.at, values.count, values.size, "value of tag " + std::to_string(tag));
    if (tag == 273) strips.offsets = values;
    if (tag == 279) strips.counts = values;
    if (tag == 324) tiles.offsets = values;
    if (tag == 325) tiles.counts = values;
  }

  /// Checks strips or tiles. Pages that share their lists could make a short file take hours, so there is a
  /// limit.
  void check_pieces(const Pieces& pieces, const std::string& name) {
    const std::uint64_t count = std::min(pieces.offsets.count, pieces.counts.count);
    pieces_ += count;
    if (pieces_ > file_.size())
      refuse_damaged(path_, "found more " + name + "s than the file has bytes, in pages that share them");
    for (std::uint64_t i = 0; i < count; ++i)
      expect(value(pieces.offsets, i), value(pieces.counts, i), 1, name + " " + std::to_string(i));
  }

  std::uint64_t value(const Values& values, std::uint64_t i) const {
    return number(values.at + i * values.size, values.size, "value");
  }

  void expect(std::uint64_t at, std::uint64_t count, std::uint64_t size, const std::string& name) const {
    if (at <= file_.size() && count <= (file_.size() - at) / size) return;
    refuse_damaged(path_, "found a " + name + " at byte " + std::to_string(at) + ", " +
                              std::to_string(count) + (size == 1 ? "" : " times " + std::to_string(size)) +
                              " bytes long, expected it within the file's " + std::to_string(file_.size()));
  }

  std::uint64_t number(std::uint64_t at, std::uint64_t size, const std::string& name) const {
    expect(at, 1, size, name);
    std::uint64_t number = 0;
    for (std::uint64_t i = 0; i < size; ++i) {
      const auto byte = static_cast<unsigned char>(file_[at + (is_big_endian_ ? i : size - 1 - i)]);
      number = number << 8 | byte;
    }
    return number;
  }

  const std::string& path_;
  std::string_view file_;
  bool is_big_endian_;
  bool is_long_;
  std::uint64_t word_;  ///< bytes of an offset
  std::uint64_t pieces_ = 0;
};

}  // namespace

void expect_whole_tiff(const Source& source) { Layout(source).check(); }

}  // namespace plumb::codecs
