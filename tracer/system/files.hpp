// Reads a file at once; writes one aside and renames it, so that nobody sees a half-written file.
#pragma once

#include <string>
#include <string_view>

namespace plumb {

/// Returns all bytes of a file or pipe. Throws std::runtime_error naming the path and the cause, for a
/// directory, too.
std::string read_file(const std::string& path);

/// Replaces the file's content by the bytes. `-` is standard output; a device or pipe is written to directly.
/// Throws std::runtime_error naming the path and the cause; the old file then stays as it was.
void write_file(const std::string& path, std::string_view bytes);

}  // namespace plumb
