// Runs the decoders of other people in a process of their own. It has limits of memory and time, and no
// files, network or other processes. Whatever becomes of it, the program goes on.
#pragma once

#include <memory>
#include <string>

#include "tracer/image/kind.hpp"
#include "tracer/image/pixel_rows.hpp"
#include "tracer/image/read_request.hpp"
#include "tracer/system/mapped_file.hpp"

namespace plumb {

inline constexpr const char* decoder_name = "plumb-decode";
inline constexpr const char* serve_argument = "serve";  ///< its only argument: it works for plumb
inline constexpr const char* decoder_path = "?";        ///< how its messages name the file
inline constexpr int exit_without_module = 3;           ///< it failed by itself, not because of a file

/// Returns the rows of a decoded file. Throws std::runtime_error naming the path and what is wrong with it,
/// and PictureTooLarge. Throws std::system_error when the process cannot be run, which is not the file's
/// fault.
PixelRows decode_confined(const std::string& path, const MappedFile& file, Kind kind,
                          const ReadRequest& request, const ReadLimits& limits);

}  // namespace plumb
