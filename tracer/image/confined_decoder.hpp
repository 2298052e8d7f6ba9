// Decoders of others, at work in a process of their own: limited in memory and time, without files, network
// or other processes. What becomes of it, this one goes on.
#pragma once

#include <memory>
#include <string>

#include "tracer/image/kind.hpp"
#include "tracer/image/pixel_rows.hpp"
#include "tracer/image/read_request.hpp"
#include "tracer/system/mapped_file.hpp"

namespace plumb {

inline constexpr const char* decoder_name = "plumb-decode";
inline constexpr const char* serve_argument = "serve";  ///< its only one: what it does for plumb
inline constexpr const char* decoder_path = "?";        ///< what it calls the file in its messages
inline constexpr int exit_without_module = 3;           ///< its own trouble, not that of a file

/// Throws std::runtime_error naming the path and what is wrong with it, PictureTooLarge, and
/// std::system_error when the process cannot be run: that is not the file's fault.
PixelRows decode_confined(const std::string& path, const MappedFile& file, Kind kind,
                          const ReadRequest& request, const ReadLimits& limits);

}  // namespace plumb
