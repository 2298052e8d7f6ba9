// The usual accidents between two programs, as what they do to a picture.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace plumb::references {

/// What the test picture would be if the accident had happened to the reference.
struct Hypothesis {
  std::string name;
  std::string text;
  // Where in the test picture the pixel (x, y) of the reference is.
  bool flips_rows = false;
  bool mirrors_columns = false;
  int dx = 0;
  int dy = 0;
  bool swaps_channels = false;
  // What became of a value; none: nothing.
  std::function<double(double)> curve = {};
  // Bounds of test - curve(reference); the tolerance when both are 0.
  double least = 0;
  double most = 0;
  std::function<bool(float)> is_level = {};  // what every value of the test picture must be
  int bits = 0;                              // of the whole numbers, when those are meant
  std::string because = {};
};

/// All that are tried, in this order: the first that leaves nothing over is named.
const std::vector<Hypothesis>& hypotheses();

}  // namespace plumb::references
