// Takes the picture that a program we do not trust left in a directory. It follows no link and never waits.
#pragma once

#include <cstddef>
#include <string>

namespace plumb::submissions {

enum class Found { picture, nothing, not_a_file, too_large, forbidden };

/// Copies the regular file `name`, relative to `directory`, to `target`. A symbolic link anywhere on the way,
/// a pipe, a device or a directory is not_a_file. A name that leads out of the directory finds nothing. What
/// its mode keeps from us is forbidden. Throws std::runtime_error for trouble that is not the file's.
Found take_file(const std::string& directory, const std::string& name, std::size_t most_bytes,
                const std::string& target);

}  // namespace plumb::submissions
