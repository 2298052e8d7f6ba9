// The boundary of the module that reads PNG, EXR and TIFF. OpenImageIO's start alone would cost 0.3 s.
#pragma once

#include <memory>
#include <string>

#include "tracer/image/canvas.hpp"
#include "tracer/image/kind.hpp"
#include "tracer/image/pixel_rows.hpp"
#include "tracer/image/read_request.hpp"
#include "tracer/system/mapped_file.hpp"

namespace plumb::codecs {

/// What the program knows of a file that is to be read. `path` and `file` are of one file.
struct Source {
  std::string path;
  std::shared_ptr<const MappedFile> file;
  Kind kind = Kind::png;
  std::string part;  ///< as asked for; empty: the first part
  ReadLimits limits;
  ReadOpenExr read_openexr = nullptr;  ///< for DWA compression, which OpenEXRCore 3.1 cannot read
};

/// Opens a file of the plain kind that the module knows. Returns false for others: a confined process then
/// decodes them, or says what is wrong. Throws std::runtime_error naming a file that is damaged or cut short.
using Open = bool (*)(const Source& source, PixelRows& rows);

/// Decodes EXR and TIFF of every kind through the libraries of these formats, in the confined process alone.
/// Throws std::runtime_error naming the file, and OtherDecoderNeeded when `read_openexr` is needed and null.
using Decode = void (*)(const Source& source, Canvas& canvas);

inline constexpr const char* module_name = "plumb_codecs.so";
inline constexpr const char* open_symbol = "plumb_codecs_open";
inline constexpr const char* decode_symbol = "plumb_codecs_decode";

bool open_exr(const Source& source, PixelRows& rows);
bool open_tiff(const Source& source, PixelRows& rows);
/// Opens every PNG.
void open_png(const Source& source, PixelRows& rows);

void decode_exr(const Source& source, Canvas& canvas);
void decode_tiff(const Source& source, Canvas& canvas);

}  // namespace plumb::codecs
