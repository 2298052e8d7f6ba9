// Where a pixel is.
#pragma once

namespace plumb {

/// Of a picture: column from the left, and row from the top.
struct PixelPlace {
  int x;
  int y;
};

}  // namespace plumb
