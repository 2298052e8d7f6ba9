#include "tracer/engine/hierarchy_builder.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <limits>

namespace plumb::engine {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

struct Bounds {
  std::array<float, 3> min{infinity, infinity, infinity};
  std::array<float, 3> max{-infinity, -infinity, -infinity};

  void add(const std::array<float, 3>& low, const std::array<float, 3>& high) {
    for (std::size_t k = 0; k < 3; ++k) {
      min[k] = low[k] < min[k] ? low[k] : min[k];
      max[k] = high[k] > max[k] ? high[k] : max[k];
    }
  }
  /// Half the surface; 0 when nothing was added.
  float area() const {
    const float x = max[0] - min[0], y = max[1] - min[1], z = max[2] - min[2];
    return x < 0 ? 0 : x * y + y * z + z * x;
  }
};

/// Twice the middle of an item, along an axis.
float middle(const Item& item, std::size_t axis) { return item.min[axis] + item.max[axis]; }

/// A run of items that share a place in a node.
struct Part {
  std::span<Item> items;
  Bounds bounds;
  Bounds middles;
};

Part part_of(std::span<Item> items) {
  Part part{items, {}, {}};
  for (const Item& item : items) {
    part.bounds.add(item.min, item.max);
    const std::array<float, 3> at{middle(item, 0), middle(item, 1), middle(item, 2)};
    part.middles.add(at, at);
  }
  return part;
}

constexpr std::size_t bin_count = 16;

struct Bin {
  Bounds bounds;
  std::size_t count = 0;
};

/// Tells into which bin a middle falls.
struct Binning {
  std::size_t axis;
  float from, per_length;
  std::size_t operator()(const Item& item) const {
    const float place = (middle(item, axis) - from) * per_length;
    return std::min(static_cast<std::size_t>(place), bin_count - 1);
  }
};

/// Returns the last bin of the left side when the cost, a sum of areas times counts, is least.
std::size_t best_split(const std::array<Bin, bin_count>& bins) {
  std::array<float, bin_count> cost_of_right{};
  Bin right;
  for (std::size_t i = bin_count; i-- > 1;) {
    right.bounds.add(bins[i].bounds.min, bins[i].bounds.max);
    right.count += bins[i].count;
    cost_of_right[i] = right.bounds.area() * static_cast<float>(right.count);
  }
  Bin left;
  std::size_t best = 0;
  float least = infinity;
  for (std::size_t i = 0; i + 1 < bin_count; ++i) {
    left.bounds.add(bins[i].bounds.min, bins[i].bounds.max);
    left.count += bins[i].count;
    const float cost = left.bounds.area() * static_cast<float>(left.count) + cost_of_right[i + 1];
    if (cost < least) {
      least = cost;
      best = i;
    }
  }
  return best;
}

/// Splits a part with at least two items into two parts that are not empty.
std::array<Part, 2> split(const Part& part, bool in_halves) {
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (part.middles.max[k] - part.middles.min[k] > part.middles.max[axis] - part.middles.min[axis]) axis = k;
  }
  const float extent = part.middles.max[axis] - part.middles.min[axis];
  std::size_t left = 0;
  if (const float per_length = static_cast<float>(bin_count) / extent; per_length < infinity && !in_halves) {
    const Binning bin_of{axis, part.middles.min[axis], per_length};
    std::array<Bin, bin_count> bins{};
    for (const Item& item : part.items) {
      Bin& bin = bins[bin_of(item)];
      bin.bounds.add(item.min, item.max);
      ++bin.count;
    }
    const std::size_t last = best_split(bins);
    const auto middle_of_items = std::partition(part.items.begin(), part.items.end(),
                                                [&](const Item& item) { return bin_of(item) <= last; });
    left = static_cast<std::size_t>(middle_of_items - part.items.begin());
  }
  if (left == 0 || left == part.items.size()) left = part.items.size() / 2;
  return {part_of(part.items.subspan(0, left)), part_of(part.items.subspan(left))};
}

/// Splits into at most eight parts. Of those that do not fit into one node, it splits the one with the
/// largest surface first.
std::vector<Part> parts_of(const Part& all, bool in_halves) {
  std::vector<Part> parts{all};
  while (parts.size() < node_width) {
    const auto cost = [](const Part& p) { return p.items.size() <= node_width ? -1 : p.bounds.area(); };
    const auto widest = std::max_element(parts.begin(), parts.end(),
                                         [&](const Part& a, const Part& b) { return cost(a) < cost(b); });
    if (widest->items.size() <= node_width) break;
    const auto halves = split(*widest, in_halves);
    *widest = halves[0];
    parts.push_back(halves[1]);
  }
  return parts;
}

/// Replaces parts by their items where the node itself has room for these, the largest surface first. Full
/// nodes are fewer.
void dissolve(std::vector<Part>& parts) {
  for (;;) {
    const std::size_t room = node_width - parts.size() + 1;
    auto best = parts.end();
    for (auto part = parts.begin(); part != parts.end(); ++part) {
      const bool fits = part->items.size() > 1 && part->items.size() <= room;
      if (fits && (best == parts.end() || best->bounds.area() < part->bounds.area())) best = part;
    }
    if (best == parts.end()) return;
    const std::span<Item> items = best->items;
    *best = part_of(items.subspan(0, 1));
    for (std::size_t i = 1; i < items.size(); ++i) parts.push_back(part_of(items.subspan(i, 1)));
  }
}

void set_place(Node& node, std::size_t place, const Bounds& bounds, Ref ref) {
  for (std::size_t k = 0; k < 3; ++k) {
    node.planes[k][place] = bounds.min[k];
    node.planes[k + 3][place] = bounds.max[k];
  }
  node.child[place] = ref;
}

Node empty_node() {
  Node node;
  for (std::size_t place = 0; place < node_width; ++place) set_place(node, place, {}, {});
  return node;
}

/// Appends nodes that were built apart. Returns where their root is now.
Ref append(const std::vector<Node>& built, std::vector<Node>& nodes) {
  const auto offset = static_cast<std::uint32_t>(nodes.size());
  for (Node node : built) {
    for (Ref& child : node.child) {
      if (child.kind() == Kind::node) child = Ref(Kind::node, child.index() + offset);
    }
    nodes.push_back(node);
  }
  return {Kind::node, offset};
}

constexpr std::size_t worth_a_task = 4096;

/// Deeper parts are split in halves, which bounds the depth however odd the scene is: see greatest_depth.
constexpr int best_depth = 64;

/// The root is the first node that is appended.
Ref build(const Part& all, int depth, std::vector<Node>& nodes) {
  const auto self = static_cast<std::uint32_t>(nodes.size());
  nodes.push_back(empty_node());
  if (all.items.size() <= node_width) {
    for (std::size_t i = 0; i < all.items.size(); ++i)
      set_place(nodes[self], i, {all.items[i].min, all.items[i].max}, all.items[i].ref);
    return {Kind::node, self};
  }
  std::vector<Part> parts = parts_of(all, depth > best_depth);
  dissolve(parts);
  std::vector<std::vector<Node>> apart(parts.size());
  const bool in_parallel = all.items.size() >= worth_a_task;
  if (in_parallel) {
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
      if (parts[i].items.size() > 1) build(parts[i], depth + 1, apart[i]);
    });
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Ref child = parts[i].items.size() == 1 ? parts[i].items[0].ref
                      : in_parallel              ? append(apart[i], nodes)
                                                 : build(parts[i], depth + 1, nodes);
    apart[i] = {};
    set_place(nodes[self], i, parts[i].bounds, child);
  }
  return {Kind::node, self};
}

}  // namespace

Ref build_hierarchy(std::span<Item> items, std::vector<Node>& nodes) {
  if (items.empty()) return {};
  std::vector<Node> built;
  build(part_of(items), 0, built);
  return append(built, nodes);
}

}  // namespace plumb::engine
