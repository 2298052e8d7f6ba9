// The boundary of the module that reads PNG, EXR and TIFF: OpenImageIO's start alone costs 0.3 s.
#pragma once

#include <memory>
#include <string>

#include "tracer/image/canvas.hpp"
#include "tracer/image/kind.hpp"
#include "tracer/image/pixel_rows.hpp"
#include "tracer/image/read_request.hpp"
#include "tracer/system/mapped_file.hpp"

namespace plumb::codecs {

/// What the program has of a file; both are of one file.
struct Source {
  std::string path;
  std::shared_ptr<const MappedFile> file;
  Kind kind = Kind::png;
  std::string part;  ///< as asked for; empty: the first
  ReadLimits limits;
  ReadOpenExr read_openexr = nullptr;  ///< for DWA compression, which OpenEXRCore 3.1 does not know
};

/// False when the file is not of the plain kind that is known here: a confined process then decodes it, or
/// says what is wrong with it. Throws std::runtime_error naming the file when it is damaged or cut short.
using Open = bool (*)(const Source& source, PixelRows& rows);

/// EXR and TIFF of every kind, through the libraries of these formats: for the confined process alone. Throws
/// std::runtime_error naming the file, OtherDecoderNeeded without `read_openexr` where that is needed.
using Decode = void (*)(const Source& source, Canvas& canvas);

inline constexpr const char* module_name = "plumb_codecs.so";
inline constexpr const char* open_symbol = "plumb_codecs_open";
inline constexpr const char* decode_symbol = "plumb_codecs_decode";

bool open_exr(const Source& source, PixelRows& rows);
bool open_tiff(const Source& source, PixelRows& rows);
/// Every PNG.
void open_png(const Source& source, PixelRows& rows);

void decode_exr(const Source& source, Canvas& canvas);
void decode_tiff(const Source& source, Canvas& canvas);

}  // namespace plumb::codecs
