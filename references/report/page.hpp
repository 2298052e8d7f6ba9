// Puts the parts of a report together.
#pragma once

#include <string>

namespace plumb::report {

/// A whole page that loads nothing from a network. `title` and `conclusion` are text; `blocks` is HTML: the
/// data, as script elements that are not run. When `has_side_files`, scripts that lie beside the page may be
/// loaded, too.
std::string assembled_page(const std::string& title, const std::string& conclusion, const std::string& blocks,
                           bool has_side_files);

}  // namespace plumb::report
