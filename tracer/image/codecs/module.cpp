#include "tracer/image/codecs/codecs.hpp"

extern "C" bool plumb_codecs_open(const std::string& path, plumb::PixelRows& rows) {
  return plumb::codecs::open_png(path, rows) || plumb::codecs::open_exr(path, rows) ||
         plumb::codecs::open_tiff(path, rows);
}
