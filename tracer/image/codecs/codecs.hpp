// The boundary of the module that reads the commonest files quickly: OpenImageIO's start alone costs 0.3 s.
#pragma once

#include <string>

#include "tracer/image/mapped_file.hpp"
#include "tracer/image/pixel_rows.hpp"

namespace plumb::codecs {

/// What the program has of a file; both are of one file.
struct Source {
  std::string path;
  std::shared_ptr<const MappedFile> file;
};

/// False when the file is not of the plain kind that is known here: OpenImageIO then reads it, or says what
/// is wrong with it. Throws std::runtime_error naming the file when it is damaged or cut short, also one of a
/// kind that OpenImageIO reads: it would fill in zeros.
using Open = bool (*)(const Source& source, PixelRows& rows);

inline constexpr const char* module_name = "plumb_codecs.so";
inline constexpr const char* open_symbol = "plumb_codecs_open";

bool open_exr(const Source& source, PixelRows& rows);
bool open_png(const Source& source, PixelRows& rows);
bool open_tiff(const Source& source, PixelRows& rows);

}  // namespace plumb::codecs
