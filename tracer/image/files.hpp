// Whole files: read at once; written aside and renamed, so that no half-written file is ever seen.
#pragma once

#include <string>
#include <string_view>

namespace plumb {

/// All bytes of a file or pipe. Throws std::runtime_error naming the path and the cause, a directory included.
std::string read_file(const std::string& path);

/// Replaces the file by the bytes. `-` is standard output; a device or pipe is written to directly.
/// Throws std::runtime_error naming the path and the cause; then the old file is as it was.
void write_file(const std::string& path, std::string_view bytes);

/// A name beside `path`, with the same extension, for a file to be written aside.
std::string path_aside(const std::string& path);

/// Renames the file written aside, after its data are on disk; removes it when that fails.
void put_in_place(const std::string& aside, const std::string& path);

}  // namespace plumb
