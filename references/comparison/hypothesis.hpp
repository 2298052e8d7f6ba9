// The usual accidents between two programs, and what each does to a picture.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace plumb::comparison {

/// What the test picture would be if the accident had happened to the reference.
struct Hypothesis {
  std::string name;
  std::string text;
  // Where the pixel (x, y) of the reference is in the test picture.
  bool flips_rows = false;
  bool mirrors_columns = false;
  int dx = 0;
  int dy = 0;
  bool swaps_channels = false;
  // What became of a value; empty: nothing.
  std::function<double(double)> curve = {};
  // Bounds of test - curve(reference); the tolerance counts when both are 0.
  double least = 0;
  double most = 0;
  std::function<bool(float)> is_level = {};  // true for values that the test picture may have; empty: any
  int bits = 0;                              // depth of the file's integers, if it is about those
  std::string because = {};
};

/// Returns all that are tried, in this order. The first that leaves nothing over is named.
const std::vector<Hypothesis>& hypotheses();

}  // namespace plumb::comparison
