// Finds the smallest set that hits others: the fewest scenes that tell all faults apart.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "references/teaching/matrix.hpp"

namespace plumb::teaching {

/// They are ascending.
using Indices = std::vector<std::size_t>;

/// Returns a smallest set that has at least one index of each of the wishes, none of which is empty. Branch
/// and bound proves it; the bound is the number of wishes that share no index. Empty after `most_nodes`.
std::optional<Indices> smallest_hitting_set(const std::vector<Indices>& wishes, std::size_t most_nodes);

/// Returns one that is found quickly: each index hits most of those that are left.
Indices greedy_hitting_set(std::vector<Indices> wishes);

/// Returns, for each pair of pictures that some scene tells apart, the scenes that do.
std::vector<Indices> wishes_of(const Matrix& matrix);

/// Two pictures, a < b, numbered as in Matrix.
struct Pair {
  std::size_t a;
  std::size_t b;
};

/// Returns the pairs that none of the scenes tells apart.
std::vector<Pair> pairs_left(const Matrix& matrix, const Indices& scenes);

struct TeachingSet {
  Indices scenes;
  bool is_proven;          ///< true if no smaller one exists
  std::vector<Pair> left;  ///< pairs that no scene at all tells apart
};

TeachingSet teaching_set(const Matrix& matrix);

}  // namespace plumb::teaching
