// A picture that is handed on in bands of complete rows, so that memory never holds all of it.
#pragma once

#include <functional>
#include <utility>

#include "tracer/image/image.hpp"

namespace plumb {

/// Takes a picture from a renderer.
struct BandSink {
  /// Number of rows of a band, at least 1; the last band may have fewer. The engine takes the largest
  /// multiple of its tiles' height that is at most this, or one tile's, unless a band is the complete
  /// picture.
  int rows;
  /// Takes the rows below those of the call before. One thread at a time calls it, not always the same one.
  std::function<void(Image&&)> take;
};

/// Calls `render` with a sink of one band of `height` rows, and returns the picture that it hands to the
/// sink.
template <class Render>
Image in_one_band(int height, const Render& render) {
  Image image;
  render(BandSink{height, [&image](Image&& whole) { image = std::move(whole); }});
  return image;
}

}  // namespace plumb
