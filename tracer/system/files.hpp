// Whole files: read at once; written aside and renamed, so that no half-written file is ever seen.
#pragma once

#include <string>
#include <string_view>

namespace plumb {

/// All bytes of a file or pipe. Throws std::runtime_error naming the path and the cause, a directory
/// included.
std::string read_file(const std::string& path);

/// Replaces the file by the bytes. `-` is standard output; a device or pipe is written to directly.
/// Throws std::runtime_error naming the path and the cause; then the old file is as it was.
void write_file(const std::string& path, std::string_view bytes);

}  // namespace plumb
