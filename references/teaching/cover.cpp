#include "references/teaching/cover.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace plumb::teaching {
namespace {

/// The limit, because so many take a second, and a teaching set is then as good as proven.
constexpr std::size_t most_nodes = 2'000'000;

/// Returns the wishes without those that are hit whenever another is.
std::vector<Indices> without_implied(std::vector<Indices> wishes) {
  std::stable_sort(wishes.begin(), wishes.end(),
                   [](const Indices& a, const Indices& b) { return a.size() < b.size(); });
  std::vector<Indices> kept;
  for (const Indices& wish : wishes) {
    const bool is_implied = std::any_of(kept.begin(), kept.end(), [&](const Indices& smaller) {
      return std::includes(wish.begin(), wish.end(), smaller.begin(), smaller.end());
    });
    if (!is_implied) kept.push_back(wish);
  }
  return kept;
}

class BranchAndBound {
 public:
  BranchAndBound(const std::vector<Indices>& wishes, std::size_t nodes)
      : best_(greedy_hitting_set(wishes)), nodes_(nodes) {
    descend(without_implied(wishes), {});
  }
  std::optional<Indices> best() const { return nodes_ == 0 ? std::nullopt : std::optional(best_); }

 private:
  /// Returns a lower bound, the number of wishes of which none shares an index with another. Expects the
  /// smallest first.
  static std::size_t bound(const std::vector<Indices>& wishes) {
    std::set<std::size_t> taken;
    std::size_t count = 0;
    for (const Indices& wish : wishes) {
      if (std::any_of(wish.begin(), wish.end(), [&](std::size_t i) { return taken.contains(i); })) continue;
      taken.insert(wish.begin(), wish.end());
      ++count;
    }
    return count;
  }

  /// `wishes` are ordered by size.
  void descend(std::vector<Indices> wishes, const Indices& chosen) {
    if (nodes_ == 0 || --nodes_ == 0) return;
    if (wishes.empty()) {
      if (chosen.size() < best_.size()) best_ = chosen;
      return;
    }
    if (chosen.size() + bound(wishes) >= best_.size()) return;
    const Indices choices = wishes.front();
    for (const std::size_t choice : choices) {
      std::vector<Indices> left;
      for (const Indices& wish : wishes) {
        if (!std::binary_search(wish.begin(), wish.end(), choice)) left.push_back(wish);
      }
      Indices with = chosen;
      with.insert(std::lower_bound(with.begin(), with.end(), choice), choice);
      descend(std::move(left), with);
      // What follows does without this choice, so that no set is looked at twice.
      for (Indices& wish : wishes) std::erase(wish, choice);
      if (std::any_of(wishes.begin(), wishes.end(), [](const Indices& wish) { return wish.empty(); })) return;
      wishes = without_implied(std::move(wishes));
    }
  }

  Indices best_;
  std::size_t nodes_;
};

}  // namespace

std::optional<Indices> smallest_hitting_set(const std::vector<Indices>& wishes, std::size_t nodes) {
  return BranchAndBound(wishes, nodes).best();
}

Indices greedy_hitting_set(std::vector<Indices> wishes) {
  Indices chosen;
  while (!wishes.empty()) {
    std::map<std::size_t, std::size_t> hits;
    for (const Indices& wish : wishes) {
      for (const std::size_t i : wish) ++hits[i];
    }
    const std::size_t best = std::max_element(hits.begin(), hits.end(), [](const auto& a, const auto& b) {
                               return a.second < b.second;
                             })->first;
    chosen.insert(std::lower_bound(chosen.begin(), chosen.end(), best), best);
    std::erase_if(wishes,
                  [&](const Indices& wish) { return std::binary_search(wish.begin(), wish.end(), best); });
  }
  return chosen;
}

std::vector<Indices> wishes_of(const Matrix& matrix) {
  std::set<Indices> wishes;
  for (std::size_t b = 0; b < matrix.pictures(); ++b) {
    for (std::size_t a = 0; a < b; ++a) {
      Indices wish;
      for (std::size_t scene = 0; scene < matrix.scenes().size(); ++scene) {
        if (matrix.tells_apart(scene, a, b)) wish.push_back(scene);
      }
      if (!wish.empty()) wishes.insert(std::move(wish));
    }
  }
  return {wishes.begin(), wishes.end()};
}

std::vector<Pair> pairs_left(const Matrix& matrix, const Indices& scenes) {
  std::vector<Pair> left;
  for (std::size_t a = 0; a < matrix.pictures(); ++a) {
    for (std::size_t b = a + 1; b < matrix.pictures(); ++b) {
      if (std::none_of(scenes.begin(), scenes.end(),
                       [&](std::size_t scene) { return matrix.tells_apart(scene, a, b); }))
        left.push_back({a, b});
    }
  }
  return left;
}

TeachingSet teaching_set(const Matrix& matrix) {
  const std::vector<Indices> wishes = wishes_of(matrix);
  Indices all(matrix.scenes().size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const auto proven = smallest_hitting_set(wishes, most_nodes);
  return {proven ? *proven : greedy_hitting_set(wishes), proven.has_value(), pairs_left(matrix, all)};
}

}  // namespace plumb::teaching
