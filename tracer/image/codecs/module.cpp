#include "tracer/image/codecs/codecs.hpp"

extern "C" bool plumb_codecs_open(const plumb::codecs::Source& source, plumb::PixelRows& rows) {
  return plumb::codecs::open_png(source, rows) || plumb::codecs::open_exr(source, rows) ||
         plumb::codecs::open_tiff(source, rows);
}
