// Tells what a program did instead of writing the picture that was asked for.
#pragma once

#include <string>
#include <vector>

namespace plumb::submissions {

/// Returns the kind of image that begins in what was printed, at its beginning or at that of a line, e.g.
/// "PPM (P3)"; empty when there is none.
std::string printed_image(const std::string& printed);

/// Returns the names of the first few files left below the directory, except `but`, as they can be shown.
std::vector<std::string> files_left_in(const std::string& directory, const std::string& but);

/// Says that the image was printed, that other files were written, or that nothing was; and what to do.
/// `expected` lists the names that are looked for.
std::string why_no_picture(const std::string& printed, const std::vector<std::string>& left,
                           const std::string& expected);

}  // namespace plumb::submissions
