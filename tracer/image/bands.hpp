// A picture that is handed on in bands of whole rows, so that it is never held whole.
#pragma once

#include <functional>
#include <utility>

#include "tracer/image/image.hpp"

namespace plumb {

/// Who takes a picture from a renderer.
struct BandSink {
  /// Of a band, but for the last, which may have fewer; at least 1. The engine takes the largest multiple of
  /// its tiles' height that is not more, or one tile, unless a band is the whole picture.
  int rows;
  /// The rows below those of the call before; from one thread at a time, but not always from the same.
  std::function<void(Image&&)> take;
};

/// The picture that `render` hands to the sink that it is called with.
template <class Render>
Image in_one_band(int height, const Render& render) {
  Image image;
  render(BandSink{height, [&image](Image&& whole) { image = std::move(whole); }});
  return image;
}

}  // namespace plumb
