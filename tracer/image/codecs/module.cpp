#include "tracer/image/codecs/codecs.hpp"

extern "C" bool plumb_codecs_open(const plumb::codecs::Source& source, plumb::PixelRows& rows) {
  if (source.kind == plumb::Kind::exr) return plumb::codecs::open_exr(source, rows);
  if (source.kind == plumb::Kind::tiff) return plumb::codecs::open_tiff(source, rows);
  plumb::codecs::open_png(source, rows);
  return true;
}

extern "C" void plumb_codecs_decode(const plumb::codecs::Source& source, plumb::Canvas& canvas) {
  source.kind == plumb::Kind::exr ? plumb::codecs::decode_exr(source, canvas)
                                  : plumb::codecs::decode_tiff(source, canvas);
}
